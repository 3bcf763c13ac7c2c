"""Support for every stage; imports nothing of ours."""
