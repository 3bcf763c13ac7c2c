"""Scenarios `vehicle.stop_there`, `vehicle.stop_on_ice`, `vehicle.stop_tired_on_ice`, `top`.

Which scenario runs because of what a parameter of it is.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Literal, TypeAlias

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    any_of,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)

# Enums that the scenario declares
Surface: TypeAlias = Literal["dry", "wet", "icy"]


class StopThere(Scenario):
    name = "vehicle.stop_there"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = self.cast("actor", Vehicle())
        self.surface: Surface = self.parameter("surface", any_of("dry", "wet", "icy"))
        self.is_tired = self.parameter("is_tired", False)
        self.time_to_stop = self.parameter("time_to_stop", 4 * s, unit="s")

    def behavior(self) -> Behaviour:
        return self.actor.drive(speed(0 * mps, at="end"), duration=self.time_to_stop)


class StopOnIce(StopThere):
    name = "vehicle.stop_on_ice"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values, besides those of `StopThere`."""
        self.fix_to("surface", "icy")
        self.narrow_to("time_to_stop", 10 * s)
        super().declare()


class StopTiredOnIce(StopOnIce):
    name = "vehicle.stop_tired_on_ice"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values, besides those of `StopOnIce`."""
        self.fix_to("is_tired", True)
        self.fix_to("time_to_stop", 12 * s)
        super().declare()


class Top(Scenario):
    name = "top"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.found: Surface = self.parameter("found", any_of("dry", "wet", "icy"))
        self.ego_stop_there_surface: Surface = self.parameter(
            "ego.stop_there.surface", any_of("wet", "icy")
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(100 * m), speed(12 * mps))
        self.place(self.other, lane(3), position(100 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self._ego_and_other(),
            # Known by its argument
            self.invoke(StopOnIce, actor=self.other),
            # Drawn by the scenario
            self.invoke(
                "first",
                StopThere,
                StopOnIce.when(surface="icy"),
                actor=self.ego,
                surface=self.found,
            ),
            self.ego.drive(speed(10 * mps, at="end"), duration=5 * s),
            # Open in both, and read when it starts
            self.invoke(
                StopThere,
                StopTiredOnIce.when(surface="icy", is_tired=True),
                StopOnIce.when(surface="icy"),
                actor=self.ego,
                is_tired=lambda: self.ego.speed < 5 * mps,
                surface=self.ego_stop_there_surface,
            ),
        )

    def _ego_and_other(self) -> Behaviour:
        return Parallel(
            "parallel",
            self.ego.drive(lane(2), speed(12 * mps)),
            self.other.drive(lane(3), speed(12 * mps)),
            duration=1 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(StopThere, StopOnIce, StopTiredOnIce, Top))
