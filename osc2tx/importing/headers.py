"""The headers of documents as comments."""

from __future__ import annotations

from osc2tx.importing.cursor import Node
from osc2tx.importing.statements import LINE


def header_of(header: Node, name: str) -> list[str]:
    """Return what the header of a document says, as comments: on one line if it fits there."""
    said, author = (_told(header, each) for each in ("description", "author"))
    found = said or name
    rights = [author] if author else []
    for licence in header.children("License"):
        named = licence.text("spdxId")
        if named:
            licence.idle("its SPDX identifier says it", "name", "resource")
        parts = [named] if named else [licence.text("name"), licence.text("resource")]
        rights.append("licence: " + ", ".join(part for part in parts if part))
    held = "; ".join(rights)
    whole = f"{found.rstrip('.')} ({held})" if held else found
    if len(whole) <= LINE - len("# ") and "\n" not in found:
        return [whole]
    return [each for each in (found, held) if each]


def _told(header: Node, name: str) -> str:
    """Return the text of an attribute; an empty one says nothing, which the report notes."""
    return (header.text(name) or "") if header.element.get(name) else ""
