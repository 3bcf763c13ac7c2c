"""Writes `osc2tx/xosc/schema.json`: what each version of OpenSCENARIO XML has.

Read from the schemas that `asam-qc-openscenarioxml` ships (extra `test`); they end with 1.3, and
`xosc_1_4.toml` has the additions of 1.4. Units and defaults are in no schema: `xosc_facts.toml`.
One type a line:

    "Event": {"attributes": {NAME: PART}, "children": {NAME: PART}}

The fields of a part are those of `Part` in `osc2tx/xosc/schema.py`; what ends a list and is empty
is left out. Children stand in the order of the schema; of those in `choice` there is one at most
since `choice_since`, in the versions in `needed` there is one. With `text` the element has text.
`enums` holds the literals of each enumeration: first and last version, and since when it is
deprecated.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

from lxml import etree

TARGET = Path(__file__).parents[1] / "osc2tx" / "xosc" / "schema.json"
ADDITIONS = Path(__file__).with_name("xosc_1_4.toml")
FACTS = Path(__file__).with_name("xosc_facts.toml")
SCHEMAS = {"1.0": "1.0.0", "1.1": "1.1.1", "1.2": "1.2.0", "1.3": "1.3.0"}
VERSIONS = (*SCHEMAS, "1.4")
XSD = "{http://www.w3.org/2001/XMLSchema}"
ROOT = "OpenSCENARIO"
LISTED = ("attributes", "children")  # of each type, even if there are none


def schema_of(version: str) -> Any:
    """Return the root of the schema of a version."""
    if version == "1.4":
        return _with_additions(schema_of("1.3"))
    folder = files("qc_openscenario") / "schema" / SCHEMAS[version]
    return etree.fromstring((folder / f"{ROOT}.xsd").read_bytes())


def _with_additions(root: Any) -> Any:
    """Add to the schema of 1.3 what is new in 1.4."""
    new = tomllib.loads(ADDITIONS.read_text(encoding="utf-8"))
    for name, literals in new["literals"].items():
        enum = next(_named(root, "simpleType", name).iter(f"{XSD}restriction"), None)
        if enum is None:
            enum = etree.SubElement(_named(root, "simpleType", name), f"{XSD}restriction")
            enum.set("base", "xsd:string")
        for literal in literals:
            etree.SubElement(enum, f"{XSD}enumeration", value=literal)
    for name, literals in new["deprecated"].items():
        for literal in _named(root, "simpleType", name).iter(f"{XSD}enumeration"):
            if literal.get("value") in literals:
                note = etree.SubElement(literal, f"{XSD}annotation")
                etree.SubElement(note, f"{XSD}appinfo").text = "deprecated"
    for name, children in new["children"].items():
        type_ = _named(root, "complexType", name)
        models = [type_.find(f"{XSD}{kind}") for kind in ("sequence", "choice", "all")]
        model = next((each for each in models if each is not None), None)
        if model is None:
            model = etree.Element(f"{XSD}sequence")
            type_.insert(0, model)
        for child, of in children.items():
            node = etree.SubElement(model, f"{XSD}element", name=child, type=of.strip("!*"))
            if not of.endswith("!"):
                node.set("minOccurs", "0")
            if of.endswith("*"):
                node.set("maxOccurs", "unbounded")
    for name, children in new["optional"].items():
        for child in _named(root, "complexType", name).iter(f"{XSD}element"):
            if child.get("name") in children:
                child.set("minOccurs", "0")
    for name, attributes in new["attributes"].items():
        for attribute, of in attributes.items():
            type_ = _named(root, "complexType", name)
            node = etree.SubElement(type_, f"{XSD}attribute", name=attribute, type=of.strip("!"))
            if of.endswith("!"):
                node.set("use", "required")
    return root


def _named(root: Any, tag: str, name: str) -> Any:
    """Return a type of a schema; a new one if it has none of this name."""
    found = root.find(f"{XSD}{tag}[@name='{name}']")
    return etree.SubElement(root, f"{XSD}{tag}", name=name) if found is None else found


class Particle(NamedTuple):
    """An element of a content model, whether it may be missing, and whether it may be repeated."""

    element: Any
    optional: bool
    many: bool


def _particles(
    node: Any, groups: dict[str, Any], *, optional: bool = False, many: bool = False
) -> Iterator[Particle]:
    """Yield the elements of a content model in order."""
    for part in node:
        may_miss = optional or part.get("minOccurs") == "0"
        repeated = many or part.get("maxOccurs") == "unbounded"
        if part.tag == f"{XSD}element":
            yield Particle(part, may_miss, repeated)
        elif part.tag in (f"{XSD}sequence", f"{XSD}all", f"{XSD}choice"):
            may_miss = may_miss or part.tag == f"{XSD}choice"
            yield from _particles(part, groups, optional=may_miss, many=repeated)
        elif part.tag == f"{XSD}group":
            group = groups[part.get("ref")]
            yield from _particles(group, groups, optional=may_miss, many=repeated)


def _choice(complex_: Any) -> tuple[list[str], bool]:
    """Return the elements of a type of which there is one at most, and whether there must be."""
    choice = complex_.find(f"{XSD}choice")
    if choice is None or choice.get("maxOccurs") == "unbounded":
        return [], False
    if any(part.tag != f"{XSD}element" or part.get("maxOccurs") for part in choice):
        return [], False
    needed = all(part.get("minOccurs") != "0" for part in (choice, *choice))
    return [part.get("name") for part in choice], needed


def _is_deprecated(node: Any) -> bool:
    return "deprecated" in (node.findtext(f"{XSD}annotation/{XSD}appinfo") or "")


def _add(
    table: dict[str, list[Any]], node: Any, version: str, *, required: bool, many: bool = False
) -> None:
    name, type_ = node.get("name"), node.get("type")
    entry = table.setdefault(name, [type_, version, version, [], "", "", None, False])
    entry[0], entry[2] = type_, version
    if required:
        entry[3].append(version)
    if _is_deprecated(node):
        entry[4] = entry[4] or version
    entry[7] = many


def _in_order(orders: list[list[str]]) -> list[str]:
    """Merge the orders of the versions; the newest goes first, others keep their neighbours."""
    merged = list(orders[-1])
    for order in reversed(orders[:-1]):
        for index, name in enumerate(order):
            if name not in merged:
                before = merged.index(order[index - 1]) + 1 if index else 0
                merged.insert(before, name)
    return merged


def make() -> str:
    """Return the text of the table."""
    types: dict[str, dict[str, Any]] = {}
    orders: dict[str, list[list[str]]] = {}
    enums: dict[str, dict[str, list[str]]] = {}
    for version in VERSIONS:
        root = schema_of(version)
        groups = {group.get("name"): group for group in root.findall(f"{XSD}group")}
        for simple in root.findall(f"{XSD}simpleType"):
            for literal in simple.iter(f"{XSD}enumeration"):
                known = enums.setdefault(simple.get("name"), {})
                span = known.setdefault(literal.get("value"), [version, version, ""])
                span[1] = version
                if _is_deprecated(literal):
                    span[2] = span[2] or version
        for complex_ in root.findall(f"{XSD}complexType"):
            name = complex_.get("name")
            entry = types.setdefault(name, {"attributes": {}, "children": {}})
            entry["choice"], needed = _choice(complex_)
            if entry["choice"]:
                entry.setdefault("choice_since", version)
            entry.setdefault("needed", []).extend([version] if needed else [])
            entry["text"] = complex_.find(f"{XSD}simpleContent") is not None
            for attribute in complex_.iter(f"{XSD}attribute"):
                required = attribute.get("use") == "required"
                _add(entry["attributes"], attribute, version, required=required)
            particles = list(_particles(complex_, groups))
            for node, optional, many in particles:
                _add(entry["children"], node, version, required=not optional, many=many)
            orders.setdefault(name, []).append([each.element.get("name") for each in particles])
        (element,) = (e for e in root.findall(f"{XSD}element") if e.get("name") == ROOT)
    document = {ROOT: [element.get("type"), VERSIONS[0], VERSIONS[-1], [], "", "", None, False]}
    types[""] = {"attributes": {}, "children": document, "choice": [], "text": False, "needed": []}
    for name, found in orders.items():
        children = types[name]["children"]
        types[name]["children"] = {child: children[child] for child in _in_order(found)}
    _add_facts(types)
    return _text(types, enums)


def _add_facts(types: dict[str, Any]) -> None:
    """Add units and defaults."""
    facts = tomllib.loads(FACTS.read_text(encoding="utf-8"))
    units = {place: unit for unit, places in facts["units"].items() for place in places}
    for index, texts in ((5, units), (6, facts["defaults"])):
        for place, text in texts.items():
            type_, attribute = place.split(".")
            types[type_]["attributes"][attribute][index] = text


def _short(part: list[Any]) -> list[Any]:
    """Return a part without what is empty at its end."""
    while part and part[-1] in ("", None, False, []):
        part = part[:-1]
    return part


def _text(types: dict[str, Any], enums: dict[str, Any]) -> str:
    for name, type_ in types.items():
        types[name] = {key: part for key, part in type_.items() if part or key in LISTED}
        for parts in (type_["attributes"], type_["children"]):
            parts.update({name: _short(part) for name, part in parts.items()})
    lines = ["{", '"versions": ' + json.dumps(VERSIONS) + ",", '"types": {']
    lines.append(",\n".join(f"{json.dumps(n)}: {json.dumps(types[n])}" for n in sorted(types)))
    lines += ["},", '"enums": {']
    lines.append(",\n".join(f"{json.dumps(n)}: {json.dumps(enums[n])}" for n in sorted(enums)))
    return "\n".join([*lines, "}", "}", ""])


if __name__ == "__main__":
    TARGET.write_text(make(), encoding="utf-8")
