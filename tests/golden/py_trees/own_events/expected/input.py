"""Scenarios `vehicle.step`, `walk_around`, `own_events`.

Events of objects, of the scenario itself and deep inside of others.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Unpack

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    On,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.fields import VehicleFields
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, mps, mpsps, ms, s

require_api(1)


class Probe(Vehicle):
    """Actor `probe`."""

    kinds = ("probe", *Vehicle.kinds)

    def __init__(self, *, limit: Speed = 12 * mps, **fields: Unpack[VehicleFields]) -> None:
        super().__init__(**fields)
        self.limit = limit


class Step(Scenario):
    name = "vehicle.step"
    source = "input.osc"

    class Moving(Event):
        """Event `moving` and its parameters."""

        at: Speed
        name_: str

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = self.cast("actor", Vehicle())
        self.pace = self.parameter("pace", within(5 * mps, 6 * mps), unit="mps")
        self.moving = self.Moving(defaults={"name_": "step"})

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.actor, speed(self.pace), throughout=True)

    def behavior(self) -> Behaviour:
        return Serial(
            self.short_name,
            self.actor.drive("roll", speed(self.pace), duration=1 * s),
            Emit(self.moving, at=lambda: self.actor.speed),
            self.actor.drive(duration=1 * s),
        )


class WalkAround(Scenario):
    name = "walk_around"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.car = self.cast("car", Vehicle())

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.invoke("inner", Step, actor=self.car),
        )


class OwnEvents(Scenario):
    name = "own_events"
    source = "input.osc"
    is_main = True

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Probe())
        self.other = self.cast("other", Vehicle())
        self.begun = Event()
        self.over = Event()
        self.reached = Event()
        self.told = Event()
        self.heard = Event()
        # Too fast for its own good
        self.ego_fast = Event(rise(lambda: self.ego.speed > self.ego.limit), name="ego.fast")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_round_serial(),
            On(
                self.event("round.inner.moving"),
                Emit(self.told),
                condition=lambda: self.event("round.inner.moving", Step.Moving).at > 1 * mps
                and self.event("round.inner.moving", Step.Moving).name_ == "step",
            ),
        )

    def _ego_round_serial(self) -> Behaviour:
        return Serial(
            "do serial",
            # Right at the start
            Emit(self.begun),
            self._ego_round_and_drive(),
            Emit(self.over),
        )

    def _ego_round_and_drive(self) -> Behaviour:
        return Parallel(
            "do parallel",
            self.invoke("round", WalkAround, car=self.other),
            self._ego_drive_serial(),
            self._wait_then_emit_reached(),
            self._wait_then_emit_heard(),
            self._wait_serial(),
        )

    def _ego_drive_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            self.ego.drive(speed(15 * mps, at="end"), duration=3 * s),
        )

    def _wait_then_emit_reached(self) -> Behaviour:
        return Serial(
            "serial",
            Wait(self.ego_fast),
            Emit(self.reached),
        )

    def _wait_then_emit_heard(self) -> Behaviour:
        return Serial(
            "serial 2",
            Wait(self.event("round.inner.roll.end")),
            Wait(elapsed(lambda: self.other.speed / (10 * mpsps))),
            Wait(lambda: self.other.speed < 7 * mps),
            Emit(self.heard),
        )

    def _wait_serial(self) -> Behaviour:
        return Serial(
            "serial 3",
            Wait(self.reached, condition=elapsed(500 * ms)),
            Wait(lambda: self.other.speed > 4 * mps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnEvents().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Step, WalkAround, OwnEvents))
