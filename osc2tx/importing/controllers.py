"""Controllers: they make an actor the system under test, and say nothing else here."""

from __future__ import annotations

from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document

REASON = "controllers drive nothing here: what drives the actor under test does"


def note_controllers(node: Node, document: Document) -> None:
    """Note that a part of a document is about controllers, with the entries that it names."""
    for element in node.element.walk():
        part = node.other(element)
        part.idle(REASON)
        if element.tag != "CatalogReference":
            continue
        found = document.entry(element)
        if found is None:
            name = document.text_at(element.get("entryName") or "")
            part.approximate(f"there is no entry {name} in the catalogs")
            continue
        entry = part.entry(found[0], found[1].name)
        for inner in entry.element.walk():
            entry.other(inner).idle(REASON)


def gives_control(node: Node) -> bool:
    """Whether a controller drives the actor from then on: not one that is only switched off."""
    parts = list(node.element.walk())
    switches = [each for each in parts if each.tag == "ActivateControllerAction"]
    on = [
        each.get(name) for each in switches for name in ("longitudinal", "lateral", "controllerRef")
    ]
    assigned = any(each.tag == "AssignControllerAction" for each in parts)
    return assigned or any(said not in (None, "false", "0") for said in on)
