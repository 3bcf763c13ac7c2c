"""The properties of a simulator against the requirements of a run: `osc2tx world check NAME`."""

from __future__ import annotations

from typing import Literal

from osc2tx_runtime.world.protocol import ActorSpec
from osc2tx_shared.classes import dataclass

from .request import WorldRequest

CheckStatus = Literal["ok", "differs", "unknown"]
"""`unknown`: it was not tried, or cannot be found out."""


@dataclass(frozen=True, slots=True)
class CheckRequest:
    """The task of a check.

    Attributes:
        world: The request of a run to the world.
        actors: The actors of the scenario; none if no scenario is named.
        drives: Actors may be spawned and moved, which takes over the simulator for a while.
        fixes: Remnants of other clients are removed.
    """

    world: WorldRequest
    actors: tuple[ActorSpec, ...] = ()
    drives: bool = False
    fixes: bool = False


@dataclass(frozen=True, slots=True)
class CheckResult:
    """One line of a check.

    Attributes:
        number: Of the line.
        name: The compared property.
        status: The result.
        found: The finding, in one line.
        meaning: What that means for runs; empty where there is nothing to say.
        blocks: A run cannot begin.
    """

    number: int
    name: str
    status: CheckStatus
    found: str
    meaning: str = ""
    blocks: bool = False
