"""Scenario `move_drive_walk`.

C05 Move, drive, walk: the three motion primitives, each with a speed of its own.

Made by osc2tx from capabilities/C05_move_drive_walk.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    MovableObject,
    Parallel,
    Person,
    Point,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class MoveDriveWalk(Scenario):
    name = "move_drive_walk"
    source = "capabilities/C05_move_drive_walk.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.car = self.cast("car", Vehicle())
        self.ball = self.cast("ball", MovableObject())
        self.walker = self.cast("walker", Person())

        self.ball_place = self.argument("ball_place", Point(x=60 * m, y=-30 * m, z=0 * m))
        self.walker_place = self.argument("walker_place", Point(x=40 * m, y=-30 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.car, lane(2), position(50 * m), speed(20 * mps))
        self.place(
            self.ball,
            position(at_point=self.ball_place, project_on_route=False),
            yaw(-90 * deg),
            speed(3 * mps),
        )
        self.place(
            self.walker,
            position(at_point=self.walker_place, project_on_route=False),
            yaw(180 * deg),
            speed(1.4 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.car.drive(speed(20 * mps)),
            self.ball.move(speed(3 * mps)),
            self.walker.walk(speed(1.4 * mps)),
            duration=10 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return MoveDriveWalk().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(MoveDriveWalk))
