"""What is perturbed: a scenario in which a condition holds, and a change that breaks it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    Path,
    Pose,
    Serial,
    Trajectory,
)
from osc2tx_runtime.domain.shapes import (
    AnyShape,
    OwnShape,
)
from osc2tx_runtime.modifiers import (
    physical_movement,
    speed,
)
from tests.runtime.world.two_cars import TwoCars

from .kit import Body, Change

JUMP = physical_movement("prefer_non_physical")
ALL, START, END = "all", "start", "end"


@dataclass(frozen=True)
class Case:
    """A modifier or action that holds in a trace, and what breaks it.

    Attributes:
        name: Of the modifier, or of the action that states it, in the violation.
        body: The behavior.
        change: What changes in the state of `actor`.
        tolerance: By how much it may change (of the unit of the change).
        at: At which states it counts.
        actor: Whose state it is.
        slack: What may change within the last step on top.
        last: How many states change at the end.
        first: Step that changes where it counts at the start.
        action: The action whose condition it is.
    """

    name: str
    body: Body
    change: Change
    tolerance: float
    at: str = ALL
    actor: str = "a"
    slack: float = 0.0
    last: int = 1
    first: int = 0
    action: str = "drive"

    def __str__(self) -> str:
        return f"{self.action}-{self.name}-{self.at}-{self.change.__name__}-{self.actor}"


def two(*modifiers: object) -> Body:
    """Both drive for 2 s, `a` with modifiers."""
    return lambda s: Parallel("both", s.a.drive(*modifiers), s.b.drive(speed(12.0)), duration=2.0)


def beside(make: object) -> Body:
    """Likewise, with a modifier that refers to `b`."""
    return lambda s: Parallel(
        "both", s.a.drive(make(s)), s.b.drive(speed(12.0)), duration=2.0  # type: ignore[operator]
    )


LINE = (Pose(50.0, -8.75, 0.0), Pose(90.0, -8.75, 0.0))
"""Straight on from where `a` starts, in 4 s."""
EARLIER = (Pose(49.0, -8.75, 0.0), LINE[1])


def own(kind: AnyShape, value: Callable[[float], float]) -> OwnShape[Any]:
    """A shape of a scenario: the value at each time."""
    return OwnShape(kind, lambda _shape, time: value(time))


def course(action: str, way: Path | Trajectory) -> Body:
    return lambda s: getattr(s.a, action)(absolute=way)


def gap(action: str, target: float) -> Body:
    """`a` gets to a gap behind `b` (m or s)."""
    return lambda s: getattr(s.a, action)(target=target, direction="behind", reference=s.b)


def kept(action: str) -> Body:
    """`a` keeps a gap or headway to `b`, which is as fast."""
    return lambda s: Serial(
        "all",
        s.b.change_speed(target=10.0),
        Parallel("kept", getattr(s.a, action)(reference=s.b), s.b.keep_speed(), duration=2.0),
    )


def standing(s: TwoCars, action: Behaviour) -> Behaviour:
    """`a` stands for 2 s."""
    return Serial("all", s.a.assign_speed(speed=0.0), Parallel("stands", action, duration=2.0))
