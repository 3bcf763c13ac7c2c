"""Scenario `fields`.

Fields of actors, of their parts and of the weather, read and fixed in all places.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Axle,
    BehavioralModel,
    Behaviour,
    BmEngine,
    BoundingBox,
    Call,
    Emit,
    Environment,
    Event,
    GeodeticPosition,
    HitchCoupler,
    HitchReceiver,
    Map,
    OrientationRate,
    Parallel,
    Person,
    Point,
    Pose,
    Precipitation,
    Scenario,
    Serial,
    Trailer,
    TranslationalAcceleration,
    TranslationalVelocity,
    Until,
    Vehicle,
    Velocity,
    Wait,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import Acceleration, deg, km, m, mmph, mps, mpsps, radps, s

require_api(1)


class Fields(Scenario):
    name = "fields"
    source = "input.osc"

    class Shaken(Event):
        """Event `shaken` and its parameters."""

        strength: Acceleration
        moving: Velocity

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast(
            "env",
            Environment(
                datetime=Environment.local_to_unix_time(2024, 6, 20, 12, 0, 0, 2.0),
                geodetic_position=GeodeticPosition(latitude=48.1 * deg, longitude=11.6 * deg),
            ),
        )

        # Values of structs: of their members, and as a whole
        self.place_ = self.argument("place", Point(x=120 * m, y=-20 * m))
        self.there = self.argument("there", Pose(position=self.place_, yaw=90 * deg))
        self.limit = self.argument(
            "limit",
            Velocity(
                translational=TranslationalVelocity(x=12 * mps),
                angular=OrientationRate(yaw=0.2 * radps),
            ),
        )
        self.push = self.argument("push", TranslationalAcceleration(x=3 * mpsps, y=4 * mpsps))
        self.box = self.argument("box", BoundingBox(length=5 * m, width=1.8 * m, height=1.5 * m))
        self.driver = self.argument(
            "driver", BehavioralModel(bm_engine=BmEngine(name="careful_driver"))
        )
        self.drizzle = self.argument("drizzle", Precipitation(intensity=0.5 * mmph))

        self.ego = self.cast(
            "ego",
            Vehicle(
                bounding_box=self.box,
                center=Point(x=1.4 * m),
                center_of_gravity=Point(x=1.3 * m),
                geometry_reference="limousine.glb",
                initial_bm=self.driver,
                role="civil",
                trailer_receiver=HitchReceiver(hitch_type="ball", max_rotation=80 * deg),
            ),
        )
        self.rear = self.argument(
            "rear",
            Axle(
                max_steering=0 * deg,
                wheel_diameter=0.8 * m,
                track_width=1.8 * m,
                position_x=0 * m,
                position_z=0.4 * m,
                number_of_wheels=4,
            ),
        )
        self.van = self.cast(
            "van",
            Vehicle(
                width=2.1 * m,
                initial_bm=BehavioralModel(bm_engine=BmEngine(name="steady_driver")),
                intended_infrastructure=["driving", "bus"],
                axles={0: Axle(max_steering=30 * deg, track_width=1.7 * m), 1: self.rear},
            ),
        )
        self.load = self.cast(
            "load",
            Trailer(
                trailer_category="central_axle_trailer",
                coupler=HitchCoupler(hitch_type="ball"),
                intended_infrastructure={0: "driving"},
            ),
        )
        self.walker = self.cast("walker", Person())

        # What follows from them
        self.overhang = self.ego.rear_overhang
        self.narrow = self.parameter(
            "narrow",
            self.van.bounding_box.width < 2.5 * m
            and self.load.trailer_category == "central_axle_trailer",
        )
        self.hard = self.parameter("hard", self.push.norm(), unit="mpss")
        self.steered = self.parameter(
            "steered", sum(it.max_steering > 0 * deg for it in self.van.axles)
        )
        self.on_foot = self.parameter(
            "on_foot", self.walker.intended_infrastructure[0] == "sidewalk"
        )

        self.turning = Event(rise(lambda: self.ego.velocity.angular.yaw > self.limit.angular.yaw))
        self.shaken = self.Shaken()
        self.where = self.sample(lambda: self.ego.pose.position, self.shaken, self.place_)
        self.fastest = self.sample(
            lambda: self.ego.velocity.translational.norm(), self.turning, 0 * mps
        )

        self.record("side_push", lambda: self.ego.acceleration.translational.y, unit="mpsps")
        self.record("sight", lambda: self.env.weather.fog.visual_range < 1 * km)
        self.cover(
            "wetness", lambda: self.env.weather.rain.intensity, unit="mmph", within=(0, 10), every=1
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(self.limit.translational.x))
        self.place(
            self.van, lane(3), position(100 * m), speed(2 * self.ego.bounding_box.length / (1 * s))
        )

    def is_fast(self, motion: Velocity) -> bool:
        return motion.translational.norm() > self.limit.translational.norm()

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_drive_then_call(),
            self._env_then_van(),
        )

    def _ego_drive_then_call(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive(),
                lambda: self.ego.velocity.translational.z > 1 * mps
                or self.ego.pose.position.x > self.place_.x,
            ),
            Emit(
                self.shaken,
                strength=lambda: self.ego.acceleration.translational.norm(),
                moving=lambda: self.ego.velocity,
            ),
            Call(lambda: self.ego.set_bm(self.driver)),
            Wait(lambda: self.env.weather.rain.intensity > self.drizzle.intensity),
            Wait(
                lambda: not self.is_fast(self.ego.velocity) and self.where.x > self.place_.x - 1 * m
            ),
            Wait(
                lambda: self.ego.velocity.translational.x > 0 * mps
                and self.env.sun.position.elevation > 0 * deg
            ),
        )

    def _env_then_van(self) -> Behaviour:
        return Serial(
            "serial",
            self.env.rain(intensity=1 * mmph),
            self.van.drive(speed(2 * self.ego.bounding_box.length / (1 * s)), duration=0.5 * s),
            self.van.change_lane(duration=self.van.bounding_box.length / (1 * mps)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Fields().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Fields))
