"""Stands for lxml in the playground, which has no wheel of it: what the reader of maps uses."""
