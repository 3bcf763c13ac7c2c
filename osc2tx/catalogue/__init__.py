"""The catalogue of the library: facts about actions, modifiers and objects.

`library.json` and `objects.json` are written by `tools/make_catalogue.py`, which joins the texts of
the library, the classes of the runtime and the forms of OpenSCENARIO XML. Every stage may read it;
`entries` is a typed view of the two files.
"""

from __future__ import annotations

from osc2tx.catalogue.entries import (
    ActionEntry,
    Catalogue,
    ModifierEntry,
    ObjectTables,
    catalogue,
    object_tables,
)

__all__ = [
    "ActionEntry",
    "Catalogue",
    "ModifierEntry",
    "ObjectTables",
    "catalogue",
    "object_tables",
]
