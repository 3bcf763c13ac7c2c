"""Lamps of traffic light types and their meanings, as data (DSL 8.15.2, 8.15.3).

OpenDRIVE only states the type of a traffic light; `BOXES` lists its lamps. A scenario may list the
lamps of a light itself (`traffic_light.bulbs`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from osc2tx_runtime.enums import BulbColor, BulbIcon, BulbState, SemanticTrafficLightState


class Lamp(NamedTuple):
    """A lamp of a traffic light.

    Attributes:
        color: Its color.
        icon: Symbol on it, a `bulb_icon` of the DSL.
    """

    color: BulbColor
    icon: BulbIcon

    @property
    def is_arrow(self) -> bool:
        """Whether it applies to one direction only."""
        return self.icon.startswith("arrow")

    @property
    def for_pedestrians(self) -> bool:
        """Whether it does not apply to vehicles."""
        return self.icon.startswith(("pedestrian", "txt_"))


BOXES: Mapping[str, tuple[Lamp, ...]] = {
    "1000001": (Lamp("red", "circle"), Lamp("yellow", "circle"), Lamp("green", "circle")),
    "1000002": (Lamp("red", "pedestrian_standing"), Lamp("green", "pedestrian_walking")),
}
"""Lamps by type of the signal in the catalogue `OpenDRIVE`, top to bottom."""

# Meaning -> color, whether the lamp must (not) be an arrow, and how it is lit; other lamps are off.
# If two meanings light the same lamps, the first counts.
MEANINGS: Mapping[
    SemanticTrafficLightState, tuple[tuple[BulbColor, bool | None, BulbState], ...]
] = {
    "off": (),
    "stop": (("red", None, "is_on"),),
    "attention": (("red", None, "is_on"), ("yellow", None, "is_on")),
    "stop_attention": (("yellow", None, "is_on"),),
    "caution": (("yellow", None, "is_flashing"),),
    "go": (("green", False, "is_on"),),
    "go_exclusive": (("green", True, "is_on"),),
}
"""The lamps of each meaning (as in most of Europe)."""


def lamps_that_mean(
    lamps: Sequence[Lamp], meaning: SemanticTrafficLightState
) -> tuple[BulbState, ...] | None:
    """States of the lamps for a meaning; None if the light has no lamps for it."""
    broken = meaning == "non_functional"
    states: list[BulbState] = ["unknown" if broken else "is_off" for _ in lamps]
    for color, arrow, state in MEANINGS.get(meaning, ()):
        found = [
            i
            for i, lamp in enumerate(lamps)
            if lamp.color == color and (arrow is None or lamp.is_arrow == arrow)
        ]
        if not found:
            return None
        for i in found:
            states[i] = state
    return tuple(states)


def meaning_of(lamps: Sequence[Lamp], states: Sequence[BulbState]) -> SemanticTrafficLightState:
    """The meaning of a light; `non_functional` if no traffic rule covers its lamps."""
    shown = tuple(states)
    for meaning in MEANINGS:
        if lamps_that_mean(lamps, meaning) == shown:
            return meaning
    return "non_functional"
