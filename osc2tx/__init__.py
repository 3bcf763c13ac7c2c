"""osc2tx: compiles OpenSCENARIO DSL 2.1/2.2 into readable py_trees modules."""

__version__ = "0.1.0"
