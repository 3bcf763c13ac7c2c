"""Scenario `top`.

Actions that say what they do, and modifiers that say what they modify.

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
    Vehicle,
    Wait,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, mps, s

require_api(1)


def brief() -> list[speed]:
    """Modifier `brief`."""
    # keep(it.duration == 2s)
    return [
        speed(9 * mps),
    ]


class Top(Scenario):
    name = "top"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.seen = Event()

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_quick_then_hurry(),
            On(
                self.event("quick.done"),
                Emit(self.seen),
            ),
        )

    def _ego_quick_then_hurry(self) -> Behaviour:
        return Serial(
            "do serial",
            self.invoke("quick", HurryMore, actor=self.ego),
            self.invoke(Hurry, actor=self.ego, to=20 * mps * 0.25),
            self.invoke(Platoon, first=self.ego, second=self.other, pace=8 * mps),
            self.ego.drive(*brief(), duration=2 * s),
            Wait(lambda: self.invoked("quick").to == 18 * mps),
        )


class Hurry(Scenario):
    """There and back to the speed it had"""

    name = "vehicle.hurry"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = self.cast("actor", Vehicle())
        self.to = self.parameter("to", 15 * mps, unit="mps")
        self.done = Event()

    def behavior(self) -> Behaviour:
        return Serial(
            self.short_name,
            self.actor.change_speed(target=self.to),
            Emit(self.done),
            self.actor.drive(duration=1 * s),
        )


class HurryMore(Hurry):
    name = "vehicle.hurry_more"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values, besides those of `Hurry`."""
        self.fix_to("to", 18 * mps)
        super().declare()


class Platoon(Scenario):
    """Nobody in particular"""

    name = "platoon"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.first = self.cast("first", Vehicle())
        self.second = self.cast("second", Vehicle())
        self.pace = self.required("pace", Speed, unit="mps")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.first, speed(self.pace), throughout=True)
        self.place(self.second, speed(self.pace), throughout=True)

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.first.drive(speed(self.pace)),
            self.second.drive(speed(self.pace)),
            duration=1 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Top))
