"""Scenario `top`.

A road asked for by a `Path`, as ScenarioRunner has it.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect carla; a duration only ends its member early.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Person,
    RoadPath,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, on_path, position, speed
from osc2tx_runtime.units import kph, m, rad, s

require_api(1)


class Top(Scenario):
    name = "top"
    source = "input.osc"
    # A duration only ends its member early
    first_come = True

    def declare(self) -> None:
        """Cast, events and values."""
        self.town = self.parameter("town", "highway")
        self.path_map = self.cast("path.map", Map(map_file=self.town))  # the map
        # where to drive
        self.path = self.argument(
            "path",
            RoadPath(
                # at least three lanes
                min_lanes=3,
                min_length=200 * m,
            ),
        )
        self.ego_vehicle = self.cast("ego_vehicle", Vehicle(model="vehicle.tesla.model3"))
        self.npc = self.cast("npc", Vehicle(model="vehicle.jeep.wrangler_rubicon"))
        self.guest = self.cast("guest", Person(model="walker.pedestrian.0002"))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.guest, position(x=205 * m, y=-3 * m, z=0 * m, h=1.5 * rad, frame="carla"))
        self.place(self.npc, on_path(self.path), speed(30 * kph), lane(2, from_="left"))
        self.place(
            self.ego_vehicle,
            on_path(self.path),
            speed(30 * kph),
            lane(same_as=self.npc),
            position(15 * m, behind=self.npc),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.npc.drive(speed(30 * kph)),
            self._ego_vehicle_behind_then_drive(),
            duration=20 * s,
        )

    def _ego_vehicle_behind_then_drive(self) -> Behaviour:
        return Serial(
            "ego_vehicle: serial",
            self.ego_vehicle.drive("behind", speed(30 * kph), duration=5 * s),
            self.ego_vehicle.drive(lane(side_of=self.npc, side="left", at="end")),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Top))
