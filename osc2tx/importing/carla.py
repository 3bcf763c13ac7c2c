"""Documents in the coordinates of CARLA.

ScenarioRunner takes the world positions of a document whose description begins with `CARLA:` as
those of CARLA, in which y and headings count the other way round.
"""

from __future__ import annotations

from osc2tx.xosc.element import Element

MARK = "CARLA:"
MIRRORED = {"WorldPosition": ("y", "h"), "RelativeWorldPosition": ("dy",)}
"""Attributes with another sign, by element."""


def is_of_carla(root: Element) -> bool:
    """Whether a document is in the coordinates of CARLA."""
    header = next((each for each in root.children if each.tag == "FileHeader"), None)
    return header is not None and (header.get("description") or "").startswith(MARK)


def mirrored(node: Element) -> Element:
    """Return an element with its positions in the coordinates of the map."""
    children = tuple(mirrored(each) for each in node.children)
    if any(new is not old for new, old in zip(children, node.children, strict=True)):
        node = node.with_children(*children)
    names = MIRRORED.get(node.tag, ())
    if not any(name in names for name, _ in node.attributes):
        return node
    return node.with_attributes(
        {name: _negative(text) if name in names else text for name, text in node.attributes}
    )


def _negative(text: str) -> str:
    """Return a value with the other sign."""
    if text.startswith("$"):
        inner = text.removeprefix("${").removesuffix("}") if text.startswith("${") else text
        return f"${{0 - ({inner})}}"
    try:
        return f"{-float(text):.12g}"
    except ValueError:
        return text
