"""Scenario `pitch_and_roll`.

C26 Pitch and roll: a car lies on the road as that climbs and is banked, a box is turned over, and
a sign stands askew.

Made by osc2tx from capabilities/C26_pitch_and_roll.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    MovableObject,
    Orientation,
    Parallel,
    Point,
    Pose,
    Scenario,
    Serial,
    StationaryObject,
    Until,
    Vehicle,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, location, orientation, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class PitchAndRoll(Scenario):
    name = "pitch_and_roll"
    source = "capabilities/C26_pitch_and_roll.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="curve.xodr"))
        self.car = self.cast("car", Vehicle())
        self.box = self.cast("box", MovableObject())
        self.sign = self.cast("sign", StationaryObject())

        self.box_place = self.argument("box_place", Point(x=5 * m, y=40 * m, z=0 * m))
        self.sign_pose = self.argument(
            "sign_pose",
            Pose(x=5 * m, y=50 * m, z=0 * m, yaw=30 * deg, pitch=0 * deg, roll=10 * deg),
        )
        self.on_its_side = self.argument(
            "on_its_side", Orientation(yaw=20 * deg, pitch=0 * deg, roll=90 * deg)
        )

        self.up_hill = Event(rise(lambda: self.car.pose.orientation.pitch < -1 * deg))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.sign, location(self.sign_pose))
        self.place(self.car, lane(1), position(20 * m), speed(15 * mps))
        self.place(
            self.box,
            position(at_point=self.box_place, project_on_route=False),
            yaw(0 * deg, measure_by="relative_to_road"),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._car_drive_serial(),
            self._box_move_then_assign_orientation(),
            duration=12 * s,
        )

    def _car_drive_serial(self) -> Behaviour:
        return Serial(
            "car: serial",
            Until(
                self.car.drive(),
                self.up_hill,
            ),
            self.car.drive(orientation(pitch=0 * deg, roll=0 * deg, measure_by="relative_to_road")),
        )

    def _box_move_then_assign_orientation(self) -> Behaviour:
        return Serial(
            "box: serial",
            self.box.move(duration=1 * s),
            self.box.assign_orientation(orientation=self.on_its_side),
            self.box.move(
                orientation(roll=180 * deg, relative_to=self.sign, measure_by="absolute", at="end")
            ),
            self.box.move(speed(1 * mps)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PitchAndRoll().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PitchAndRoll))
