"""Physical objects, among them stationary ones (DSL 8.7.3, 8.7.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, TypedDict, TypeVar

from osc2tx_runtime.domain.measuring.object_measurements import Measures
from osc2tx_runtime.domain.objects.parts import (
    UNSAID,
    BehavioralModel,
    BoundingBox,
    completed,
    is_open,
)
from osc2tx_runtime.domain.points_and_poses import Point, Rgb
from osc2tx_runtime.enums import (
    Color,
    VehicleCategory,
)
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.language.actions.registry import LONGITUDINAL
from osc2tx_runtime.world.actor_dimensions import MODELS, Shape, limits_of, shape_of
from osc2tx_runtime.world.commands import Careful
from osc2tx_runtime.world.protocol import ActorSpec

from .base import Actor

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

LIBRARY_KINDS = frozenset(
    {
        *("physical_object", "stationary_object", "movable_object", "traffic_participant"),
        *("vehicle", "trailer", "person", "animal"),
    }
)
"""Kinds of physical objects in the domain model."""

ValueT = TypeVar("ValueT")

_SAME = 1e-6  # m between a declared value and the value derived from the others


class ObjectFields(TypedDict, total=False):
    """Keywords of `PhysicalObject`."""

    name: str | None
    model: str | None
    color: Color | Rgb | None
    geometry_reference: str | None
    bounding_box: BoundingBox | None
    center: Point | None
    length: float | None
    width: float | None
    height: float | None
    center_of_gravity: Point | None
    initial_bm: BehavioralModel | None


class PhysicalObject(Actor, Measures):
    """Any physical object.

    Args:
        name: Role name; default: the field that holds it.
        model: CARLA blueprint or other name of a model.
        color: Name, or `Rgb` as in scenarios for CARLA; for viewers.
        geometry_reference: Name of a 3D model.
        bounding_box: Size and position of the box, unless the next four state it.
        center: Middle of the box (m), from the reference point.
        length: Length of the box (m).
        width: Width of the box (m).
        height: Height of the box (m).
        center_of_gravity: From the reference point (m); default: the middle of the box.
        initial_bm: Its motion while no action controls it.
    """

    kinds = ("physical_object", *Actor.kinds)
    lane_bound: ClassVar[bool] = False
    movable: ClassVar[bool] = True

    def __init__(
        self,
        *,
        name: str | None = None,
        model: str | None = None,
        color: Color | Rgb | None = None,
        geometry_reference: str | None = None,
        bounding_box: BoundingBox | None = None,
        center: Point | None = None,
        length: float | None = None,
        width: float | None = None,
        height: float | None = None,
        center_of_gravity: Point | None = None,
        initial_bm: BehavioralModel | None = None,
    ) -> None:
        super().__init__(name=name)
        self.model = model
        self._color = color
        self._geometry_reference = geometry_reference
        self._box = _box(bounding_box or BoundingBox(), center, (length, width, height))
        self._center_of_gravity = center_of_gravity
        self.initial_bm = initial_bm or BehavioralModel()

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run, with the behavioral model that it starts with."""
        super().bind(context)
        self.set_bm(self.initial_bm)

    def set_bm(self, behavioral_model: BehavioralModel) -> None:
        """Set the behavioral model that drives the object while no action controls it (8.7.3.1.9).

        Raises:
            UnsupportedError: The model cannot drive this kind of object.
        """
        engine = behavioral_model.bm_engine.name
        careful = engine == "careful_driver"
        if careful and not self.lane_bound:
            raise UnsupportedError(
                f"{self.id}, a {self.library_kind}, cannot be left to a careful driver:"
                " only vehicles with propulsion can",
                self.source,
            )
        standard = self.context.settings.conduct == "standard" and self.lane_bound
        command = Careful(None) if careful or standard else None
        self.context.leave(self.id, LONGITUDINAL, engine, command)

    # --- declared, or from the catalogue ------------------------------------------------------

    @property
    def color(self) -> Color | Rgb:
        """Its colour."""
        return self._said("color", self._color)

    @property
    def geometry_reference(self) -> str:
        """Name of its 3D model."""
        return self._said("geometry_reference", self._geometry_reference)

    @property
    def bounding_box(self) -> BoundingBox:
        """The box around it."""
        shape = self.shape
        center = Point(shape.centre, 0.0, 0.5 * shape.height)
        return BoundingBox(center, shape.length, shape.width, shape.height)

    @property
    def center_of_gravity(self) -> Point:
        """Its centre of gravity (m), from the reference point; by default the centre of the box."""
        return self._center_of_gravity or self.bounding_box.center

    def _said(self, member: str, value: ValueT | None) -> ValueT:
        """Return a value that only the scenario can state.

        Raises:
            ScenarioError: It does not state it.
        """
        if value is None:
            raise ScenarioError(f"the {member} of {self.id} is not stated", self.source)
        return value

    # --- for the world ------------------------------------------------------------------------

    @property
    def category(self) -> VehicleCategory | None:
        """Category of a vehicle that the scenario states."""
        return None

    @property
    def shape(self) -> Shape:
        """Size and reference point: as stated, else of the model, else of category or kind.

        Raises:
            ScenarioError: A size is negative, or the position of the box contradicts the standard.
        """
        known = shape_of(self.library_kind, self.category, self.model)
        box = completed(self._box, BoundingBox(Point(), known.length, known.width, known.height))
        for size in (box.length, box.width, box.height):
            if size < 0.0:
                raise ScenarioError(f"{self.id} has a negative size", self.source)
        rear = self._rear(known.rear * (box.length / known.length))
        self._check_center(Point(0.5 * box.length - rear, 0.0, 0.5 * box.height))
        wheelbase = known.wheelbase * (box.length / known.length)
        return Shape(box.length, box.width, box.height, rear, wheelbase)

    def _rear(self, known: float) -> float:
        """Metres from the rear end to the reference point; `known` if not stated."""
        return known

    def _check_center(self, wanted: Point) -> None:
        """Checks the reference point (section 8.3.3), and that the box stands on the ground."""
        said = self._box.center
        for axis, is_, must_be in (
            ("x", said.x, wanted.x),
            ("y", said.y, 0.0),
            ("z", said.z or wanted.z, wanted.z),  # 0: a point that does not state it
        ):
            if abs(is_ - must_be) > _SAME:
                raise UnsupportedError(
                    f"the {axis} of the middle of the bounding box of {self.id} is {must_be:g} m:"
                    " the axes of an object begin below the middle of its box, or of its rear"
                    f" axle; not {is_:g} m",
                    self.source,
                )

    @property
    def library_kind(self) -> str:
        """The most derived kind of the library: it determines size and limits."""
        return next((kind for kind in self.kinds if kind in LIBRARY_KINDS), self.kinds[-1])

    @property
    def size_from(self) -> str:
        """The origin of the size: `scenario`, `model`, `category` or `default`."""
        if self._box.length + self._box.width + self._box.height >= 0.0:  # false for nan: open
            return "scenario"
        if self.model in MODELS:
            return "model"
        return "default" if self.category is None else "category"

    def spec(self) -> ActorSpec:
        """Its description for the world."""
        return ActorSpec(
            id=self.id,
            kind=self.library_kind,
            shape=self.shape,
            limits=limits_of(self.library_kind, self.category, self.model),
            model=self.model,
            lane_bound=self.lane_bound,
            movable=self.movable,
            color=self._color,
            role=self.name,
        )


def _box(
    whole: BoundingBox, center: Point | None, sizes: tuple[float | None, float | None, float | None]
) -> BoundingBox:
    """Return the declared size of a box, from the box as a whole and from its parts."""
    length, width, height = (UNSAID if size is None else size for size in sizes)
    parts = BoundingBox(center or whole.center, length, width, height)
    for part in ("length", "width", "height"):
        one, other = getattr(whole, part), getattr(parts, part)
        if not is_open(one) and not is_open(other) and one != other:
            raise ScenarioError(f"a bounding box has two values of its {part}: {one:g}, {other:g}")
    return completed(parts, whole)


class StationaryObject(PhysicalObject):
    """An object whose pose never changes."""

    kinds = ("stationary_object", *PhysicalObject.kinds)
    movable = False
