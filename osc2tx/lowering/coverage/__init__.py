"""Coverage items and records, their buckets and owners."""
