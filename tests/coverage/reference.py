"""What the reference shows of actions and modifiers beside their declarations, from scenarios."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from functools import cache

from lxml import etree

from osc2tx.backends.xosc import XmlScenario
from osc2tx.backends.xosc.actions import registry
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Entry as Loss
from osc2tx.losses.entries import Grade
from osc2tx.options import XML_VERSIONS, XmlVersion
from osc2tx.reference import Entry, entries
from osc2tx.reference.entries import TABLE
from osc2tx.syntax import ast
from osc2tx_runtime.simulators.carla.capabilities import how
from tests.coverage.sources import Source, scenarios, walk
from tests.coverage.xml import documents, losses

__all__ = ["TABLE", "render"]

UNFIT = {"hello_world", "C34_conflict_reported"}  # in the dialect of CARLA; shows a mistake
MUCH_XML = 1200  # characters, more than an example should have
ACTING = ("action", "modifier")
MAP_MODIFIERS = {name for name, each in catalogue().modifiers.items() if each.owner == "map"}


def render() -> str:
    """Return the table as JSON, with a line for each entry."""
    rows = {entry.key: _row(entry) for entry in entries() if _is_carried_out(entry)}
    lines = [f"{json.dumps(key)}: {json.dumps(row)}" for key, row in rows.items()]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _is_carried_out(entry: Entry) -> bool:
    known = catalogue()
    of_kind: Mapping[str, object] = (
        known.actions if entry.declaration.kind == "action" else known.modifiers
    )
    return entry.declaration.kind in ACTING and _name_of(entry) in of_kind


def _name_of(entry: Entry) -> str:
    """The name in the catalogue."""
    return entry.declaration.name if entry.declaration.kind == "action" else entry.own_name


def _row(entry: Entry) -> dict[str, str]:
    found = {"carla": _in_carla(entry), "xml": _in_xml(entry)}
    used = _example(entry)
    if used is not None:
        source, line, text = used
        found |= {"file": source.place, "example": text, "xml_example": _elements(source, line)}
    return {key: text for key, text in found.items() if text}


def _in_carla(entry: Entry) -> str:
    name, known = _name_of(entry), catalogue()
    if entry.declaration.kind == "action":
        action = known.actions[name]
        return how(name, moves=action.moves or bool(action.slots), needs=action.needs)
    modifier = known.modifiers[name]
    return how(name, moves=bool(modifier.slots), needs=modifier.needs)


# --- OpenSCENARIO XML ----------------------------------------------------------------------------


def _in_xml(entry: Entry) -> str:
    """Since when XML says it, by the reports of all scenarios; why not, by the catalogue."""
    known = catalogue()
    kind, name = entry.declaration.kind, _name_of(entry)
    item = known.actions[name] if kind == "action" else known.modifiers[name]
    if item.without_xml:
        return f"It has no form: {item.without_xml}."
    grades = losses().get(f"{kind} {entry.own_name}", {})
    for grade, words in ((Grade.EXACT, "Exact"), (Grade.APPROXIMATED, "Approximated")):
        since = next((v for v in XML_VERSIONS if grade in _of(grades.get(v, ()))), None)
        if since is not None:
            return f"{words} since OpenSCENARIO XML {since}{_remark(grades, grade)}."
    if kind == "modifier" and name in registry.AT_START:
        return "It has a form: the start of an actor, or the choice of the map."
    if name in MAP_MODIFIERS:
        return "It needs no form: roads are looked for before the XML is written."
    return _by_documents(entry)


def _of(found: Iterable[Loss]) -> set[Grade]:
    return {each.grade for each in found}


def _remark(grades: Mapping[XmlVersion, list[Loss]], best: Grade) -> str:
    """What is lost even in the newest version. Why something is refused depends on its use."""
    newest = grades.get(XML_VERSIONS[-1], ())
    reason = next((e.reason for e in newest if e.grade is Grade.APPROXIMATED), "")
    refused = Grade.INEXPRESSIBLE in _of(newest)
    if best is Grade.APPROXIMATED:
        return f": {reason}" + ("; some uses are refused" if refused else "")
    told = [f"; some uses are approximated: {reason}"] if reason else []
    return "".join([*told, *(["; some uses are refused"] if refused else [])])


def _by_documents(entry: Entry) -> str:
    """Of what reports do not speak as it is part of the start: the first document that has it."""
    used = _example(entry)
    versions = [v for v in XML_VERSIONS if used and _is_written(used[0], v)]
    return f"Exact since OpenSCENARIO XML {versions[0]}." if versions else "It has a form."


def _is_written(source: Source, version: XmlVersion) -> bool:
    return any(document.xml is not None for document in documents(source, version))


def _elements(source: Source, line: int) -> str:
    """The actions of the newest XML that come from a line; empty if there are none."""
    for document in documents(source, XML_VERSIONS[-1]):
        names = [
            (span.end - span.start, event)
            for event, span in document.origins.items()
            if _lines(document, event)[0] <= line <= _lines(document, event)[1]
        ]
        for _, name in sorted(names):
            text = _actions(document, name)
            if text:
                return text
    return ""


def _lines(document: XmlScenario, event: str) -> tuple[int, int]:
    span = document.origins[event]
    return span.source.position(span.start)[0], span.source.position(span.end)[0]


def _actions(document: XmlScenario, event: str) -> str:
    if document.xml is None:
        return ""
    root = etree.fromstring(document.xml.encode("utf-8"))
    found = [
        action
        for node in root.iter("Event")
        if node.get("name") == event
        for action in node.iterfind("Action/*")
        if action.find("VariableAction") is None and action.find("ParameterAction") is None
    ]
    texts = []
    for action in found:
        action.tail = None
        etree.indent(action, "  ")
        texts.append(etree.tostring(action, encoding="unicode"))
    return "\n".join(texts)


# --- examples ------------------------------------------------------------------------------------


def _example(entry: Entry) -> tuple[Source, int, str] | None:
    """The shortest use in a scenario, of those that XML has if there are any: line and text."""
    best = min(_uses(entry), key=lambda use: use[0], default=None)
    return None if best is None else best[1]


def _uses(entry: Entry) -> Iterator[tuple[tuple[bool, int, str], tuple[Source, int, str]]]:
    key = (entry.declaration.kind, entry.own_name)
    for source in scenarios():
        if source.path.stem in UNFIT:
            continue
        for statement in _statements(source).get(key, ()):
            line, text = _text(statement.span)
            without = not 0 < len(_elements(source, line)) <= MUCH_XML
            yield (without, len(text), source.place), (source, line, text)


@cache
def _statements(source: Source) -> Mapping[tuple[str, str], list[ast.Node]]:
    """What stands for each action and modifier that a scenario uses: all of an invocation."""
    found: dict[tuple[str, str], list[ast.Node]] = {}
    within: dict[ast.Node, ast.Node] = {}
    for node in walk(source.compilation.ast) if source.compilation.ast else ():
        if isinstance(node, ast.Invocation):
            within |= dict.fromkeys(node.with_members, node)
            found.setdefault(("action", node.behavior.text), []).append(node)
        elif isinstance(node, ast.ModifierApplication):
            found.setdefault(("modifier", node.modifier.text), []).append(within.get(node, node))
    return found


def _text(span: Span) -> tuple[int, str]:
    """The number of the first line, and all lines without their common indentation."""
    first, last = (span.source.position(at)[0] for at in (span.start, span.end))
    lines = span.source.text.splitlines()[first - 1 : last]
    return first, textwrap.dedent("\n".join(lines)).strip("\n")
