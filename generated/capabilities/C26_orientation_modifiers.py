"""Scenario `orientation_modifiers`.

C26 Orientation modifiers: headings against the road, against the world and against another
person.

Made by osc2tx from capabilities/C26_orientation_modifiers.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Person,
    Point,
    Scenario,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import orientation, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class OrientationModifiers(Scenario):
    name = "orientation_modifiers"
    source = "capabilities/C26_orientation_modifiers.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.along = self.cast("along", Person())
        self.guide = self.cast("guide", Person())
        self.opposite = self.cast("opposite", Person())

        self.along_place = self.argument("along_place", Point(x=100 * m, y=-30 * m, z=0 * m))
        self.guide_place = self.argument("guide_place", Point(x=100 * m, y=-40 * m, z=0 * m))
        self.opposite_place = self.argument("opposite_place", Point(x=100 * m, y=-50 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(
            self.along,
            position(at_point=self.along_place, project_on_route=False),
            yaw(30 * deg),
            speed(1 * mps),
        )
        self.place(
            self.guide,
            position(at_point=self.guide_place, project_on_route=False),
            orientation(yaw=-45 * deg, measure_by="absolute"),
            speed(1 * mps),
        )
        self.place(
            self.opposite,
            position(at_point=self.opposite_place, project_on_route=False),
            yaw(180 * deg, relative_to=self.guide, measure_by="length_to_length"),
            speed(1 * mps),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.along.walk(speed(1 * mps)),
            self.guide.walk(speed(1 * mps)),
            self.opposite.walk(speed(1 * mps)),
            duration=5 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OrientationModifiers().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OrientationModifiers))
