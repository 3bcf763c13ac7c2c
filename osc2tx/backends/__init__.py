"""Backends: each turns the IR into one kind of file. `py_trees` writes Python modules."""
