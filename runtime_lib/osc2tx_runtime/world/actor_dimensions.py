"""Sizes and limits of actors, per category and for known CARLA blueprints; their colors.

Sizes of blueprints are the bounding boxes of CARLA 0.9.15, rounded to centimetres. Rear overhangs
and wheelbases are not published there; they are typical shares of the length (`_OVERHANG`,
`_WHEELBASE`), refined by `bounding_box` and `rear_overhang` in a scenario.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import cast

from osc2tx_runtime.enums import VehicleCategory
from osc2tx_shared.classes import dataclass

COMFORT = 0.5  # share of the limits that is used unless more is required
GENTLE = 0.9
"""Share of the comfortable rate: the peak of a smooth speed change without a stated peak."""

MAX_STEERING = 0.6
"""Largest angle (rad) between the front wheels of a vehicle and its axis."""

TOP_SPEED = 69.0  # m/s: no actor drives faster on its own; the DSL defines no top speed
RATE_CAP = 12.0  # m/s^2: more than tyres can transmit; explicit rates above it are rejected


@dataclass(frozen=True, slots=True)
class Shape:
    """Bounding box and reference point of an actor.

    Attributes:
        length: Metres along x.
        width: Metres along y.
        height: Metres along z.
        rear: Metres from the rear end to the reference point (rear axle centre of vehicles, box
            centre of everything else; DSL 8.3.2, 8.3.3).
        wheelbase: Metres between the axles; 0 without axles.
        steering: Largest angle between the front wheels and the axis (rad).
        hitch: Metres from the reference point back to the hitch for a trailer; None: the rear end.
        drawbar: Metres from the axle of a trailer to its coupler; None: half a metre before it.
    """

    length: float
    width: float
    height: float
    rear: float
    wheelbase: float = 0.0
    steering: float = MAX_STEERING
    hitch: float | None = None
    drawbar: float | None = None

    @property
    def front(self) -> float:
        """Metres from the reference point to the front end."""
        return self.length - self.rear

    @property
    def centre(self) -> float:
        """Metres from the reference point forward to the box centre."""
        return 0.5 * self.length - self.rear

    @property
    def reach(self) -> float:
        """Metres from the reference point to the farthest corner."""
        return math.hypot(max(self.rear, self.front), 0.5 * self.width)


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of an actor.

    Attributes:
        acceleration: Largest gain of speed (m/s^2).
        deceleration: Largest loss of speed (m/s^2).
        jerk: Largest change of acceleration (m/s^3).
        lateral: Largest lateral acceleration of a lane change (m/s^2), and comfortable in bends.
        road: Condition of the road that reduces them, for messages: " on a wet road".
        overturn: Lateral acceleration (m/s^2) at which it rolls over; infinite: its tyres slide
            before.
    """

    acceleration: float
    deceleration: float
    jerk: float = 10.0
    lateral: float = 3.0
    road: str = ""
    overturn: float = math.inf

    @property
    def text(self) -> str:
        """The longitudinal limits, for messages."""
        own = f"{self.acceleration:.4g} and -{self.deceleration:.4g} m/s^2"
        return f"its limits are {own}{self.road}"


TYRES = Limits(RATE_CAP, RATE_CAP)
"""Limits of actors whose vehicle limits are switched off."""

# Rollover thresholds in a steady bend: one round number for each kind, chosen here, as thresholds
# vary with load and design. Heavy vehicles: several authorities ask for at least 0.40 g of tank
# trucks, and of 17 that were tilted 14 would be below it at their maximum load (J. R. Billing, J.
# D. Patten, An Assessment of Tank Truck Roll Stability, National Research Council of Canada); the
# influences on it are in C. B. Winkler, R. D. Ervin, Rollover of Heavy Commercial Vehicles
# (UMTRI-99-19, 1999). Half the track of a car is more than the height of its centre of gravity, so
# it slides first; vans stand higher, and get a little less than dry grip.
_LIGHT = 0.8 * 9.80665
_HEAVY = 0.4 * 9.80665

CAR_LIMITS = Limits(4.0, 8.0)
TRUCK_LIMITS = Limits(1.5, 6.0, lateral=2.5, overturn=_HEAVY)
BICYCLE_LIMITS = Limits(1.0, 3.0, lateral=2.0)
PERSON_LIMITS = Limits(1.5, 3.0)

_OVERHANG = 0.2  # share of the length behind the rear axle
_WHEELBASE = 0.6  # share of the length between the axles


def _vehicle(length: float, width: float, height: float) -> Shape:
    return Shape(length, width, height, round(_OVERHANG * length, 3), round(_WHEELBASE * length, 3))


def _box(length: float, width: float, height: float) -> Shape:
    return Shape(length, width, height, 0.5 * length)


# Category of a vehicle, or kind of another actor -> default size and limits. The names are those
# of `vehicle_category` (DSL 8.7.16) and of the actors.
CATEGORIES: dict[str, tuple[Shape, Limits]] = {
    "car": (_vehicle(4.6, 1.9, 1.5), CAR_LIMITS),
    "van": (_vehicle(5.4, 2.0, 2.2), Limits(3.0, 7.0, lateral=2.5, overturn=_LIGHT)),
    "bus": (_vehicle(12.0, 2.55, 3.2), TRUCK_LIMITS),
    "heavy_truck": (_vehicle(8.5, 2.55, 3.6), TRUCK_LIMITS),
    "semi_tractor": (_vehicle(6.0, 2.55, 3.6), TRUCK_LIMITS),
    "semi_trailer": (_vehicle(13.6, 2.55, 4.0), TRUCK_LIMITS),
    "trailer": (_vehicle(6.0, 2.3, 2.5), TRUCK_LIMITS),
    "motorcycle": (_vehicle(2.2, 0.8, 1.5), Limits(5.0, 8.0)),
    "bicycle": (_vehicle(1.8, 0.6, 1.7), BICYCLE_LIMITS),
    "micro_mobility_device": (_vehicle(1.2, 0.6, 1.7), BICYCLE_LIMITS),
    "stand_up_scooter": (_vehicle(1.2, 0.6, 1.7), BICYCLE_LIMITS),
    "wheelchair": (_vehicle(1.1, 0.7, 1.3), PERSON_LIMITS),
    "work_machine": (_vehicle(6.0, 2.5, 3.0), TRUCK_LIMITS),
    "train": (_vehicle(25.0, 2.9, 4.0), Limits(0.8, 1.2)),
    "tram": (_vehicle(30.0, 2.5, 3.5), Limits(1.2, 2.5)),
    "land_vehicle": (_vehicle(4.6, 1.9, 1.5), CAR_LIMITS),
    "other": (_vehicle(4.6, 1.9, 1.5), CAR_LIMITS),
}
VEHICLE_CATEGORIES: tuple[str, ...] = (*CATEGORIES, "truck", "vru_vehicle")
"""Names of `vehicle_category` (DSL 8.7.16) that have a default size and limits."""

CATEGORIES |= {
    "person": (_box(0.5, 0.5, 1.75), PERSON_LIMITS),
    "animal": (_box(1.0, 0.4, 0.8), Limits(3.0, 5.0)),
    "stationary_object": (_box(1.0, 1.0, 1.0), Limits(1.0, 1.0)),
    "movable_object": (_box(0.5, 0.5, 0.5), PERSON_LIMITS),
}
CATEGORIES["truck"] = CATEGORIES["heavy_truck"]
CATEGORIES["vru_vehicle"] = CATEGORIES["micro_mobility_device"]

# CARLA blueprint -> category, length, width, height (m).
MODELS: dict[str, tuple[str, float, float, float]] = {
    "vehicle.audi.a2": ("car", 3.71, 1.79, 1.55),
    "vehicle.audi.etron": ("car", 4.86, 2.03, 1.65),
    "vehicle.audi.tt": ("car", 4.18, 1.99, 1.39),
    "vehicle.bmw.grandtourer": ("car", 4.61, 2.24, 1.67),
    "vehicle.carlamotors.carlacola": ("heavy_truck", 5.20, 2.61, 2.47),
    "vehicle.carlamotors.european_hgv": ("heavy_truck", 7.92, 2.86, 3.78),
    "vehicle.carlamotors.firetruck": ("heavy_truck", 8.58, 2.90, 3.83),
    "vehicle.chevrolet.impala": ("car", 5.36, 2.03, 1.41),
    "vehicle.citroen.c3": ("car", 3.99, 1.85, 1.62),
    "vehicle.dodge.charger_police": ("car", 4.97, 2.04, 1.54),
    "vehicle.ford.ambulance": ("van", 6.36, 2.35, 2.43),
    "vehicle.ford.mustang": ("car", 4.72, 1.89, 1.30),
    "vehicle.jeep.wrangler_rubicon": ("car", 3.87, 1.91, 1.88),
    "vehicle.lincoln.mkz_2017": ("car", 4.90, 2.13, 1.51),
    "vehicle.lincoln.mkz_2020": ("car", 4.89, 1.84, 1.52),
    "vehicle.mercedes.coupe": ("car", 5.03, 2.15, 1.64),
    "vehicle.mercedes.sprinter": ("van", 5.92, 1.99, 2.73),
    "vehicle.mini.cooper_s": ("car", 3.81, 1.97, 1.48),
    "vehicle.mitsubishi.fusorosa": ("bus", 10.17, 3.93, 4.24),
    "vehicle.nissan.micra": ("car", 3.63, 1.85, 1.50),
    "vehicle.nissan.patrol": ("car", 4.60, 1.93, 1.86),
    "vehicle.seat.leon": ("car", 4.19, 1.82, 1.47),
    "vehicle.tesla.model3": ("car", 4.79, 2.16, 1.49),
    "vehicle.toyota.prius": ("car", 4.51, 2.01, 1.52),
    "vehicle.volkswagen.t2": ("van", 4.48, 2.07, 2.04),
    "static.prop.trafficwarning": ("stationary_object", 2.37, 2.87, 3.57),
}


def category_of(model: str | None) -> VehicleCategory | None:
    """The category of a model of a vehicle; None if the model is unknown."""
    return cast(VehicleCategory, MODELS[model][0]) if model in MODELS else None


def _category(kind: str, category: str | None, model: str | None) -> str:
    if category is not None:
        return category
    if model in MODELS:
        return MODELS[model][0]
    return kind if kind in CATEGORIES else "car"


def shape_of(kind: str, category: str | None = None, model: str | None = None) -> Shape:
    """Size of an actor: of its model if known, else of its category, else of its kind."""
    if model in MODELS:
        _category_name, *size = MODELS[model]
        return _box(*size) if kind == "stationary_object" else _vehicle(*size)
    return CATEGORIES[_category(kind, category, model)][0]


def limits_of(kind: str, category: str | None = None, model: str | None = None) -> Limits:
    """Limits of an actor, found as for `shape_of`."""
    return CATEGORIES[_category(kind, category, model)][1]


RGB: Mapping[str, tuple[int, int, int]] = {
    "white": (255, 255, 255),
    "silver": (192, 192, 192),
    "gray": (128, 128, 128),
    "black": (0, 0, 0),
    "red": (255, 0, 0),
    "maroon": (128, 0, 0),
    "yellow": (255, 255, 0),
    "olive": (128, 128, 0),
    "lime": (0, 255, 0),
    "green": (0, 128, 0),
    "aqua": (0, 255, 255),
    "teal": (0, 128, 128),
    "blue": (0, 0, 255),
    "navy": (0, 0, 128),
    "fuchsia": (255, 0, 255),
    "purple": (128, 0, 128),
    "violet": (238, 130, 238),
    "orange": (255, 165, 0),
    "brown": (165, 42, 42),
}
"""Red, green and blue by `color` (§8.7.15), as CSS has them; `other` may be any."""
