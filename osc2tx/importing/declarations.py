"""The header of a document as comments, its map and its parameters as declarations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite
from pathlib import Path

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import TYPES
from osc2tx.importing.distributions import Open, meets
from osc2tx.importing.expressions import Untyped, joined_by
from osc2tx.importing.libraries import Shared
from osc2tx.importing.parameters import Parameter
from osc2tx.importing.place_conditions import COMPARISONS
from osc2tx.importing.program import ROAD, Declared
from osc2tx.importing.report import ImportReport
from osc2tx.importing.statements import LINE
from osc2tx.importing.values import Values
from osc2tx.xosc import Element


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


def map_of(root: Node, values: Values, shared: Shared) -> list[Declared]:
    """Return the declaration of the map of a document; of a type of the library if it has one."""
    network, name = root.find("RoadNetwork"), ""
    if network is None:
        return []
    for each in network.children():
        if each.tag == "LogicFile" and not each.has("filepath"):
            each.leave_out("it has no filepath")
        elif each.tag == "LogicFile":
            said, found = values.text(each, "filepath"), values.document.map_file
            name = Path(said.replace("\\", "/")).name if found is None else found.name
            if found is None and said:
                each.approximate(f"the map {said} is not found: places on it were not checked")
        elif each.tag != "SceneGraphFile":
            each.leave_out("of the network only the map is imported")
        if name:
            break
    if name and shared.is_used:
        return [Declared(ROAD, shared.map_of(name))]
    return [Declared(ROAD, "map", [f'it.map_file == "{name}"'] if name else [])]


class Declarations:
    """Writes the parameters of a document."""

    def __init__(
        self,
        root: Node,
        values: Values,
        report: ImportReport,
        open_: Mapping[str, Open],
        comments_of: Callable[[Element], list[str]],
    ) -> None:
        """Take the document.

        Args:
            root: Its root.
            values: Its parameters.
            report: Takes what is not said.
            open_: What its parameters may be in runs.
            comments_of: Gives the comments of an element.
        """
        self._root, self._values, self._report = root, values, report
        self._open, self._comments_of = open_, comments_of

    def parameters(self) -> list[Declared]:
        """Return those of the parameters that are read."""
        found: list[Declared] = []
        for holder in self._root.children("ParameterDeclarations"):
            nodes = {
                each.element.get("name") or "": each
                for each in holder.children("ParameterDeclaration")
            }
            for said, parameter in self._values.parameters.items():
                if parameter.is_used and said in nodes:
                    found.append(self._parameter(nodes[said], parameter))
                elif said in nodes:
                    nodes[said].use_all()
                    value = nodes[said].element.get("value") or ""
                    reason = "nothing reads it"
                    if said in self._values.aliases:
                        reason = "it repeats another one, in its unit or with a sign"
                    self._report.note(f"parameter {said}", value, reason, nodes[said].place)
        for holder in self._root.children("VariableDeclarations"):
            holder.use_all()
            for each in holder.children():
                what, value = (
                    f"variable {each.element.get('name')}",
                    each.element.get("value") or "",
                )
                self._report.note(what, value, "variables are events here", each.place)
        return found

    def _parameter(self, node: Node, parameter: Parameter) -> Declared:
        said = node.said("name")
        node.text("parameterType")
        node.text("value")
        kind = TYPES[parameter.dimension] if parameter.kind == "double" else "int"
        try:
            value = self._values.of_parameter(parameter)
        except Untyped:
            node.approximate("what gives it has no form here, so it has its nominal value")
            value = self._values.in_unit(float(self._values.document.parameters[said]), parameter)
        constraints, varied = self._constraints(node, parameter), ""
        if said in self._open:
            constraints = constraints if not self._is_kept(node, self._open[said]) else []
            varied = self._varied(node, self._open[said], parameter)
            if varied.startswith("in "):
                value = ""
                constraints.insert(0, f"it {varied}")
            elif varied:
                value = varied.removeprefix("== ")
        comments = self._comments_of(node.element)
        return Declared(parameter.name, kind, constraints, value, comments, varied)

    def _varied(self, node: Node, open_: Open, parameter: Parameter) -> str:
        """Return the range of a parameter, or its only value; nothing, with a finding, if none."""
        try:
            if len(open_.values) == 1:
                return f"== {self._values.in_unit(float(open_.values[0]), parameter)}"
            if open_.values:
                said = [self._values.in_unit(float(each), parameter) for each in open_.values]
                return f"in [{', '.join(said)}]"
            limits = (self._values.in_unit(each, parameter) for each in (open_.low, open_.high))
            return f"in [{'..'.join(limits)}]"
        except (ValueError, OverflowError):
            node.leave_out("its distribution has no form here")
            return ""

    def _is_kept(self, node: Node, open_: Open) -> bool:
        """Whether all that a parameter may be meets its constraints; they change nothing then."""
        limits = tuple(repr(each) for each in (open_.low, open_.high) if isfinite(each))
        values = open_.values if len(open_.values) > 1 else limits
        if len(values) < 2 or not all(meets(node.element, each) for each in values):
            return False
        for group in node.children("ConstraintGroup"):
            for each in group.children():
                each.idle("the values of its distribution are within it")
        return True

    def _constraints(self, node: Node, parameter: Parameter) -> list[str]:
        groups = [
            [self._constraint(each, parameter) for each in group.children("ValueConstraint")]
            for group in node.children("ConstraintGroup")
        ]
        told = [list(filter(None, each)) for each in groups]
        if len(told) == 1:
            return told[0]
        either = [" and ".join(each) for each in told]
        return [joined_by("or", either)] if either and all(either) else []

    def _constraint(self, node: Node, parameter: Parameter) -> str | None:
        rule, text = node.said("rule"), node.said("value")
        try:
            return f"it {COMPARISONS[rule]} {self._values.as_parameter(text, parameter)}"
        except (Untyped, KeyError, ValueError):
            node.leave_out(f"`{rule} {text}` has no form with units")
            return None
