"""What a simulator is like, compared with what a run relies on: `osc2tx world check NAME`."""

from __future__ import annotations

from typing import Literal

from osc2tx_runtime.world.protocol import ActorSpec
from osc2tx_shared.classes import dataclass

from .request import WorldRequest

__all__ = ["CheckRequest", "CheckResult", "CheckStatus"]

CheckStatus = Literal["ok", "differs", "unknown"]
"""`unknown`: it was not tried, or cannot be found out."""


@dataclass(frozen=True, slots=True)
class CheckRequest:
    """What is to be checked.

    Attributes:
        world: What a run would request of the world.
        actors: Those of the scenario; none if no scenario is named.
        drives: Actors may be spawned and moved, which takes over the simulator for a while.
        fixes: What others have left behind is removed.
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
        name: What is compared.
        status: The result.
        found: What was found, in one line.
        meaning: What that means for runs; empty where there is nothing to say.
        blocks: A run cannot begin.
    """

    number: int
    name: str
    status: CheckStatus
    found: str
    meaning: str = ""
    blocks: bool = False
