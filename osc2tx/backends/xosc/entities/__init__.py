"""The cast, and how it starts: `Entities` and `Init`."""
