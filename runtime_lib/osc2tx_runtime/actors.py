"""Actors of the domain model: what a scenario declares, reads and calls.

Constructor keywords are the fields a scenario may fix. Live fields and methods read the snapshot
of the present step. Everything else one calls on an actor is an action: `__getattr__` finds it in
the registry.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.measures import Measures, RoutePosition
from osc2tx_runtime.registry import methods
from osc2tx_runtime.road_network import RoadNetwork
from osc2tx_runtime.values import CelestialLightSource, OdrPoint, Orientation, Point, Pose
from osc2tx_runtime.world.catalogue import MODELS, VEHICLE_CATEGORIES, Shape, limits_of, shape_of
from osc2tx_runtime.world.protocol import ActorSpec

if TYPE_CHECKING:
    from osc2tx_runtime.context import ExecutionContext

__all__ = [
    "Actor",
    "Animal",
    "CelestialLightSource",
    "Environment",
    "Map",
    "MovableObject",
    "OdrPoint",
    "Orientation",
    "Person",
    "PhysicalObject",
    "Point",
    "Pose",
    "RoutePosition",
    "StationaryObject",
    "TrafficLightController",
    "TrafficParticipant",
    "Trailer",
    "Vehicle",
]


class Actor:
    """Base of all actors.

    Attributes:
        kinds: Actor kinds of the DSL, most derived first.
        id: Name of the field that holds it; given by the scenario.
        source: Where it is declared.
    """

    kinds: ClassVar[tuple[str, ...]] = ("osc_actor",)

    def __init__(self, *, name: str | None = None) -> None:
        self.id = name or ""
        self.source: str | None = None
        self.name = name
        self._context: ExecutionContext | None = None

    def bind(self, context: ExecutionContext) -> None:
        """Joins a run: live fields read its world from now on."""
        self._context = context

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        if self._context is None:
            raise ScenarioError(f"{self.id or self.kinds[0]} is read before the scenario runs")
        return self._context

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name.startswith("_"):
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
        return methods.bind(self, name)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.id})"


class PhysicalObject(Actor, Measures):
    """Any tangible thing.

    Args:
        name: Role name; default: the field that holds it.
        model: CARLA blueprint or other name of a model.
        color: Name or `r,g,b`; for viewers.
        geometry_reference: Name of a 3D model.
        length: Length of the bounding box (m).
        width: Width of the bounding box (m).
        height: Height of the bounding box (m).
    """

    kinds = ("physical_object", *Actor.kinds)
    lane_bound: ClassVar[bool] = False
    movable: ClassVar[bool] = True

    def __init__(
        self,
        *,
        name: str | None = None,
        model: str | None = None,
        color: str | None = None,
        geometry_reference: str | None = None,
        length: float | None = None,
        width: float | None = None,
        height: float | None = None,
    ) -> None:
        super().__init__(name=name)
        self.model = model
        self.color = color
        self.geometry_reference = geometry_reference
        self.category: str | None = None
        self.rear_overhang: float | None = None
        self._size = (length, width, height)

    @property
    def shape(self) -> Shape:
        """Bounding box: as written, else of the model, else of the category or kind."""
        known = shape_of(self.kinds[0], self.category, self.model)
        length, width, height = self._size
        for size in (length, width, height, self.rear_overhang):
            if size is not None and size < 0.0:
                raise ScenarioError(f"{self.id} has a negative size", self.source)
        stretch = 1.0 if length is None else length / known.length
        return Shape(
            known.length if length is None else length,
            known.width if width is None else width,
            known.height if height is None else height,
            known.rear * stretch if self.rear_overhang is None else self.rear_overhang,
            known.wheelbase * stretch,
        )

    @property
    def size_from(self) -> str:
        """What the size is from: `scenario`, `model`, `category` or `default`."""
        if None not in self._size:
            return "scenario"
        if self.model in MODELS:
            return "model"
        return "default" if self.category is None else "category"

    def spec(self) -> ActorSpec:
        """What the world must know."""
        return ActorSpec(
            id=self.id,
            kind=self.kinds[0],
            shape=self.shape,
            limits=limits_of(self.kinds[0], self.category, self.model),
            model=self.model,
            lane_bound=self.lane_bound,
            movable=self.movable,
            color=self.color,
        )


class StationaryObject(PhysicalObject):
    """An object whose pose never changes."""

    kinds = ("stationary_object", *PhysicalObject.kinds)
    movable = False


class MovableObject(PhysicalObject):
    """An object that may move."""

    kinds = ("movable_object", *PhysicalObject.kinds)


class TrafficParticipant(MovableObject):
    """A movable object that matters to traffic."""

    kinds = ("traffic_participant", *MovableObject.kinds)


class Vehicle(TrafficParticipant):
    """A land vehicle; follows lanes where it stands on one.

    Args:
        vehicle_category: `car`, `heavy_truck`, ...; default: that of the model, else `car`.
        rear_overhang: Metres from the rear end to the rear axle.
        **fields: As of `PhysicalObject`.
    """

    kinds = ("vehicle", *TrafficParticipant.kinds)
    lane_bound = True

    def __init__(
        self,
        *,
        name: str | None = None,
        model: str | None = None,
        color: str | None = None,
        geometry_reference: str | None = None,
        vehicle_category: str | None = None,
        length: float | None = None,
        width: float | None = None,
        height: float | None = None,
        rear_overhang: float | None = None,
    ) -> None:
        super().__init__(
            name=name,
            model=model,
            color=color,
            geometry_reference=geometry_reference,
            length=length,
            width=width,
            height=height,
        )
        if vehicle_category is not None and vehicle_category not in VEHICLE_CATEGORIES:
            known = ", ".join(VEHICLE_CATEGORIES)
            raise ScenarioError(f"vehicle_category `{vehicle_category}` is none of {known}")
        self.category = vehicle_category
        self.vehicle_category = vehicle_category
        self.rear_overhang = rear_overhang


class Trailer(Vehicle):
    """A vehicle without propulsion that another one tows; fields as of `Vehicle`."""

    kinds = ("trailer", *Vehicle.kinds)
    lane_bound = False


class Person(TrafficParticipant):
    """A human being on foot; walks straight on, not bound to lanes."""

    kinds = ("person", *TrafficParticipant.kinds)


class Animal(TrafficParticipant):
    """An animal; moves like a person."""

    kinds = ("animal", *TrafficParticipant.kinds)


class Environment(Actor):
    """Weather and light.

    Attributes:
        sun: To name it in `assign_celestial_position`.
        moon: Likewise.
    """

    kinds = ("environment", *Actor.kinds)

    def __init__(self, *, name: str | None = None) -> None:
        super().__init__(name=name)
        self.sun = CelestialLightSource("sun")
        self.moon = CelestialLightSource("moon")


class Map(Actor, RoadNetwork):
    """The road network.

    Args:
        name: Role name.
        map_file: File name with or without `.xodr`, found in the folders of `--map-path`, then
            among the maps of the runtime.
    """

    kinds = ("map", *Actor.kinds)

    def __init__(self, *, name: str | None = None, map_file: str | None = None) -> None:
        super().__init__(name=name)
        self.map_file = map_file


class TrafficLightController(Actor):
    """Switches traffic lights."""

    kinds = ("traffic_light_controller", *Actor.kinds)
