"""Imports one document."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path

from osc2tx.importing.actions import Actions
from osc2tx.importing.cast import Cast, Libraries
from osc2tx.importing.conditions import Conditions, Trigger
from osc2tx.importing.cursor import Ledger, Node
from osc2tx.importing.distributions import Distribution, Open
from osc2tx.importing.document import NOWHERE, Document, Folders, Refused
from osc2tx.importing.names import Names, snake
from osc2tx.importing.places import Places, Spot
from osc2tx.importing.program import Program, Statement, comment_lines, composed, declaration, wait
from osc2tx.importing.report import ImportReport
from osc2tx.importing.steps import BoardReader
from osc2tx.importing.structure import Branch, Structure
from osc2tx.importing.values import TYPES, Parameter, Untyped, Values, parsed
from osc2tx.xosc import Element, Unreadable, read
from osc2tx.xosc.checking import problems, version_of
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.reader import Comment
from osc2tx_shared.classes import dataclass

LONGEST = "60s"
"""How long a scenario runs whose document has no end."""

SIGNS = {
    "lessThan": "<",
    "greaterThan": ">",
    "lessOrEqual": "<=",
    "greaterOrEqual": ">=",
    "equalTo": "==",
    "notEqualTo": "!=",
}


@dataclass(frozen=True, slots=True)
class Imported:
    """The result of a document.

    Attributes:
        name: The name of the scenario.
        text: The scenario, not formatted.
        report: What the import found.
        document: What was read.
        parameters: The parameters by their names in the document.
        actors: The names of the actors by those in the document.
        starts: Road, lane and s (m) at which the scenario puts actors first of all.
    """

    name: str
    text: str
    report: ImportReport
    document: Document
    parameters: dict[str, Parameter]
    actors: dict[str, str]
    starts: dict[str, tuple[str, int, float]]


def import_document(
    data: bytes,
    source: str,
    libraries: Libraries,
    *,
    path: Path | None = None,
    name: str = "",
    folders: Folders = NOWHERE,
    distribution: Distribution | None = None,
) -> Imported:
    """Return the scenario of a document.

    Args:
        data: The document.
        source: What to call it in the report.
        libraries: The library files so far; gains those that it needs.
        path: Its file, from which relative paths start.
        name: The name of the scenario; else that of the file.
        folders: Where maps and catalogs are.
        distribution: What its parameters may be.

    Raises:
        Refused: It is no scenario, or cannot be read.
    """
    comments: list[Comment] = []
    try:
        root = read(data, comments=comments)
    except Unreadable as error:
        raise Refused(error.reason, error.place) from None
    if root.tag != "OpenSCENARIO":
        raise Refused(f"<{root.tag}> is no document of OpenSCENARIO XML", root.place)
    if not any(child.tag == "Storyboard" for child in root.children):
        raise Refused("it has no storyboard", root.place)
    document = Document(root, path, comments, folders)
    said = name or (path.stem if path else "scenario")
    try:
        return _Import(document, source, libraries, said, distribution).run()
    except RecursionError:
        raise Refused("its events are nested too deep", root.place) from None


class _Import:
    """Imports one document."""

    def __init__(
        self,
        document: Document,
        source: str,
        libraries: Libraries,
        name: str,
        distribution: Distribution | None,
    ) -> None:
        self._document = document
        self._open = {} if distribution is None else distribution.open
        self._report = ImportReport(source)
        self._ledger = Ledger(self._report)
        self._root = self._ledger.track(document.root)
        self._names = Names(self._report, ("road", "environment_"))
        self._scenario = self._names.new(name, kind="scenario")
        self._report.scenario = self._scenario
        self._values = Values(document, self._names)
        self._cast = Cast(document, self._values, self._ledger, self._names, libraries)
        self._marks: dict[tuple[str, str], str] = {}
        self._emitted: set[str] = set()
        self._comments: dict[object, list[str]] = {}
        for comment in document.comments:
            self._comments.setdefault(comment.within, []).append(comment.text)

    def run(self) -> Imported:
        """Import it."""
        program = Program(self._scenario)
        program.header = self._header()
        for entities in self._root.children("Entities"):
            for each in entities.children("ScenarioObject"):
                try:
                    self._cast.add(each)
                except (Unresolved, ValueError) as error:
                    each.leave_out(getattr(error, "reason", str(error)))
        actors = self._cast.actors
        kinds = {said: actor.name for said, actor in actors.items()}
        places = Places(self._document, self._values, self._names, kinds)
        actions = Actions(self._values, places, actors, self._mark, self._emitted)
        conditions = Conditions(
            self._values, places, actors, self._mark, self._document.parameters.get
        )
        storyboard = self._root.one("Storyboard")
        inits = _Init(storyboard, self._values, places, actions, self._cast)
        reader = BoardReader(
            self._document,
            self._values,
            self._ledger,
            self._names,
            actions,
            conditions,
            self._comments_of,
        )
        board = reader.read(storyboard)
        structure = Structure(
            board,
            lambda base: self._names.new("", kind="event", base=base),
            {actor.name: actor.goes_on for actor in actors.values()},
        )
        body = self._body(structure, structure.branches(), inits, board.end)
        program.body = body
        self._find_used(program, places, structure)
        program.declarations = self._declarations(places, actions, structure)
        program.imports = sorted(self._cast.imports)
        self._report.under_test = [each.name for each in actors.values() if each.is_under_test]
        self._close()
        parameters = self._values.parameters
        return Imported(
            self._scenario,
            program.text,
            self._report,
            self._document,
            parameters,
            kinds,
            inits.starts(places),
        )

    # --- declarations -----------------------------------------------------------------------------

    def _header(self) -> list[str]:
        header = self._root.find("FileHeader")
        if header is None:
            return []
        said = [header.text("description") or "", header.text("author") or ""]
        found = [said[0] or self._scenario]
        if said[1]:
            found.append(f"Author: {said[1]}")
        for each in header.children("License"):
            parts = [each.text("name"), each.text("spdxId"), each.text("resource")]
            found.append("Licence: " + ", ".join(part for part in parts if part))
        return found + self._comments.pop(None, [])

    def _comments_of(self, element: Element) -> list[str]:
        """Return the comments in an element, each once."""
        found = []
        for node in element.walk():
            found += self._comments.pop(node.place, [])
        return found

    def _mark(self, name: str, value: str) -> str:
        """Return the event that stands for a variable with a value."""
        key = (name, value)
        if key not in self._marks:
            base = snake(name) if value.lower() in ("true", "1", "") else snake(f"{name}_{value}")
            self._marks[key] = self._names.new("", kind="event", base=base)
            self._report.names[f"variable {name} = {value}"] = self._marks[key]
        return self._marks[key]

    def _find_used(self, program: Program, places: Places, structure: Structure) -> None:
        """Note which parameters the scenario reads, itself or in what gives others."""
        words = set(re.findall(r"\w+", "\n".join((program.text, *structure.lines, *places.lines))))
        for parameter in reversed(self._values.parameters.values()):
            parameter.is_used = parameter.name in words
            if parameter.is_used and parameter.expression is not None:
                try:
                    words |= set(re.findall(r"\w+", self._values.of_parameter(parameter)))
                except (Untyped, ValueError):
                    continue

    def _declarations(self, places: Places, actions: Actions, structure: Structure) -> list[str]:
        lines = self._map()
        if actions.needs_environment:
            lines.append("environment_: environment")
        for name in self._cast.actors:
            for node in self._document.root.below(Element):
                if node.tag == "ScenarioObject" and node.get("name") == name:
                    lines += comment_lines(self._comments_of(node))
        lines += self._cast.lines
        lines += self._parameters()
        if places.lines:
            lines += ["", *places.lines]
        events = [f"event {name}" for name in self._marks.values()]
        if events or structure.lines:
            lines += ["", *events, *structure.lines]
        return lines

    def _map(self) -> list[str]:
        network = self._root.find("RoadNetwork")
        if network is None:
            return []
        for each in network.children():
            if each.tag == "LogicFile":
                said = self._values.text(each, "filepath")
                found = self._document.map_file
                name = Path(said.replace("\\", "/")).name if found is None else found.name
                if found is None and said:
                    each.approximate(f"the map {said} is not found: places on it were not checked")
                if name:
                    return declaration("road", "map", [f'it.map_file == "{name}"'])
            elif each.tag == "SceneGraphFile":
                continue
            else:
                each.leave_out("of the network only the map is imported")
        return ["road: map"]

    def _parameters(self) -> list[str]:
        lines: list[str] = []
        for holder in self._root.children("ParameterDeclarations"):
            nodes = {
                each.element.get("name") or "": each
                for each in holder.children("ParameterDeclaration")
            }
            for said, parameter in self._values.parameters.items():
                if parameter.is_used and said in nodes:
                    lines += self._parameter(nodes[said], parameter)
                elif said in nodes:
                    nodes[said].use_all()
                    value = nodes[said].element.get("value") or ""
                    reason = "nothing that varies here reads it"
                    place = nodes[said].place
                    self._report.idle.append((f"parameter {said}", value, reason, str(place)))
        for holder in self._root.children("VariableDeclarations"):
            holder.use_all()
            for each in holder.children():
                said_ = f"variable {each.element.get('name')}", each.element.get("value") or ""
                self._report.idle.append((*said_, "variables are events here", str(each.place)))
        return ["", *lines] if lines else []

    def _parameter(self, node: Node, parameter: Parameter) -> list[str]:
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
        constraints = self._constraints(node, parameter)
        if said in self._open:
            varied = self._varied(node, self._open[said], parameter)
            if varied.startswith("it in "):
                value = ""
                constraints.insert(0, varied)
            elif varied:
                value = varied
        lines = list(comment_lines(self._comments_of(node.element)))
        return lines + declaration(parameter.name, kind, constraints, value)

    def _varied(self, node: Node, open_: Open, parameter: Parameter) -> str:
        """Return the range of a parameter, or its only value; nothing, with a finding, if none."""
        try:
            if len(open_.values) == 1:
                return self._values.in_unit(float(open_.values[0]), parameter)
            if open_.values:
                said = [self._values.in_unit(float(each), parameter) for each in open_.values]
                return f"it in [{', '.join(said)}]"
            limits = (self._values.in_unit(each, parameter) for each in (open_.low, open_.high))
            return f"it in [{'..'.join(limits)}]"
        except (ValueError, OverflowError):
            node.leave_out("its distribution has no form here")
            return ""

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
            expression = parsed(text)
            if parameter.is_hourly:
                return f"it {sign} {self._values._hourly(expression).text}"
            if not text.startswith("$"):
                return f"it {sign} {self._values.in_unit(float(text), parameter)}"
            return f"it {sign} {self._values._typed(expression, parameter.dimension, 0.0).text}"
        except (Untyped, ValueError):
            node.leave_out(f"`{rule} {text}` has no form with units")
            return None

    # --- behavior ---------------------------------------------------------------------------------

    def _body(
        self, structure: Structure, branches: Sequence[Branch], inits: _Init, end: Trigger
    ) -> Statement:
        actors = list(self._cast.actors.items())
        leading: list[Statement] = list(inits.world)
        by_name = {
            actor.name: [b for b in branches if actor.name in b.actors] for _, actor in actors
        }
        single = {id(b) for b in branches if len(b.actors) == 1}
        shared = [actor.name for _, actor in actors if len(by_name[actor.name]) > 1]
        members: list[Statement] = []
        placed: set[str] = set()
        is_open = True
        order = inits.order([said for said, _ in actors])
        together = bool(shared) or inits.has_relations
        for said in order:
            actor = self._cast.actors[said]
            mine = by_name[actor.name]
            is_alone = not mine or (len(mine) == 1 and id(mine[0]) in single)
            stays = is_alone and (not together or inits.turns_alone(said))
            if actor.kind != "movable_object" and stays:
                continue
            leading += inits.statements(said)
            placed.add(said)
        for said in order:
            actor = self._cast.actors[said]
            if by_name[actor.name] or actor.kind == "movable_object" or not inits.places(said):
                continue
            if said in placed:
                members += inits.lasting(said) or structure.go_on([actor.name])
            else:
                members.append(composed("serial", inits.going_on(said)))
        for branch in branches:
            branch_said = [said for said, actor in actors if by_name[actor.name] == [branch]]
            own = [
                said for said, actor in actors if actor.name in branch.actors and said not in placed
            ]
            before = [each for said in own for each in inits.statements(said, branch.members)]
            content = [*before, *branch.members]
            if branch.members and branch.members[0].text.startswith("wait "):
                lasting = [each for said in branch_said for each in inits.lasting(said)]
                content = [*before, *lasting, *branch.members]
            alone = [actor.name for _, actor in actors if by_name[actor.name] == [branch]]
            if content:
                content += structure.go_on(alone) if content[-1].length != math.inf else ()
            is_open = is_open and content[-1:] != [] and content[-1].length == math.inf
            if content:
                members.append(composed("serial", content))
        if not members and not leading:
            members = [wait(f"elapsed({LONGEST})")]
        return self._ended(structure, leading, members, end, is_open=is_open, branches=branches)

    def _ended(
        self,
        structure: Structure,
        leading: list[Statement],
        members: list[Statement],
        end: Trigger,
        *,
        is_open: bool,
        branches: Sequence[Branch],
    ) -> Statement:
        never = all(any(each.kind == "never" for each in group) for group in end.groups)
        endings: list[str] = []
        if not end.groups or never:
            self._report.add(
                "approximated",
                "<StopTrigger>",
                f"nothing ends the document; the scenario ends after {LONGEST}",
                self._document.root.place,
            )
            endings.append(f"elapsed({LONGEST})")
        for group in end.groups if not never else ():
            waits = structure.waits(Trigger([group]))
            if not waits:
                endings.append("elapsed(0s)")
            elif len(waits) == 1 and waits[0].text.startswith("wait "):
                endings.append(waits[0].text.removeprefix("wait "))
            else:
                name = self._names.new("", kind="event", base="finished")
                structure.lines.append(f"event {name}")
                members.append(composed("serial", [*waits, Statement(f"emit {name}")]))
                endings.append(f"@{name}")
        if not is_open or not members:
            if len(endings) == 1 and endings[0].startswith("elapsed("):
                members.append(wait(endings[0]))
            else:
                structure.lines.append("event forever")
                members.append(wait("@forever"))
        whole = Statement("parallel", members=members)
        whole.modifiers = [f"until {each}" for each in endings]
        return composed("serial", [*leading, whole]) if leading else whole

    def _close(self) -> None:
        root = self._document.root
        self._report.problems = [
            (each.reason, str(each.place or "")) for each in problems(root, version_of(root))
        ]
        rest = [text for place, texts in self._comments.items() for text in texts]
        for text in rest:
            self._report.idle.append(("comment", text, "it stands beside nothing that is here", ""))
        self._ledger.close()


class _Init:
    """How the actors of a document begin.

    Attributes:
        world: What concerns no actor.
    """

    def __init__(
        self, storyboard: Node, values: Values, places: Places, actions: Actions, cast: Cast
    ) -> None:
        self._cast = cast
        self._actions = actions
        self.world: list[Statement] = []
        self._spots: dict[str, tuple[Spot, Node]] = {}
        self._speeds: dict[str, Statement] = {}
        self._others: dict[str, list[Statement]] = {}
        self._references: dict[str, set[str]] = {}
        init = storyboard.find("Init")
        for holder in () if init is None else init.children("Actions"):
            for node in holder.children():
                if node.tag == "Private":
                    self._private(node, values, places)
                elif node.tag == "GlobalAction":
                    self.world += [
                        each.statement for each in actions.effects(node, (), at_start=True)
                    ]
                else:
                    node.leave_out("actions of a user are for one tool")

    def _private(self, node: Node, values: Values, places: Places) -> None:
        said = values.text(node, "entityRef")
        actor = self._cast.actors.get(said)
        if actor is None:
            node.leave_out(f"there is no entity {said}")
            return
        for action in node.children("PrivateAction"):
            inner = next(action.children(), None)
            if inner is None:
                action.leave_out("it is empty")
                continue
            self._references.setdefault(said, set()).update(
                ref for each in inner.element.walk() if (ref := each.get("entityRef")) is not None
            )
            if inner.tag == "TeleportAction":
                try:
                    spot = places.spot(inner.one("Position"), actor.name, at_start=True)
                except Unresolved as error:
                    inner.leave_out(error.reason)
                    spot = None
                if spot is not None:
                    self._spots[said] = (spot, inner)
                continue
            for effect in self._actions.effects(action, (said,), at_start=True):
                if effect.statement.text.startswith(f"{actor.name}.assign_speed("):
                    self._speeds[said] = effect.statement
                else:
                    self._others.setdefault(said, []).append(effect.statement)

    def order(self, said: Sequence[str]) -> list[str]:
        """Return entities with those that others refer to first."""
        left, found = list(said), list[str]()
        while left:
            ready = [
                each
                for each in left
                if not (self._references.get(each, set()) - {each}) & set(left)
            ] or left[:1]
            found += ready
            left = [each for each in left if each not in ready]
        return found

    def _on_foot(self, said: str) -> list[str]:
        """Return the modifiers of an actor that begins at a point, with a heading of its own."""
        spot, _ = self._spots[said]
        point = spot.argument.removeprefix("position: ")
        modifiers = [f"position(at_point: {point}, project_on_route: false, at: start)"]
        if spot.yaw:
            modifiers.append(_at_start(spot.yaw))
        speed = self._speeds.get(said)
        if speed is not None:
            value = speed.text.removeprefix(f"{self._cast.actors[said].name}.assign_speed(")[:-1]
            modifiers.append(f"speed({value})")
        return modifiers

    @property
    def has_relations(self) -> bool:
        """Whether an actor begins at a place beside another one."""
        return any(spot.modifiers for spot, _ in self._spots.values())

    def places(self, said: str) -> bool:
        """Whether an entity is put anywhere, or does anything."""
        return said in self._spots or bool(self._others.get(said))

    def starts(self, places: Places) -> dict[str, tuple[str, int, float]]:
        """Return the lanes in which actors are put, with the s (m) along their roads."""
        found = {
            said: places.bodies[said].place
            for said, (spot, _) in self._spots.items()
            if said in places.bodies and spot.argument.startswith("odr_point")
        }
        return {
            self._cast.actors[said].name: (place.road, place.lane, place.s)
            for said, place in found.items()
            if place is not None
        }

    def turns_alone(self, said: str) -> bool:
        """Whether an entity has a heading of its own, and no other one begins beside it."""
        found = self._spots.get(said)
        others = (refs for name, refs in self._references.items() if name != said)
        return found is not None and bool(found[0].yaw) and not any(said in refs for refs in others)

    def _is_at_point(self, said: str) -> bool:
        found = self._spots.get(said)
        return found is not None and found[0].argument.startswith("position: ")

    def going_on(self, said: str) -> list[Statement]:
        """Return how an actor begins and goes on."""
        actor = self._cast.actors[said]
        if self._is_at_point(said) and not self._others.get(said):
            modifiers = self._on_foot(said)
            return [Statement(f"{actor.verb}()", modifiers=modifiers, length=math.inf)]
        last = Statement(actor.goes_on, length=math.inf)
        return [*self.statements(said), *(self.lasting(said) or [last])]

    def statements(self, said: str, then: list[Statement] | None = None) -> list[Statement]:
        """Return how an actor begins, at once.

        Args:
            said: The entity.
            then: What follows: a first wait in it ends the way up to there.
        """
        actor = self._cast.actors[said]
        others = self._others.get(said, [])
        is_wait = bool(then) and then is not None and then[0].text.startswith("wait ")
        if is_wait and not others and said in self._spots:
            if self._is_at_point(said):
                modifiers = self._on_foot(said)
                return [Statement(f"{actor.verb}()", modifiers=modifiers, length=math.inf)]
            last = Statement(actor.goes_on, length=math.inf)
            return [*self.statements(said), last]
        found: list[Statement] = []
        if said in self._spots:
            spot, node = self._spots[said]
            if spot.yaw:
                node.approximate("it looks along its lane at the start")
            found += [each.statement for each in self._actions.moved(spot, actor)]
        if said in self._speeds:
            found.append(self._speeds[said])
        return [*found, *(each for each in others if each.length == 0.0)]

    def lasting(self, said: str) -> list[Statement]:
        """Return what an entity does from the start on, and goes on with."""
        others = [each for each in self._others.get(said, []) if each.length != 0.0]
        if not others:
            return []
        last = Statement(self._cast.actors[said].goes_on, length=math.inf)
        found = composed("serial", [*others, last])
        found.length = math.inf
        return [found]


def _at_start(modifier: str) -> str:
    return f"{modifier[:-1]}, at: start)"
