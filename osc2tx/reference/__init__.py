"""The reference of the library: the available items, from its declarations and the catalogue.

`declarations` reads the library texts with the meanings of their members; `entries` adds the
support of actions and modifiers in the runtime and in XML; `topics` has the language itself, the
members of types and the units; `rendering` writes an entry as text for a terminal, as Markdown or
as plain data.
"""

from __future__ import annotations

from osc2tx.reference.declarations import Declaration, Member
from osc2tx.reference.entries import Entry, entries, find
from osc2tx.reference.rendering import (
    as_data,
    as_markdown,
    as_text,
    topic_as_data,
    topic_as_markdown,
    topic_as_text,
)
from osc2tx.reference.topics import Topic, find_topics, topics

__all__ = [
    "Declaration",
    "Entry",
    "Member",
    "Topic",
    "as_data",
    "as_markdown",
    "as_text",
    "entries",
    "find",
    "find_topics",
    "topic_as_data",
    "topic_as_markdown",
    "topic_as_text",
    "topics",
]
