"""Actors of the domain model: what a scenario declares, reads and calls.

Constructor keywords are the fields a scenario may fix. Live fields and methods read the snapshot
of the present step. Everything else one calls on an actor is an action: `__getattr__` finds it in
the registry.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from datetime import datetime, timedelta, timezone
from typing import TYPE_CHECKING, ClassVar, Literal

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.measures import Measures, RoutePosition
from osc2tx_runtime.motions import Hitch
from osc2tx_runtime.registry import methods
from osc2tx_runtime.road_network import RoadNetwork
from osc2tx_runtime.values import OdrPoint, Orientation, Point, Pose
from osc2tx_runtime.weather import CelestialLightSource, Weather
from osc2tx_runtime.world.catalogue import MODELS, VEHICLE_CATEGORIES, Shape, limits_of, shape_of
from osc2tx_runtime.world.protocol import ActorSpec

if TYPE_CHECKING:
    from py_trees.behaviour import Behaviour

    from osc2tx_runtime.context import ExecutionContext
    from osc2tx_runtime.traffic_cycles import TrafficLightCycle

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


DrivingRule = Literal["left_hand_traffic", "right_hand_traffic"]


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

    def __getattr__(self, name: str) -> Callable[..., Behaviour]:
        """Return an action of this actor, as a constructor of its node."""
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
        self._color = color
        self.geometry_reference = geometry_reference
        self.category: str | None = None
        self.rear_overhang: float | None = None
        self._size = (length, width, height)

    @property
    def color(self) -> str:
        """Its colour, for scenarios that ask for it.

        Raises:
            ScenarioError: The scenario says nothing about it.
        """
        return self._said("color", self._color)

    def _said(self, member: str, value: str | None) -> str:
        if value is None:
            raise ScenarioError(f"nothing says the {member} of {self.id}", self.source)
        return value

    @property
    def shape(self) -> Shape:
        """Bounding box: as written, else of the model, else of the category or kind."""
        known = shape_of(self.library_kind, self.category, self.model)
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
    def library_kind(self) -> str:
        """The most derived kind that is not of a user's own: size and limits go by it."""
        return next((kind for kind in self.kinds if kind in LIBRARY_KINDS), self.kinds[-1])

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
            kind=self.library_kind,
            shape=self.shape,
            limits=limits_of(self.library_kind, self.category, self.model),
            model=self.model,
            lane_bound=self.lane_bound,
            movable=self.movable,
            color=self._color,
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
        self.rear_overhang = rear_overhang

    @property
    def vehicle_category(self) -> str:
        """What sort of vehicle the scenario says it is.

        Raises:
            ScenarioError: It says nothing; that of a model is not asked for.
        """
        return self._said("vehicle_category", self.category)

    @property
    def trailer_receiver(self) -> Hitch:
        """The half of the hitch on this vehicle."""
        return Hitch(self.context.world.trailer_of(self.id) is not None)


class Trailer(Vehicle):
    """A vehicle without propulsion that another one tows; fields as of `Vehicle`."""

    kinds = ("trailer", *Vehicle.kinds)
    lane_bound = False

    @property
    def coupler(self) -> Hitch:
        """The half of the hitch on this trailer."""
        return Hitch(self._tow_id() is not None)

    @property
    def tow_vehicle(self) -> Vehicle:
        """What tows it.

        Raises:
            ScenarioError: Nobody does.
        """
        tow = self._tow_id()
        if tow is None:
            raise ScenarioError(f"{self.id} is not towed")
        vehicle = self.context.actors[tow]
        assert isinstance(vehicle, Vehicle)
        return vehicle

    def _tow_id(self) -> str | None:
        world = self.context.world
        return next((each for each in world.actors() if world.trailer_of(each) == self.id), None)


class Person(TrafficParticipant):
    """A human being on foot; walks straight on, not bound to lanes."""

    kinds = ("person", *TrafficParticipant.kinds)


class Animal(TrafficParticipant):
    """An animal; moves like a person."""

    kinds = ("animal", *TrafficParticipant.kinds)


class Environment(Actor):
    """Weather and light.

    Attributes:
        sun: Its position, and to name it in `assign_celestial_position`.
        moon: Likewise.
    """

    kinds = ("environment", *Actor.kinds)

    def __init__(self, *, name: str | None = None) -> None:
        super().__init__(name=name)
        self.sun = CelestialLightSource("sun", self._values)
        self.moon = CelestialLightSource("moon", self._values)

    def _values(self) -> Mapping[str, float]:
        return self.context.world.environment()

    @property
    def weather(self) -> Weather:
        """The weather at the present step."""
        return Weather(self._values())

    def local_to_unix_time(
        self,
        year: int,
        month: int,
        day: int,
        hour: int,
        minute: int,
        second: int,
        time_zone: float,
    ) -> float:
        """Unix time (s) of a local date and time (DSL 8.10.2.1.1); time zone in hours east of UTC.

        Raises:
            ScenarioError: There is no such date, time or zone.
        """
        try:
            zone = timezone(timedelta(hours=time_zone))
            return datetime(year, month, day, hour, minute, second, tzinfo=zone).timestamp()
        except ValueError as error:
            raise ScenarioError(f"local_to_unix_time: {error}") from None


class Map(Actor, RoadNetwork):
    """The road network.

    Args:
        name: Role name.
        map_file: File name with or without `.xodr`, found in the folders of `--map-path`, then
            among the maps of the runtime.
        driving_rule: What the map must have: `left_hand_traffic` or `right_hand_traffic`.
        traffic_light_control: Cycles from which `sync` of the traffic light actions knows what
            lights in step show; they are not played by themselves.
    """

    kinds = ("map", *Actor.kinds)

    def __init__(
        self,
        *,
        name: str | None = None,
        map_file: str | None = None,
        driving_rule: DrivingRule | None = None,
        traffic_light_control: Sequence[TrafficLightCycle] = (),
    ) -> None:
        super().__init__(name=name)
        self.map_file = map_file
        self.required_rule = driving_rule
        self.traffic_light_control = list(traffic_light_control)

    @property
    def driving_rule(self) -> DrivingRule:
        """The side on which its roads are driven."""
        return "right_hand_traffic" if self.outer_side() == "right" else "left_hand_traffic"


class TrafficLightController(Actor):
    """Switches traffic lights."""

    kinds = ("traffic_light_controller", *Actor.kinds)


LIBRARY_KINDS = frozenset(
    kind
    for actor in (Animal, Person, StationaryObject, TrafficParticipant, Trailer)
    for kind in actor.kinds
)
"""Kinds of physical objects in the domain model."""
