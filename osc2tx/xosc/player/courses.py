"""Numbers of a document, and courses of values over time."""

import math
from collections.abc import Callable, Mapping
from itertools import pairwise

from osc2tx.xosc import elements as xml
from osc2tx.xosc.arithmetic import text_value
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.errors import Unplayable

Course = Callable[[float], float]  # seconds since its start -> value

RULES: dict[str, Callable[[float, float], bool]] = {
    "greaterThan": lambda a, b: a > b,
    "lessThan": lambda a, b: a < b,
    "greaterOrEqual": lambda a, b: a >= b - 1e-9,
    "lessOrEqual": lambda a, b: a <= b + 1e-9,
    "equalTo": lambda a, b: a == b,
    "notEqualTo": lambda a, b: a != b,
}

PEAK_RATES = {"linear": 1.0, "cubic": 1.5, "sinusoidal": 0.5 * math.pi}
"""Peak of the rate of a transition, as a multiple of its mean. A rate that is told is the peak."""


def number(node: Element, name: str, default: float = 0.0) -> float:
    """Return the number of an attribute."""
    text = node.get(name)
    return default if text is None else float(text)


def with_parameters(root: Element, given: Mapping[str, str]) -> Element:
    """Replace the parameters in all attributes by their values: `$name` and `${arithmetic}`.

    Args:
        root: The document.
        given: Values to take instead of those of the declarations.
    """
    declared = {
        node.name: given.get(node.name, node.value) for node in root.below(xml.ParameterDeclaration)
    }
    return _resolved(root, declared)


def _resolved(node: Element, declared: Mapping[str, str]) -> Element:
    attributes = dict(node.attributes)
    if isinstance(node, xml.ParameterDeclaration):
        attributes["value"] = declared[node.name]
    for name, text in attributes.items():
        if text.startswith("$"):
            value = text_value(text, declared)
            if value is None and (name == "name" or name.endswith("Ref")):
                continue  # a name of an element may be any text
            if value is None:
                raise Unplayable(f"`{text}` has no value", node.place)
            attributes[name] = value
    children = (_resolved(child, declared) for child in node.children)
    return node.with_attributes(attributes).with_children(*children)


def shaped(shape: str, start: float, end: float, time: float) -> Course:
    """Return the course of a transition."""

    def course(t: float) -> float:
        if t >= time - 1e-9:
            return end
        part = t / time
        if shape == "sinusoidal":
            part = (1.0 - math.cos(math.pi * part)) / 2.0
        elif shape == "cubic":
            part = part * part * (3.0 - 2.0 * part)
        return start + (end - start) * part

    return course


def with_jerk(
    start: float, end: float, limit: float, jerk: float, rate: float = 0.0
) -> tuple[Course, float]:
    """Return the fastest course within limits of acceleration and jerk, and its length.

    The acceleration rises with a rate to its peak, stays there, and is zero at the end.
    """
    left = end - start - rate * abs(rate) / (2.0 * jerk)  # if the rate is just brought to zero
    sign = math.copysign(1.0, left)
    change, rate = sign * (end - start), sign * rate
    peak = max(min(limit, math.sqrt(max(change * jerk + 0.5 * rate * rate, 0.0))), 0.0)
    up, down = abs(peak - rate) / jerk, peak / jerk
    ramped = 0.5 * (rate + peak) * up + 0.5 * peak * down
    flat = max(change - ramped, 0.0) / peak if peak else 0.0
    time = up + flat + down
    steep = math.copysign(jerk, peak - rate)

    def gained(t: float) -> float:
        if t <= up:
            return rate * t + 0.5 * steep * t * t
        if t <= up + flat:
            return 0.5 * (rate + peak) * up + peak * (t - up)
        return change - 0.5 * jerk * (time - t) ** 2 if t < time else change

    return lambda t: start + sign * gained(t), time


def between(points: list[tuple[float, float]], at: float) -> float:
    """Interpolate linearly."""
    for (t0, v0), (t1, v1) in pairwise(points):
        if at <= t1:
            return v0 + (v1 - v0) * max(at - t0, 0.0) / (t1 - t0)
    return points[-1][1]
