"""Documents with other texts: values in the place of parameters, positions of CARLA on the map.

ScenarioRunner takes the world positions of a document whose description begins with `CARLA:` as
those of CARLA, in which y and headings count the other way round.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

from osc2tx.xosc.element import Element

_PARAMETER = re.compile(r"\$([A-Za-z_]\w*)")


def read_in(text: str) -> set[str]:
    """Return the names of the parameters that a text reads."""
    return set(_PARAMETER.findall(text))


def values_in(declarations: Iterable[Element], name: str = "name") -> dict[str, str]:
    """Return the texts of declarations or assignments, by an attribute that names them."""
    return {each.get(name) or "": each.get("value") or "" for each in declarations}


def with_values(root: Element, values: Mapping[str, str]) -> Element:
    """Return a document with other values of some of its parameters."""
    children = [
        (
            node.with_children(*(_with_value(each, values) for each in node.children))
            if node.tag == "ParameterDeclarations"
            else node
        )
        for node in root.children
    ]
    return root.with_children(*children)


def _with_value(node: Element, values: Mapping[str, str]) -> Element:
    """Return a declaration with its value of a run."""
    attributes = dict(node.attributes)
    attributes["value"] = values.get(attributes.get("name", ""), attributes.get("value", ""))
    return node.with_attributes(attributes)


def with_plain_names(node: Element) -> Element:
    """Return declarations of parameters whose names some documents begin with a `$`."""
    if node.tag == "ParameterDeclarations":
        return with_each(node, with_plain_names)
    name = node.get("name") or ""
    if node.tag != "ParameterDeclaration" or not name.startswith("$"):
        return node
    return node.with_attributes({**dict(node.attributes), "name": name.lstrip("$")})


def scoped(node: Element) -> Element:
    """Return an element in which the parameters of stories and maneuvers have their values."""
    own = [each for each in node.children if each.tag == "ParameterDeclarations"]
    if node.tag != "OpenSCENARIO" and own and own[0].children:
        values = values_in(each for declarations in own for each in declarations.children)
        kept = [each for each in node.children if each not in own]
        return scoped(substituted(node.with_children(*kept), values))
    return with_each(node, scoped)


def with_each(node: Element, changed: Callable[[Element], Element]) -> Element:
    """Return an element with changed children; itself if none of them is another one."""
    children = [changed(child) for child in node.children]
    if all([one is other for one, other in zip(children, node.children, strict=True)]):
        return node
    return node.with_children(*children)


def substituted(node: Element, values: Mapping[str, str]) -> Element:
    """Return an element with values for some parameters in all texts below it."""
    attributes = {name: _with_values(text, values) for name, text in node.attributes}
    children = [substituted(child, values) for child in node.children]
    return node.with_attributes(attributes).with_children(*children)


def _with_values(text: str, values: Mapping[str, str]) -> str:
    if not text.startswith("$"):
        return text
    if text[1:] in values:
        return values[text[1:]]

    def inner(found: re.Match[str]) -> str:
        said = values.get(found[1])
        if said is None:
            return found[0]
        return f"({said[2:-1]})" if said.startswith("${") else f"({said})"

    return _PARAMETER.sub(inner, text)


MARK = "CARLA:"
MIRRORED = {"WorldPosition": ("y", "h"), "RelativeWorldPosition": ("dy",)}
"""Attributes with another sign, by element."""


def is_of_carla(root: Element) -> bool:
    """Whether a document is in the coordinates of CARLA."""
    header = next((each for each in root.children if each.tag == "FileHeader"), None)
    return header is not None and (header.get("description") or "").startswith(MARK)


def mirrored(node: Element) -> Element:
    """Return an element with its positions in the coordinates of the map."""
    node = with_each(node, mirrored)
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
