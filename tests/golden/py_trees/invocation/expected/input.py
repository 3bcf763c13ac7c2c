"""Scenarios `vehicle.approach`, `top`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    On,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import kph, m, mps, s

require_api(1)


class Approach(Scenario):
    """Scenario `vehicle.approach` (input.osc:6).

    Closes in on a lead vehicle.
    """

    name = "vehicle.approach"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = Vehicle()
        self.lead = Vehicle()
        self.gap = self.parameter("gap", within(10 * m, 30 * m))
        self.near = Event(
            rise(
                lambda: self.actor.object_distance(reference=self.lead, direction="euclidean")
                < 2 * self.gap
            )
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(
            self.actor, lane(same_as=self.lead), position(60 * m, behind=self.lead), speed(70 * kph)
        )

    def behavior(self) -> Behaviour:  # input.osc:12
        return Serial(
            "approach",
            Until(
                self.actor.drive(speed(70 * kph)),
                self.near,
                label="close_in",
            ),
            self.actor.keep_space_gap(
                reference=self.lead, direction="longitudinal", duration=2 * s, label="hold"
            ),
        )


class Top(Scenario):
    """Scenario `top` (input.osc:20)."""

    name = "top"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = Map(map_file="highway.xodr")
        self.ego = Vehicle()
        self.car1 = Vehicle()
        self.told = Event(parameters={"v": None, "note": "x"})
        self.v_seen = self.sample(lambda: self.ego.speed, self.event("p1.near"), 0 * mps)
        self.done = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.car1, lane(2), position(200 * m), speed(50 * kph))

    def behavior(self) -> Behaviour:  # input.osc:31
        return Parallel(
            "top",
            self.do_parallel(),
            On(
                self.told,
                Emit(self.done),
                condition=lambda: self.told["v"] > 1 * mps,
            ),
        )

    def do_parallel(self) -> Behaviour:  # input.osc:31
        return Parallel(
            "do parallel",
            self.invoke(Approach, actor=self.ego, lead=self.car1, gap=15 * m, label="p1"),
            self.car1.drive(speed(50 * kph)),
            self.serial(),
            overlap="start",
        )

    def serial(self) -> Behaviour:  # input.osc:37
        return Serial(
            "serial",
            Wait(self.event("p1.near")),
            Emit(self.told, v=lambda: self.ego.speed),
            Wait(lambda: self.v_seen > 10 * kph),
            Wait(self.ended("p1")),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Approach, Top))
