"""The reference of the library: the available items, from its declarations and the catalogue.

`declarations` reads the library texts with the meanings of their members; `entries` adds the
support of actions and modifiers in the runtime and in XML; `rendering` writes an entry as text for
a terminal, as Markdown or as plain data.
"""

from __future__ import annotations

from osc2tx.reference.declarations import Declaration, Member
from osc2tx.reference.entries import Entry, entries, find
from osc2tx.reference.rendering import as_data, as_markdown, as_text

__all__ = [
    "Declaration",
    "Entry",
    "Member",
    "as_data",
    "as_markdown",
    "as_text",
    "entries",
    "find",
]
