"""Actors of the scenario as entities of the XML."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx import ir
from osc2tx.backends.xosc.facts.actors import CATEGORIES, Limits, Shape, limits_of, shape_of
from osc2tx.backends.xosc.values.folding import Values
from osc2tx.xosc.names import plain
from osc2tx_shared.classes import dataclass

VEHICLE, PEDESTRIAN, MISC = "Vehicle", "Pedestrian", "MiscObject"

# Actor type of the library -> element of the XML; the first type of a lineage that is here counts.
KINDS: Mapping[str, str] = {
    "trailer": VEHICLE,
    "vehicle": VEHICLE,
    "person": PEDESTRIAN,
    "animal": PEDESTRIAN,
    "stationary_object": MISC,
    "movable_object": MISC,
    "traffic_participant": MISC,
    "physical_object": MISC,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class CastMember:
    """An entity.

    Attributes:
        actor: The actor.
        name: Name of the `ScenarioObject`.
        kind: `Vehicle`, `Pedestrian` or `MiscObject`.
        category: `vehicle_category` of the DSL or the kind of actor.
        model: What it is called in a library of models.
        shape: Size.
        limits: What it can do.
    """

    actor: ir.Actor
    name: str
    kind: str
    category: str
    model: str | None
    shape: Shape
    limits: Limits

    @property
    def walks(self) -> bool:
        """Whether it moves freely, not along lanes."""
        return self.kind != VEHICLE

    @property
    def sizes(self) -> Mapping[tuple[str, ...], float]:
        """Members of the actor that its shape says, as the runtime has them."""
        shape = self.shape
        sizes: dict[tuple[str, ...], float] = {
            ("bounding_box", "length"): shape.length,
            ("bounding_box", "width"): shape.width,
            ("bounding_box", "height"): shape.height,
            ("bounding_box", "center", "x"): shape.centre,
            ("bounding_box", "center", "y"): 0.0,
            ("bounding_box", "center", "z"): 0.5 * shape.height,
        }
        return {**sizes, ("rear_overhang",): shape.rear} if self.kind == VEHICLE else sizes


def cast_member(actor: ir.Actor, name: str, values: Values) -> CastMember | None:
    """Return an actor as an entity; `None` if it is no physical object."""
    library_kind = next((t for t in actor.lineage if t in KINDS), None)
    if library_kind is None:
        return None
    category = values.member_in(actor.name, "vehicle_category")
    sized = category if category in CATEGORIES else None  # others have no counterpart anyway
    model = values.field(actor.name, "model")
    model_name = model if isinstance(model, str) else None
    return CastMember(
        actor=actor,
        name=plain(name),
        kind=KINDS[library_kind],
        category=category or ("car" if library_kind == "vehicle" else library_kind),
        model=model_name,
        shape=_shape(actor, library_kind, sized, model_name, values),
        limits=limits_of(library_kind, sized, model_name),
    )


def _shape(
    actor: ir.Actor, kind: str, category: str | None, model: str | None, values: Values
) -> Shape:
    shape = shape_of(kind, category, model)
    given, width, height = (
        values.number_in(actor.name, "bounding_box", name) for name in ("length", "width", "height")
    )
    overhang = values.number_in(actor.name, "rear_overhang")
    centre = values.number_in(actor.name, "bounding_box", "center", "x")
    length = given or shape.length
    rear = shape.rear * length / shape.length if overhang is None else overhang
    return Shape(
        length=length,
        width=width or shape.width,
        height=height or shape.height,
        rear=rear if centre is None else 0.5 * length - centre,
        wheelbase=shape.wheelbase * length / shape.length,
    )
