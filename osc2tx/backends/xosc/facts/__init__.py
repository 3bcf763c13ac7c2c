"""What the embedded world knows and documents have to agree with.

Only these modules ask the runtime (ADR 0001).
"""
