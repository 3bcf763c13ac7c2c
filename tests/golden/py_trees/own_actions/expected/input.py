"""Scenario `own_actions`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from typing import Protocol

from osc2tx_runtime import (
    Behaviour,
    Duration,
    Late,
    Map,
    Modifier,
    Parallel,
    PhysicalObject,
    Scenario,
    Serial,
    Vehicle,
    global_action,
    main,
    require_api,
    user_action,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Time, kph, mps, s

require_api(1)


class Note(Protocol):
    """Action `note`.

    Nobody does it.
    """

    def __call__(
        self,
        label: str | None = None,
        /,
        *,
        text: Late[str] = ...,
        level: Late[int] = 1,
        duration: Duration | None = None,
    ) -> Behaviour: ...


note: Note = global_action("note", Note)


class Honk(Protocol):
    """Action `vehicle.honk`."""

    def __call__(
        self,
        actor: Vehicle,
        label: str | Modifier | None = None,
        /,
        *modifiers: Modifier,
        times: Late[int] = ...,
        loudness: Late[float] = 0.5,
        at_whom: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour: ...


honk: Honk = user_action("honk", Honk)


class KeepHonking(Protocol):
    """Action `vehicle.keep_honking`.

    Until somebody hears it.
    """

    def __call__(
        self,
        actor: Vehicle,
        label: str | Modifier | None = None,
        /,
        *modifiers: Modifier,
        times: Late[int] = ...,
        loudness: Late[float] = 0.5,
        at_whom: PhysicalObject,
        pause: Late[Time] = 2 * s,
        duration: Duration | None = None,
    ) -> Behaviour: ...


keep_honking: KeepHonking = user_action("keep_honking", KeepHonking)


class OwnActions(Scenario):
    name = "own_actions"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            note(text="honking"),
            honk(self.ego, times=3, at_whom=self.ego),
            self._ego_keep_honking_and_drive(),
            honk(self.ego, speed(20 * kph), times=2, at_whom=self.ego),
        )

    def _ego_keep_honking_and_drive(self) -> Behaviour:
        return Parallel(
            "ego: parallel",
            keep_honking(self.ego, times=1, at_whom=self.other, duration=6 * s),
            self.ego.drive(speed(10 * mps)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnActions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OwnActions))
