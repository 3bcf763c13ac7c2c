"""Entities as actors; those of catalogs are of types in the library.

Controllers make an actor the system under test, and say nothing else.
"""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import LENGTH, literal
from osc2tx.importing.document import Document
from osc2tx.importing.libraries import Shared
from osc2tx.importing.names import Names, snake
from osc2tx.importing.program import Declared, keeps
from osc2tx.importing.statements import Call, call
from osc2tx.importing.values import Values
from osc2tx_shared.classes import dataclass

CATEGORIES: Mapping[str, str] = {
    "car": "car",
    "van": "car",
    "truck": "truck",
    "semitrailer": "trailer",
    "trailer": "trailer",
    "bus": "bus",
    "motorbike": "vru_vehicle",
    "bicycle": "vru_vehicle",
    "train": "other",
    "tram": "other",
}
"""Categories of vehicles in DSL 2.1."""

RENAMED = {"van", "semitrailer", "motorbike", "bicycle", "train", "tram"}
KINDS = ("Vehicle", "Pedestrian", "MiscObject")
DRIVEN = "controllers drive nothing here: what drives the actor under test does"


@dataclass
class Actor:
    """An entity of the document.

    Attributes:
        said: Its name in the document.
        name: Its name in the scenario.
        kind: `vehicle`, `person` or `movable_object`.
        is_under_test: Whether a controller drives it.
        is_free: No bend lies ahead of its start: without an action it holds its speed.
    """

    said: str
    name: str
    kind: str
    is_under_test: bool = False
    is_free: bool = False

    @property
    def moves(self) -> Call:
        """The invocation that does what its modifiers say."""
        return call(self.name, {"vehicle": "drive", "person": "walk"}.get(self.kind, "move"))

    @property
    def goes_on(self) -> Call:
        """The invocation that goes on as the actor does."""
        return call(self.name, "keep_speed")


TRAILERS = ("trailer", "semitrailer")


def facts(node: Node, document: Document) -> tuple[str, list[str]]:
    """Return the type of an entity, and what is known about it, as constraints."""
    found: list[str] = []
    kind = {"Vehicle": "vehicle", "Pedestrian": "person"}.get(node.tag, "movable_object")
    category = document.text_at(
        node.text(f"{snake(node.tag).replace('misc_object', 'miscObject')}Category") or ""
    )
    if node.tag == "Vehicle":
        said = CATEGORIES.get(category, "other")
        if category in RENAMED or category not in CATEGORIES:
            node.approximate(f"DSL 2.1 has no category {category}, so it is {said}")
        found.append(f"vehicle_category == {said}")
        kind = "trailer" if category in TRAILERS else kind
        found += _halves(node, kind, document)
    elif category and category not in ("pedestrian", "none", "obstacle"):
        node.approximate(f"its category {category} has no counterpart in the DSL")
    box = node.find("BoundingBox")
    if box is not None:
        found += _box(box, kind, document)
    for name in ("role", "model"):
        if node.has(name) and (name, node.tag) != ("model", "Pedestrian"):
            node.approximate(f"{name}={node.text(name)!r} has no counterpart in the DSL")
    return kind, found


def _halves(node: Node, kind: str, document: Document) -> list[str]:
    """Return where a vehicle is coupled."""
    tag, name = (
        ("TrailerCoupler", "coupler") if kind == "trailer" else ("TrailerHitch", "trailer_receiver")
    )
    found = []
    for half in node.children(tag):
        half.idle("vehicles are coupled on the ground", "dz")
        x = float(document.text_at(half.text("dx") or "0"))
        found.append(f"{name}.position_x == {literal(x, LENGTH)}")
    return found


def _box(box: Node, kind: str, document: Document) -> list[str]:
    sizes, center = box.find("Dimensions"), box.find("Center")
    found = []
    for name in ("length", "width", "height"):
        if sizes is None:
            break
        value = float(document.text_at(sizes.text(name) or "0"))
        if value > 0.0:
            found.append(f"bounding_box.{name} == {literal(value, LENGTH)}")
    for name in ("x", "y", "z"):
        if center is None:
            break
        value = float(document.text_at(center.text(name) or "0"))
        if name == "z":
            center.idle("actors stand on the ground", "z")
            continue
        if kind in ("vehicle", "trailer") and name == "x":
            found.append(f"bounding_box.center.x == {literal(value, LENGTH)}")
        elif abs(value) > 1e-6:
            center.approximate(f"its box is {value:g} m from its origin along {name}, here none")
    return found


class Cast:
    """The actors of a scenario.

    Attributes:
        actors: By their names in the document.
        members: Their declarations, by their names in the document.
        tows: Names of trailers in the document with those of the actors that tow them.
    """

    def __init__(self, document: Document, values: Values, names: Names, shared: Shared) -> None:
        self.actors: dict[str, Actor] = {}
        self.members: dict[str, Declared] = {}
        self.tows: dict[str, tuple[str, Node]] = {}
        self._own: dict[str, Node] = {}
        self._document, self._values = document, values
        self._names, self._shared = names, shared

    def add(self, node: Node) -> None:
        """Take an entity.

        Raises:
            Unresolved: It has no name or no object.
        """
        said = node.said("name")
        name = self._names.new(said, kind="actor")
        controllers = list(node.children("ObjectController"))
        for each in controllers:
            note_controllers(each, self._document)
        for child in node.children(*KINDS):
            kind, constraints = facts(child, self._document)
            self.members[said] = Declared(name, kind, [f"it.{each}" for each in constraints])
            self._own[said] = child
            self.actors[said] = Actor(said, name, _moving(kind), bool(controllers))
            self._note_trailers(child, name)
            return
        reference = node.find("CatalogReference")
        if reference is None:
            for child in node.children("ExternalObjectReference"):
                child.leave_out("what it is stands in another document")
            type_name = kind = "vehicle"
        else:
            type_name, kind = self._of_catalog(reference, name)
        self.members[said] = Declared(name, type_name)
        self.actors[said] = Actor(said, name, kind, bool(controllers))

    def _of_catalog(self, reference: Node, name: str) -> tuple[str, str]:
        """Return the type of an entity of a catalog, and of which kind that is."""
        found = self._values.entry(reference, "it is any vehicle")
        if found is None:
            return "vehicle", "vehicle"
        vehicle, path = found
        self._note_trailers(vehicle, name)
        key = path, vehicle.said("name")
        known = self._shared.known(*key)
        if known is None:
            kind, constraints = facts(vehicle, self._document)
            body = keeps(constraints) or ["event unused"]
            known = self._shared.type_of(key, key[1], _moving(kind), kind, body)
        else:
            vehicle.use_all()  # the document that made the type has reported on it
        return known.name, known.kind

    def _note_trailers(self, vehicle: Node, name: str) -> None:
        """Note the trailer that a vehicle tows from the start on."""
        for each in vehicle.children("Trailer"):
            for part in each.children():
                if part.tag == "TrailerRef":
                    self.tows[self._values.text(part, "entityRef")] = (name, part)
                else:
                    part.leave_out("a trailer that is no entity of the scenario")

    def share(self) -> None:
        """Take the types of entities that are in no catalog from the library, if there is one."""
        for said, node in self._own.items() if self._shared.is_used else ():
            member = self.members[said]
            body = keeps([each.removeprefix("it.") for each in member.constraints])
            if body:
                kind, name = self.actors[said].kind, node.text("name") or said
                key = name, member.type, *body
                known = self._shared.type_of(key, name, kind, member.type, body)
                self.members[said] = Declared(member.name, known.name)

    def couplings(self) -> list[Declared]:
        """Return which vehicles tow which trailers from the start on."""
        found = []
        for said, (vehicle, node) in self.tows.items():
            trailer = self.actors.get(said)
            if trailer is None:
                node.leave_out(f"there is no entity {said}")
            else:
                found.append(Declared("", f"{vehicle}.tow_trailer(trailer: {trailer.name})"))
        return found


def _moving(kind: str) -> str:
    """Return the type whose actions an actor of a type has."""
    return "vehicle" if kind == "trailer" else kind


def note_controllers(node: Node, document: Document) -> None:
    """Note that a part of a document is about controllers, with the entries that it names."""
    for element in node.element.walk():
        part = node.other(element)
        part.idle(DRIVEN)
        if element.tag != "CatalogReference":
            continue
        found = document.entry(element)
        if found is None:
            name = document.text_at(element.get("entryName") or "")
            part.approximate(f"there is no entry {name} in the catalogs")
            continue
        entry = part.entry(found[0], found[1].name)
        for inner in entry.element.walk():
            entry.other(inner).idle(DRIVEN)


def gives_control(node: Node) -> bool:
    """Whether a controller drives the actor from then on: not one that is only switched off."""
    parts = list(node.element.walk())
    switches = [each for each in parts if each.tag == "ActivateControllerAction"]
    names = ("longitudinal", "lateral", "controllerRef")
    on = [each.get(name) for each in switches for name in names]
    assigned = any(each.tag == "AssignControllerAction" for each in parts)
    return assigned or any(said not in (None, "false", "0") for said in on)
