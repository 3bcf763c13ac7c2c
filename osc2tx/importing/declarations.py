"""The parameters of a document, and its map, as declarations."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite
from pathlib import Path

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import TYPES
from osc2tx.importing.distributions import Open, meets
from osc2tx.importing.document import Document
from osc2tx.importing.expressions import Untyped
from osc2tx.importing.libraries import Shared
from osc2tx.importing.parameters import Parameter
from osc2tx.importing.program import ROAD, Declared
from osc2tx.importing.report import ImportReport
from osc2tx.importing.values import Values
from osc2tx.xosc import Element

SIGNS = {
    "lessThan": "<",
    "greaterThan": ">",
    "lessOrEqual": "<=",
    "greaterOrEqual": ">=",
    "equalTo": "==",
    "notEqualTo": "!=",
}


class Declarations:
    """Writes what a document declares."""

    def __init__(
        self,
        document: Document,
        root: Node,
        values: Values,
        report: ImportReport,
        open_: Mapping[str, Open],
        comments_of: Callable[[Element], list[str]],
        shared: Shared,
    ) -> None:
        """Take the document.

        Args:
            document: The document.
            root: Its root.
            values: Its parameters.
            report: Takes what is not said.
            open_: What its parameters may be in runs.
            comments_of: Gives the comments of an element.
            shared: The library, which has the map as well if the scenario needs it.
        """
        self._shared = shared
        self._document, self._root, self._values = document, root, values
        self._report, self._open, self._comments_of = report, open_, comments_of

    def map(self) -> list[Declared]:
        """Return the declaration of the map."""
        network = self._root.find("RoadNetwork")
        if network is None:
            return []
        for each in network.children():
            if each.tag == "LogicFile":
                if not each.has("filepath"):
                    each.leave_out("it has no filepath")
                    continue
                said = self._values.text(each, "filepath")
                found = self._document.map_file
                name = Path(said.replace("\\", "/")).name if found is None else found.name
                if found is None and said:
                    each.approximate(f"the map {said} is not found: places on it were not checked")
                if name and self._shared.is_used:
                    return [Declared(ROAD, self._shared.map_of(name))]
                if name:
                    return [Declared(ROAD, "map", [f'it.map_file == "{name}"'])]
            elif each.tag == "SceneGraphFile":
                continue
            else:
                each.leave_out("of the network only the map is imported")
        return [Declared(ROAD, "map")]

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
                    place = nodes[said].place
                    self._report.idle.append((f"parameter {said}", value, reason, str(place)))
        for holder in self._root.children("VariableDeclarations"):
            holder.use_all()
            for each in holder.children():
                said_ = f"variable {each.element.get('name')}", each.element.get("value") or ""
                self._report.idle.append((*said_, "variables are events here", str(each.place)))
        return found

    def _parameter(self, node: Node, parameter: Parameter) -> Declared:
        said = node.said("name")
        node.text("parameterType")
        node.text("value")
        is_whole = parameter.kind not in ("double",)
        kind = "int" if is_whole else TYPES[parameter.dimension]
        try:
            value = self._values.of_parameter(parameter)
        except Untyped:
            node.approximate("what gives it has no form here, so it has its nominal value")
            value = self._values.in_unit(float(self._document.parameters[said]), parameter)
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
        groups = []
        for group in node.children("ConstraintGroup"):
            told = [
                text
                for each in group.children("ValueConstraint")
                if (text := self._constraint(each, parameter)) is not None
            ]
            groups.append(" and ".join(told))
        if not all(groups):
            return []
        if len(groups) == 1:
            return groups[0].split(" and ")
        return (
            [" or ".join(f"({each})" if " and " in each else each for each in groups)]
            if groups
            else []
        )

    def _constraint(self, node: Node, parameter: Parameter) -> str | None:
        rule, text = node.said("rule"), node.said("value")
        sign = SIGNS.get(rule)
        try:
            if sign is None:
                raise Untyped(rule)
            expression = self._values.parsed(text)
            if parameter.is_hourly:
                return f"it {sign} {self._values._hourly(expression).text}"
            if not text.startswith("$"):
                return f"it {sign} {self._values.in_unit(float(text), parameter)}"
            return f"it {sign} {self._values._typed(expression, parameter.dimension, 0.0).text}"
        except (Untyped, ValueError):
            node.leave_out(f"`{rule} {text}` has no form with units")
            return None
