"""Writes `osc2tx/backends/xosc/xml/schema.json`: what each version of OpenSCENARIO XML has.

Read from the schemas that `asam-qc-openscenarioxml` ships (extra `test`); they end with 1.3, and
`xosc_1_4.toml` has the additions of 1.4. One type a line:

    "Event": {"attributes": {NAME: [TYPE, SINCE, UNTIL, REQUIRED]}, "children": {…}}

REQUIRED lists the versions in which it cannot be left out. Children are in the order of the schema.
`enums` holds the literals of each enumeration with the versions that have them.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

from lxml import etree

TARGET = Path(__file__).parents[1] / "osc2tx" / "backends" / "xosc" / "xml" / "schema.json"
ADDITIONS = Path(__file__).with_name("xosc_1_4.toml")
SCHEMAS = {"1.0": "1.0.0", "1.1": "1.1.1", "1.2": "1.2.0", "1.3": "1.3.0"}
VERSIONS = (*SCHEMAS, "1.4")
XSD = "{http://www.w3.org/2001/XMLSchema}"
ROOT = "OpenSCENARIO"


def schema_of(version: str) -> Any:
    """Return the root of the schema of a version."""
    if version == "1.4":
        return _with_additions(schema_of("1.3"))
    folder = files("qc_openscenario") / "schema" / SCHEMAS[version]
    return etree.fromstring((folder / f"{ROOT}.xsd").read_bytes())


def _with_additions(root: Any) -> Any:
    """Add to the schema of 1.3 the additions of 1.4; all of them can be left out."""
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
        if type_.find(f"{XSD}sequence") is None:
            type_.insert(0, etree.Element(f"{XSD}sequence"))
        for child, of in children.items():
            etree.SubElement(type_[0], f"{XSD}element", name=child, type=of, minOccurs="0")
    for name, attributes in new["attributes"].items():
        for attribute, of in attributes.items():
            type_ = _named(root, "complexType", name)
            etree.SubElement(type_, f"{XSD}attribute", name=attribute, type=of)
    return root


def _named(root: Any, tag: str, name: str) -> Any:
    """Return a type of a schema; a new one if it has none of this name."""
    found = root.find(f"{XSD}{tag}[@name='{name}']")
    return etree.SubElement(root, f"{XSD}{tag}", name=name) if found is None else found


def _particles(node: Any, groups: dict[str, Any], *, optional: bool) -> Iterator[tuple[Any, bool]]:
    """Yield the elements of a content model in order, and whether each may be missing."""
    for part in node:
        if part.tag == f"{XSD}element":
            yield part, optional or part.get("minOccurs") == "0"
        elif part.tag in (f"{XSD}sequence", f"{XSD}all", f"{XSD}choice"):
            may_miss = optional or part.tag == f"{XSD}choice" or part.get("minOccurs") == "0"
            yield from _particles(part, groups, optional=may_miss)
        elif part.tag == f"{XSD}group":
            may_miss = optional or part.get("minOccurs") == "0"
            yield from _particles(groups[part.get("ref")], groups, optional=may_miss)


def _add(table: dict[str, list[Any]], name: str, type_: str, version: str, required: bool) -> None:
    entry = table.setdefault(name, [type_, version, version, []])
    entry[0], entry[2] = type_, version
    if required:
        entry[3].append(version)


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
    types: dict[str, dict[str, dict[str, list[Any]]]] = {}
    orders: dict[str, list[list[str]]] = {}
    enums: dict[str, dict[str, list[str]]] = {}
    for version in VERSIONS:
        root = schema_of(version)
        groups = {group.get("name"): group for group in root.findall(f"{XSD}group")}
        for simple in root.findall(f"{XSD}simpleType"):
            for literal in simple.iter(f"{XSD}enumeration"):
                span = enums.setdefault(simple.get("name"), {}).setdefault(
                    literal.get("value"), [version, version]
                )
                span[1] = version
        for complex_ in root.findall(f"{XSD}complexType"):
            name = complex_.get("name")
            entry = types.setdefault(name, {"attributes": {}, "children": {}})
            for attribute in complex_.iter(f"{XSD}attribute"):
                required = attribute.get("use") == "required"
                type_ = attribute.get("type")
                _add(entry["attributes"], attribute.get("name"), type_, version, required)
            order: list[str] = []
            for element, optional in _particles(complex_, groups, optional=False):
                order.append(element.get("name"))
                type_ = element.get("type")
                _add(entry["children"], element.get("name"), type_, version, not optional)
            orders.setdefault(name, []).append(order)
        (element,) = (e for e in root.findall(f"{XSD}element") if e.get("name") == ROOT)
        types.setdefault(
            "", {"attributes": {}, "children": {ROOT: ["", VERSIONS[0], VERSIONS[-1], []]}}
        )
        types[""]["children"][ROOT][0] = element.get("type")
    for name, found in orders.items():
        children = types[name]["children"]
        types[name]["children"] = {child: children[child] for child in _in_order(found)}
    return _text(types, enums)


def _text(types: dict[str, Any], enums: dict[str, Any]) -> str:
    lines = ["{", '"versions": ' + json.dumps(VERSIONS) + ",", '"types": {']
    lines.append(",\n".join(f"{json.dumps(n)}: {json.dumps(types[n])}" for n in sorted(types)))
    lines += ["},", '"enums": {']
    lines.append(",\n".join(f"{json.dumps(n)}: {json.dumps(enums[n])}" for n in sorted(enums)))
    return "\n".join([*lines, "}", "}", ""])


if __name__ == "__main__":
    TARGET.write_text(make(), encoding="utf-8")
