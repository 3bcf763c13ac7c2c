"""Vehicles and trailers (DSL 8.7.7, 8.7.8)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Unpack

from osc2tx_runtime.domain.methods import VehicleMethods
from osc2tx_runtime.domain.objects.part_defaults import (
    default_axles,
    default_coupler,
    default_receiver,
    default_trailer_category,
    misfit,
)
from osc2tx_runtime.domain.objects.parts import Axle, HitchCoupler, HitchReceiver, completed
from osc2tx_runtime.enums import TrailerCategory, VehicleCategory
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.actor_dimensions import VEHICLE_CATEGORIES, Shape, category_of
from osc2tx_shared.classes import replace

from .movable_objects import ParticipantFields, TrafficParticipant


class VehicleFields(ParticipantFields, total=False):
    """Keywords of `Vehicle`."""

    vehicle_category: VehicleCategory | None
    axles: Sequence[Axle] | Mapping[int, Axle] | None
    rear_overhang: float | None
    trailer_receiver: HitchReceiver | None


class TrailerFields(VehicleFields, total=False):
    """Keywords of `Trailer`."""

    trailer_category: TrailerCategory | None
    coupler: HitchCoupler | None


class Vehicle(TrafficParticipant, VehicleMethods):
    """A land vehicle; follows lanes if it starts on one.

    Args:
        vehicle_category: `car`, `heavy_truck`, ...; default: that of the model, else `car`.
        axles: From front to rear, or deviations from the category by numbers of axles; default:
            those of the category.
        rear_overhang: Metres from the rear end to the rear axle.
        trailer_receiver: The receiver of the hitch; default: at the rear end of the vehicle.
        **fields: As of `TrafficParticipant`.

    Attributes:
        said_receiver: The receiver of the hitch as stated in the scenario.
    """

    kinds = ("vehicle", *TrafficParticipant.kinds)
    lane_bound = True

    def __init__(
        self,
        *,
        vehicle_category: VehicleCategory | None = None,
        axles: Sequence[Axle] | Mapping[int, Axle] | None = None,
        rear_overhang: float | None = None,
        trailer_receiver: HitchReceiver | None = None,
        **fields: Unpack[ParticipantFields],
    ) -> None:
        super().__init__(**fields)
        if vehicle_category is not None and vehicle_category not in VEHICLE_CATEGORIES:
            known = ", ".join(VEHICLE_CATEGORIES)
            raise ScenarioError(f"vehicle_category `{vehicle_category}` is not one of {known}")
        self._category = vehicle_category
        self._axles = axles
        self._rear_overhang = rear_overhang
        self.said_receiver = trailer_receiver or HitchReceiver()

    @property
    def category(self) -> VehicleCategory | None:
        """Category that the scenario states."""
        return self._category

    @property
    def vehicle_category(self) -> VehicleCategory:
        """Category of the vehicle, as stated in the scenario or by its model."""
        return self._said("vehicle_category", self._category or category_of(self.model))

    @property
    def rear_overhang(self) -> float:
        """Metres from the rear end of the box to the middle of the rear axle."""
        return self.shape.rear

    @property
    def axles(self) -> list[Axle]:
        """The axles from front to rear."""
        return list(self._axles_on(self.shape))

    @property
    def trailer_receiver(self) -> HitchReceiver:
        """The receiver of the hitch."""
        receiver = completed(
            self.said_receiver, default_receiver(self.shape, self.said_receiver.hitch_type)
        )
        return replace(receiver, connected=self._is_towing)

    @property
    def shape(self) -> Shape:
        """As of `PhysicalObject`, with the effects of axles and hitch on the motion."""
        shape = super().shape
        hitch = self.said_receiver.position_x
        if hitch == hitch:  # nan: not stated
            shape = replace(shape, hitch=-hitch)
        if self._axles is None:
            return shape
        places = [axle.position_x for axle in self._axles_on(shape)]
        if abs(min(places)) > 1e-6:
            raise ScenarioError(f"the rear axle of {self.id} is its origin: at 0 m", self.source)
        steering = max(axle.max_steering for axle in self._axles_on(shape))
        return replace(shape, wheelbase=max(places) or shape.wheelbase, steering=steering)

    def _axles_on(self, shape: Shape) -> tuple[Axle, ...]:
        known = default_axles(self._known_category, shape)
        if self._axles is None:
            return known
        if isinstance(self._axles, Mapping):
            beyond = [number for number in self._axles if number >= len(known)]
            if beyond:
                raise ScenarioError(
                    f"{self.id} has {len(known)} axles; to say something of another one, list all",
                    self.source,
                )
            said = self._axles
            return tuple(
                completed(said[i], axle) if i in said else axle for i, axle in enumerate(known)
            )
        if not self._axles:
            raise ScenarioError(f"{self.id} has no axle", self.source)
        front, rear = known[0], known[-1]
        usual = (rear,) if len(self._axles) == 1 else (front, *(rear for _ in self._axles[1:]))
        return tuple(completed(a, like) for a, like in zip(self._axles, usual, strict=True))

    @property
    def _known_category(self) -> VehicleCategory:
        return self._category or category_of(self.model) or "car"

    def _rear(self, known: float) -> float:
        """The rear overhang, stated or derived from the middle of the box."""
        said, middle = self._rear_overhang, self._box.center.x
        if said is None:
            return 0.5 * self._box.length - middle if middle == middle else known
        if said < 0.0:
            raise ScenarioError(f"{self.id} has a negative size", self.source)
        return said

    def _is_towing(self) -> bool:
        return self.context.world.trailer_of(self.id) is not None


class Trailer(Vehicle):
    """A vehicle without propulsion, towed by another vehicle.

    Args:
        trailer_category: `semi_trailer`, `full_trailer` or `central_axle_trailer`.
        coupler: The coupler of the hitch; default: in front of the box.
        **fields: As of `Vehicle`.
    """

    kinds = ("trailer", *Vehicle.kinds)
    lane_bound = False

    def __init__(
        self,
        *,
        trailer_category: TrailerCategory | None = None,
        coupler: HitchCoupler | None = None,
        **fields: Unpack[VehicleFields],
    ) -> None:
        super().__init__(**fields)
        self._trailer_category = trailer_category
        self._coupler = coupler or HitchCoupler()

    @property
    def trailer_category(self) -> TrailerCategory:
        """Category of the trailer, as stated in the scenario or by its category as a vehicle."""
        known = default_trailer_category(self._known_category)
        return self._said("trailer_category", self._trailer_category or known)

    @property
    def coupler(self) -> HitchCoupler:
        """The coupler of the hitch."""
        known = default_coupler(self._known_category, self.shape, self._coupler.hitch_type)
        return replace(completed(self._coupler, known), connected=self._is_towed)

    @property
    def shape(self) -> Shape:
        """As of `Vehicle`, with the position of the coupler."""
        shape, coupler = super().shape, self._coupler.position_x
        return replace(shape, drawbar=coupler) if coupler == coupler else shape

    @property
    def tow_vehicle(self) -> Vehicle:
        """The vehicle that tows it.

        Raises:
            ScenarioError: It is not towed.
        """
        tow = self._tow_id()
        if tow is None:
            raise ScenarioError(f"{self.id} is not towed")
        vehicle = self.context.actors[tow]
        assert isinstance(vehicle, Vehicle)
        return vehicle

    def misfit(self, receiver: HitchReceiver) -> str | None:
        """Why it does not fit a receiver; None if it fits, as far as the scenario states."""
        return misfit(receiver, self._coupler)

    def _is_towed(self) -> bool:
        return self._tow_id() is not None

    def _tow_id(self) -> str | None:
        world = self.context.world
        return next((each for each in world.actors() if world.trailer_of(each) == self.id), None)
