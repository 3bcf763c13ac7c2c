"""The time at which a modifier with a shape has to hold, and its value (DSL 8.10)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    ChangeSpeed,
    Lane,
    Lateral,
    Orient,
    Position,
    Speed,
    Yaw,
)
from osc2tx_runtime.domain.modifiers.base import own_course
from osc2tx_runtime.enums import At
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase

Shaped = Speed | ChangeSpeed | Acceleration | Lateral | Position | Yaw | Orient
ShapedT = TypeVar("ShapedT", bound=Shaped)

VALUES: dict[type, str] = {
    Speed: "speed",
    ChangeSpeed: "speed",
    Acceleration: "acceleration",
    Lateral: "distance",
    Position: "distance",
    Yaw: "angle",
    Orient: "yaw",
}
"""The parameter that a shape computes, by modifier."""


def is_course(modifier: Shaped | Lane) -> bool:
    """Whether a common shape covers the whole phase, so that the stated value holds at the end."""
    if modifier.at != "all" or own_course(modifier.shape) is not None:
        return False
    return modifier.shape is not None or (isinstance(modifier, Speed) and modifier.shaped)


def follows_course(modifier: Shaped) -> bool:
    """Whether a shape of the scenario computes its value at each time."""
    return modifier.at == "all" and own_course(modifier.shape) is not None


def moment(modifier: Shaped | Lane) -> At:
    """The time at which it has to hold."""
    return "end" if is_course(modifier) else modifier.at


def present(modifier: ShapedT, phase: Phase) -> Callable[[], ShapedT]:
    """Return a reader of the modifier with the value that its shape computes for this step."""
    course, name = own_course(modifier.shape), VALUES[type(modifier)]
    if course is None or modifier.at != "all":
        return lambda: modifier
    changed: dict[str, Any] = {"shape": None}
    if hasattr(modifier, f"{name}_range"):
        changed[f"{name}_range"] = None

    def now() -> ShapedT:
        changed[name] = course.value(phase.elapsed)
        return replace(modifier, **changed)

    return now


def limits(
    modifier: ShapedT, phase: Phase, read: Callable[[ShapedT], tuple[float, float]]
) -> Callable[[], tuple[float, float]]:
    """Return a reader of the least and the greatest value: those at the start, or of a shape."""
    if follows_course(modifier):
        modified = present(modifier, phase)
        return lambda: read(modified())
    fixed = read(modifier)
    return lambda: fixed
