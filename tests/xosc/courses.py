"""Numbers of a document, and courses of values over time."""

import math
import re
from collections.abc import Callable
from itertools import pairwise

from lxml import etree

Node = etree._Element
Course = Callable[[float], float]  # seconds since its start -> value

RULES: dict[str, Callable[[float, float], bool]] = {
    "greaterThan": lambda a, b: a > b,
    "lessThan": lambda a, b: a < b,
    "greaterOrEqual": lambda a, b: a >= b - 1e-9,
    "lessOrEqual": lambda a, b: a <= b + 1e-9,
    "equalTo": lambda a, b: a == b,
    "notEqualTo": lambda a, b: a != b,
}


def number(node: Node, name: str, default: float = 0.0) -> float:
    text = node.get(name)
    return default if text is None else value_of(text, node.getroottree().getroot())


def value_of(text: str, root: Node) -> float:
    """Return the value of an attribute: a number, `$name` or `${arithmetic}`."""
    if not text.startswith("$"):
        return float(text)
    declared = {node.get("name"): node.get("value") for node in root.iter("ParameterDeclaration")}
    plain = re.sub(r"\$(\w+)", lambda found: f"({declared[found[1]]})", text.strip("${}"))
    if not text.startswith("${"):
        return float(declared[text[1:]])
    assert re.fullmatch(r"[-+*/(). 0-9e]+", plain), text
    return float(eval(plain))


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


def with_jerk(start: float, end: float, limit: float, jerk: float) -> tuple[Course, float]:
    """Return the fastest course within limits of acceleration and jerk, and its length.

    A trapezoid of the acceleration, which is zero at both ends; a triangle where the limit is not
    reached.
    """
    change = abs(end - start)
    peak = min(limit, math.sqrt(change * jerk))
    ramp = peak / jerk
    flat = change / peak - ramp if peak else 0.0
    time = flat + 2.0 * ramp

    def gained(t: float) -> float:
        if t <= ramp:
            return 0.5 * jerk * t * t if ramp else 0.0
        if t <= ramp + flat:
            return peak * (t - 0.5 * ramp)
        return change - 0.5 * jerk * (time - t) ** 2 if t < time else change

    return lambda t: start + math.copysign(gained(t), end - start), time


def between(points: list[tuple[float, float]], at: float) -> float:
    """Interpolate linearly."""
    for (t0, v0), (t1, v1) in pairwise(points):
        if at <= t1:
            return v0 + (v1 - v0) * max(at - t0, 0.0) / (t1 - t0)
    return points[-1][1]
