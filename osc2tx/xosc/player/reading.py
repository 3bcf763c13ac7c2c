"""How tools read documents where they deviate from the standard."""

from __future__ import annotations

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """How a tool reads documents where it deviates from the standard.

    Attributes:
        is_lazy: Behind a false condition of a group it evaluates only delayed ones.
        latches: Each condition of a group is required once, not all at one time.
        counts_from_looking: A time counts from the first evaluation.
        carries_acceleration: A profile of speeds begins with the present acceleration.
        counts_along_roads: A position relative to an entity counts metres along its road, not its
            lane.
        commands_speeds: A speed without a direction is that along the entity.
        fits_gaps: A gap without limits is fitted in each step, to the space between boxes.
        sends_along_lanes: Who has no path moves along the lane, walkers and objects as well.
        guesses_at_forks: At a fork, lane changes and driving against traffic may lead anywhere.
    """

    is_lazy: bool = False
    latches: bool = False
    counts_from_looking: bool = False
    carries_acceleration: bool = False
    counts_along_roads: bool = False
    commands_speeds: bool = False
    fits_gaps: bool = False
    sends_along_lanes: bool = False
    guesses_at_forks: bool = False


BY_THE_STANDARD = Reading()
