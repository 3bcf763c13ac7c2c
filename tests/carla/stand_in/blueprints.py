"""Blueprints: some of each kind, with the attributes that tools read and sizes of CARLA 0.9.15.

Half sizes in metres. Axles stand at 0.6 of the half length from the middle; the real ones differ
from model to model.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

BOOL, INT, FLOAT, STRING, COLOR = 1, 2, 3, 4, 5
TYRE_FRICTION = 3.5
"""Of CARLA's vehicles; roads have no friction of their own."""

AXLE_SHARE = 0.6

VEHICLES: dict[str, tuple[str, float, float, float]] = {
    "vehicle.audi.a2": ("car", 1.852, 0.894, 0.777),
    "vehicle.audi.tt": ("car", 2.091, 0.997, 0.693),
    "vehicle.bh.crossbike": ("bicycle", 0.744, 0.430, 0.540),
    "vehicle.bmw.grandtourer": ("car", 2.306, 1.121, 0.834),
    "vehicle.carlamotors.carlacola": ("truck", 2.602, 1.307, 1.234),
    "vehicle.carlamotors.european_hgv": ("truck", 3.959, 1.430, 1.890),
    "vehicle.carlamotors.firetruck": ("truck", 4.290, 1.450, 1.915),
    "vehicle.diamondback.century": ("bicycle", 0.821, 0.186, 0.512),
    "vehicle.ford.ambulance": ("van", 3.183, 1.176, 1.215),
    "vehicle.harley-davidson.low_rider": ("motorcycle", 1.174, 0.381, 0.610),
    "vehicle.kawasaki.ninja": ("motorcycle", 1.017, 0.400, 0.573),
    "vehicle.lincoln.mkz_2020": ("car", 2.446, 0.918, 0.762),
    "vehicle.mercedes.sprinter": ("van", 2.958, 0.994, 1.365),
    "vehicle.mini.cooper_s": ("car", 1.903, 0.985, 0.738),
    "vehicle.mitsubishi.fusorosa": ("bus", 5.137, 1.968, 2.126),
    "vehicle.nissan.micra": ("car", 1.817, 0.925, 0.751),
    "vehicle.tesla.model3": ("car", 2.396, 1.082, 0.744),
    "vehicle.toyota.prius": ("car", 2.257, 1.003, 0.762),
    "vehicle.vespa.zx125": ("motorcycle", 0.903, 0.400, 0.617),
    "vehicle.volkswagen.t2": ("van", 2.240, 1.035, 1.019),
}
"""Base type, half length, width and height of each vehicle."""

OTHERS: dict[str, tuple[float, float, float]] = {
    "walker.pedestrian.0001": (0.188, 0.188, 0.93),
    "walker.pedestrian.0010": (0.188, 0.188, 0.55),
    "static.prop.box01": (0.340, 0.340, 0.334),
    "static.prop.constructioncone": (0.172, 0.172, 0.293),
    "static.prop.container": (1.972, 0.966, 1.082),
    "static.prop.streetbarrier": (0.608, 0.189, 0.536),
    "static.prop.trafficcone01": (0.386, 0.386, 0.590),
    "static.prop.trafficwarning": (1.183, 1.435, 1.785),
    "static.trigger.friction": (0.0, 0.0, 0.0),
    "controller.ai.walker": (0.0, 0.0, 0.0),
}
STREAMED = (
    "sensor.camera.depth",
    "sensor.camera.rgb",
    "sensor.lidar.ray_cast",
    "sensor.other.collision",
    "sensor.other.gnss",
    "sensor.other.imu",
    "sensor.other.radar",
)
"""Sensors with a stream each; collisions are the only ones that send anything here."""

COLORS = ["17,37,103", "66,66,66", "137,0,0", "180,44,44", "255,255,255"]
CAMERA = {"image_size_x": "800", "image_size_y": "600", "fov": "90.0"}


@dataclass(frozen=True)
class Blueprint:
    """What an actor is made from.

    Attributes:
        extent: Half length, width, height (m).
        base: Base type of a vehicle; empty for the rest.
    """

    id: str
    extent: tuple[float, float, float] = (0.0, 0.0, 0.0)
    base: str = ""

    @property
    def kind(self) -> str:
        """First word of its id."""
        return self.id.partition(".")[0]

    @property
    def axle(self) -> float:
        """Metres from the middle to the front axle, and back to the rear one."""
        return AXLE_SHARE * self.extent[0]

    def definition(self, uid: int) -> list[Any]:
        """Return what `get_actor_definitions` tells of it."""
        attributes = [("role_name", STRING, "autopilot"), ("ros_name", STRING, self.id)]
        listed = [[name, kind, value, [value], True, False] for name, kind, value in attributes]
        for name, kind, value in OF_KIND.get(self.kind, []):
            listed.append([name, kind, value, [value], True, False])
        if self.kind == "vehicle":
            two_wheels = self.base in ("bicycle", "motorcycle")
            listed.append(["color", COLOR, COLORS[0], COLORS, True, True])
            listed.append(["base_type", STRING, self.base, [self.base], False, False])
            listed.append(["number_of_wheels", INT, "24"[not two_wheels], [], False, False])
        if self.id.startswith("sensor.camera"):
            listed += [[name, FLOAT, value, [value], True, False] for name, value in CAMERA.items()]
        return [uid, self.id, self.id.replace(".", ","), listed]


OF_KIND = {
    "walker": [("is_invincible", BOOL, "true"), ("speed", FLOAT, "0.0")],
    "sensor": [("sensor_tick", FLOAT, "0.0")],
    "static": [
        ("friction", FLOAT, "3.5"),
        *((f"extent_{axis}", FLOAT, "1000.0") for axis in "xyz"),
    ],
}
"""Name, type and value of the attributes that blueprints of a kind have."""

BLUEPRINTS: dict[str, Blueprint] = {
    each.id: each
    for each in (
        *(Blueprint(name, tuple(size), base) for name, (base, *size) in VEHICLES.items()),
        *(Blueprint(name, size) for name, size in OTHERS.items()),
        *(Blueprint(name) for name in STREAMED),
    )
}
