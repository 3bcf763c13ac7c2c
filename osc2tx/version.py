"""The version of osc2tx, for every module; importing it loads nothing else."""

__version__ = "0.1.0"
