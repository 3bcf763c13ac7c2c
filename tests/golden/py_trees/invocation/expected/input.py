"""Scenarios `vehicle.approach`, `top`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
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
from osc2tx_runtime.units import Speed, kph, m, mps, s

require_api(1)


class Approach(Scenario):
    """Closes in on a lead vehicle."""

    name = "vehicle.approach"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = self.cast("actor", Vehicle())
        self.lead = self.cast("lead", Vehicle())
        self.gap = self.parameter("gap", within(10 * m, 30 * m), unit="m")
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

    def behavior(self) -> Behaviour:
        return Serial(
            self.short_name,
            Until(
                self.actor.drive("close_in", speed(70 * kph)),
                self.near,
            ),
            self.actor.keep_space_gap(
                "hold", reference=self.lead, direction="longitudinal", duration=2 * s
            ),
        )


class Top(Scenario):
    name = "top"
    source = "input.osc"

    class Told(Event):
        """Event `told` and its parameters."""

        v: Speed
        note: str

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.car1 = self.cast("car1", Vehicle())
        self.told = self.Told(defaults={"note": "x"})
        self.v_seen = self.sample(lambda: self.ego.speed, self.event("p1.near"), 0 * mps)
        self.done = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.car1, lane(2), position(200 * m), speed(50 * kph))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._car1_p1_and_drive(),
            On(
                self.told,
                Emit(self.done),
                condition=lambda: self.told.v > 1 * mps,
            ),
        )

    def _car1_p1_and_drive(self) -> Behaviour:
        return Parallel(
            "do parallel",
            self.invoke("p1", Approach, actor=self.ego, lead=self.car1, gap=15 * m),
            self.car1.drive(speed(50 * kph)),
            self._wait_then_emit_told(),
            overlap="start",
        )

    def _wait_then_emit_told(self) -> Behaviour:
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
