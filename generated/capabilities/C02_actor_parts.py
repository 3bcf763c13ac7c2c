"""Scenario `actor_parts`.

C02 Parts of actors: sizes, axles and hitches that a scenario says or leaves to the category of an
actor are values like any other; they place cars and make triggers.

Made by osc2tx from capabilities/C02_actor_parts.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Axle,
    Behaviour,
    BoundingBox,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Trailer,
    Until,
    Vehicle,
    fall,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import deg, m, mps

require_api(1)


class ActorParts(Scenario):
    name = "actor_parts"
    source = "capabilities/C02_actor_parts.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.box = self.argument("box", BoundingBox(length=5 * m, width=2 * m, height=1.6 * m))
        self.ego = self.cast(
            "ego", Vehicle(bounding_box=self.box, rear_overhang=1 * m, role="police")
        )
        self.front = self.argument(
            "front",
            Axle(
                position_x=3 * m,
                position_z=0.35 * m,
                max_steering=35 * deg,
                wheel_diameter=0.7 * m,
                track_width=1.6 * m,
            ),
        )
        self.rear = self.argument(
            "rear",
            Axle(
                position_x=0 * m,
                position_z=0.35 * m,
                max_steering=0 * deg,
                wheel_diameter=0.7 * m,
                track_width=1.6 * m,
            ),
        )
        self.van = self.cast(
            "van",
            Vehicle(
                vehicle_category="truck",
                axles=[self.front, self.rear],
                intended_infrastructure=["driving", "bus"],
            ),
        )
        self.load = self.cast("load", Trailer())

        # Two lengths of the car behind the van
        self.distance = 2 * self.ego.bounding_box.length
        self.wheelbase = self.van.axles[0].position_x - self.van.axles[1].position_x
        self.reach = self.load.coupler.position_x - self.van.trailer_receiver.position_x

        self.close = Event(
            fall(
                lambda: self.van.space_gap(reference=self.ego, direction="longitudinal")
                > self.wheelbase
            )
        )
        self.middle = self.sample(lambda: self.ego.bounding_box.center.x, self.close, 0 * m)
        self.weight = self.sample(lambda: self.ego.center_of_gravity.z, self.close, 0 * m)
        self.hitch = self.sample(lambda: self.reach, self.close, 0 * m)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.van, lane(2), position(100 * m), speed(10 * mps))
        self.place(
            self.ego,
            lane(2),
            position(self.distance, behind=self.van),
            speed(11 * mps if self.ego.role == "police" else 9 * mps),
        )
        self.place(self.load, lane(4), position(100 * m))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.van.drive(speed(10 * mps)),
            self._ego_drive_then_change_speed(),
            self.load.remain_stationary(),
        )

    def _ego_drive_then_change_speed(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive(speed(11 * mps if self.ego.role == "police" else 9 * mps)),
                self.close,
            ),
            self.ego.change_speed(target=10 * mps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ActorParts().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ActorParts))
