"""Imports one document."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from osc2tx.importing.actions import Actions
from osc2tx.importing.board import BoardReader
from osc2tx.importing.cast import Cast
from osc2tx.importing.conditions import Conditions
from osc2tx.importing.cursor import Ledger
from osc2tx.importing.declarations import Declarations, header_of, map_of
from osc2tx.importing.distributions import NOTHING, Distribution, Open
from osc2tx.importing.document import NOWHERE, Document, Folders, Refused
from osc2tx.importing.effects import Readings
from osc2tx.importing.endings import placed_beside
from osc2tx.importing.expressions import Untyped
from osc2tx.importing.ground import is_straight_ahead
from osc2tx.importing.libraries import COMMON, Library, Shared
from osc2tx.importing.marks import Marks
from osc2tx.importing.names import Names
from osc2tx.importing.parameters import Parameter
from osc2tx.importing.places import Places
from osc2tx.importing.program import ROAD, Declared, Program, read_by
from osc2tx.importing.report import Finding, ImportReport
from osc2tx.importing.signals import CONTROLLER, TrafficLights
from osc2tx.importing.starts import Starts
from osc2tx.importing.structure import Structure
from osc2tx.importing.substitution import is_of_carla, mirrored, with_values
from osc2tx.importing.surroundings import ENVIRONMENT
from osc2tx.importing.values import Values
from osc2tx.importing.whole import Whole, is_endless
from osc2tx.xosc import Element, Unreadable, read
from osc2tx.xosc.checking import problems, problems_of_entry, version_of
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.reader import Comment
from osc2tx_shared.classes import dataclass

LONG = 60
"""Characters of a comment that says more than a title."""
_ELEMENT = re.compile(r"\s*</?[A-Z]\w*[\s/>]")


@dataclass(frozen=True, slots=True)
class Imported:
    """The result of a document.

    Attributes:
        program: The scenario.
        report: What the import found.
        document: What was read.
        parameters: The parameters by their names in the document.
        actors: The names of the actors by those in the document.
        is_endless: Whether nothing ends the document.
        starts: Road, lane and s (m) at which the scenario puts actors first of all.
        source: Its file; `None` for standard input.
        distribution: Values for its runs.
    """

    program: Program
    report: ImportReport
    document: Document
    parameters: dict[str, Parameter]
    actors: dict[str, str]
    is_endless: bool
    starts: dict[str, tuple[str, int, float]]
    source: Path | None = None
    distribution: Distribution | None = None

    @property
    def name(self) -> str:
        """The name of the scenario."""
        return self.program.name

    @property
    def text(self) -> str:
        """The scenario, not formatted."""
        return self.program.text


def import_document(
    data: bytes,
    source: str,
    library: Library,
    *,
    path: Path | None = None,
    name: str = "",
    folders: Folders = NOWHERE,
    distribution: Distribution | None = None,
    varied: Mapping[str, Open] = NOTHING,
) -> Imported:
    """Return the scenario of a document.

    Args:
        data: The document.
        source: What to call it in the report.
        library: What scenarios share so far; gains what it needs.
        path: Its file, from which relative paths start.
        name: The name of the scenario; else that of the file.
        folders: Where maps and catalogs are.
        distribution: What its parameters may be.
        varied: What other scenarios that inherit it leave open; in itself they have their values.

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
    if distribution is not None:  # what no parameter can stand for is that of the first run
        root = with_values(root, distribution.first)
    if is_of_carla(root):
        root = mirrored(root)
    document = Document(root, path, comments, folders)
    said = name or (path.stem if path else "scenario")
    try:
        return _Import(document, source, library, said, distribution, varied).run()
    except Unresolved as error:
        raise Refused(error.reason, error.place or root.place) from None
    except OverflowError:
        raise Refused("a number in it is too large", root.place) from None
    except RecursionError:
        raise Refused("its events are nested too deep", root.place) from None


class _Import:
    """Imports one document."""

    def __init__(
        self,
        document: Document,
        source: str,
        library: Library,
        name: str,
        distribution: Distribution | None,
        varied: Mapping[str, Open],
    ) -> None:
        self._document = document
        self._open = {} if distribution is None else distribution.open
        self._report = ImportReport(source)
        self._ledger = Ledger(self._report)
        self._root = self._ledger.track(document.root)
        self._names = Names(self._report, (ROAD, ENVIRONMENT, CONTROLLER))
        self._scenario = self._names.new(name, kind="scenario")
        self._report.scenario = self._scenario
        library.scenarios.add(self._scenario)
        self._values = Values(document, self._names, self._open or varied)
        self._shared = Shared(library)
        self._cast = Cast(document, self._values, self._names, self._shared)
        self._marks = Marks(document, self._names, self._report)
        self._told: set[str] = set()
        self._comments: dict[object, list[str]] = {}
        for comment in document.comments:
            if _ELEMENT.match(comment.text):
                self._leave(comment.text, "it is a part of a document that is switched off")
            else:
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
        self._cast.share()
        actors = self._cast.actors
        names = {said: actor.name for said, actor in actors.items()}
        places = Places(self._document, self._values, self._names, names)
        leaves = bool(self._document.resolved_tagged("LaneChangeAction"))
        for said, actor in actors.items():
            body = places.bodies.get(said)
            actor.is_free = is_straight_ahead(places.map, body, beside=leaves)
        lights = TrafficLights(places.map, self._values, self._names)
        readings = Readings(
            self._document, self._values, places, actors, lights, self._marks, self._shared
        )
        actions, conditions = Actions(readings), Conditions(readings)
        storyboard = self._root.one("Storyboard")
        inits = Starts(storyboard, actions, self._cast)
        reader = BoardReader(self._values, self._names, actions, conditions, self._comments_of)
        board = reader.read(storyboard)
        structure = Structure(
            board,
            lambda base: self._names.new("", kind="event", base=base),
            {actor.name: actor for actor in actors.values()},
        )
        whole = Whole(self._document, self._cast, self._names, self._report, self._shared)
        program.body = whole.behavior(structure, structure.branches(), inits, board.end)
        self._find_used(program, places, structure)
        self._declare(program, readings, actions, structure)
        program.imports = [COMMON] if self._shared.is_used else []
        self._report.under_test = [each.name for each in actors.values() if each.is_under_test]
        for step in structure.events:
            if step.effects and structure.references[step.label] < 1:
                self._report.names.pop(f"event {step.node.element.get('name')}", None)
                step.node.idle("nothing refers to it by its name", "name")
        self._close()
        parameters = self._values.parameters
        return Imported(
            program,
            self._report,
            self._document,
            parameters,
            names,
            is_endless(board.end),
            inits.starts(placed_beside(program.body)),
        )

    # --- declarations -----------------------------------------------------------------------------

    def _header(self) -> list[str]:
        header = self._root.find("FileHeader")
        if header is None:
            return []
        if is_of_carla(self._document.root):
            note = "places of the world are in the coordinates of CARLA; they are mirrored"
            said = header.text("description") or ""
            self._report.note("description", said, note, header.place)
        return header_of(header, self._scenario) + self._comments.pop(None, [])

    def _comments_of(self, element: Element) -> list[str]:
        """Return the comments in an element, each once; a long one is only where it is first."""
        found = []
        for node in element.walk():
            for text in self._comments.pop(node.place, []):
                if text in found or (len(text) > LONG and text in self._told):
                    self._leave(text, "it repeats another one")
                else:
                    found.append(text)
        self._told.update(found)
        return found

    def _leave(self, comment: str, reason: str) -> None:
        """Note that the scenario does not have a comment."""
        self._report.note("comment", comment, reason)

    def _find_used(self, program: Program, places: Places, structure: Structure) -> None:
        """Note which parameters the scenario reads, itself or in what gives others."""
        if not self._values.parameters:
            return
        others = [*structure.declared, *places.points.declared]
        written = [*program.behavior, *(line for each in others for line in each.lines)]
        words = _words("\n".join(written))
        for parameter in reversed(self._values.parameters.values()):
            parameter.is_used = parameter.expression is not None and parameter.name in words
            if parameter.is_used:
                try:
                    words |= _words(self._values.of_parameter(parameter))
                except (Untyped, ValueError):
                    continue

    def _declare(
        self, program: Program, readings: Readings, actions: Actions, structure: Structure
    ) -> None:
        """Write what the behavior of a program reads."""
        values, lights = self._values, readings.lights
        declared = Declarations(self._root, values, self._report, self._open, self._comments_of)
        members = map_of(self._root, values, self._shared)
        if actions.surroundings.needs_environment:
            members.append(Declared(ENVIRONMENT, "environment"))
        if lights.is_switched:
            members.append(Declared(CONTROLLER, "traffic_light_controller"))
        members += lights.declared
        for node in self._document.tagged("ScenarioObject"):
            actor = self._cast.members.pop(node.get("name") or "", None)
            if actor is not None:
                actor.comments = self._comments_of(node)
                members.append(actor)
        program.members = [*members, *self._cast.couplings()]
        words = _words("\n".join(program.behavior))
        program.parameters = [
            *declared.parameters(),
            *read_by(readings.places.points.declared, words),
            *self._marks.members(words),
            *read_by(structure.declared, words),
        ]

    def _close(self) -> None:
        root = self._document.root
        for each, file in self._document.scoped:
            what, kind = f"parameter {each.get('name')}", each.get("parameterType")
            said, reason = f"{kind} {each.get('value')}", "its value stands where it is used"
            self._report.note(what, said, reason, each.place, file)
        for node, reason in self._document.refused:
            self._report.add(Finding("left out", f"<{node.tag}>", reason, node.place))
        version = version_of(root)
        found = [(each.reason, str(each.place or "")) for each in problems(root, version)]
        for entry, file in self._ledger.entries:
            wrong = problems_of_entry(entry, version)
            found += [(each.reason, f"{file}:{each.place or ''}") for each in wrong]
        self._report.problems = list(dict.fromkeys(found))
        for text in (each for texts in self._comments.values() for each in texts):
            self._leave(text, "it belongs to nothing that is imported")
        self._ledger.close()


def _words(text: str) -> set[str]:
    return set(re.findall(r"\w+", text))
