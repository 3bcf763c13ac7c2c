"""Numbers of a document and courses of values over time, for the player."""

import math
import re
from collections.abc import Callable
from functools import cache
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


@cache
def with_jerk(
    start: tuple[float, float], end: float, limit: float, jerk: float
) -> tuple[Course, float]:
    """Return the fastest course within limits of acceleration and jerk, and its length.

    Step by step: it speeds up as long as the speed would fall short if the acceleration were
    brought to zero from now on.
    """
    h = 1e-3
    v, a = start
    points = [(0.0, v)]
    for step in range(1, 1_000_000):
        short = end - (v + a * abs(a) / (2.0 * jerk))
        wanted = math.copysign(min(limit, abs(short) / h), short)
        a += min(max(wanted - a, -jerk * h), jerk * h)
        v += a * h
        if abs(v - end) < 1e-3 and abs(a) < 10.0 * jerk * h:
            break
        if step % 10 == 0:
            points.append((step * h, v))
    points.append((step * h, end))
    return lambda t: between(points, t), step * h


def between(points: list[tuple[float, float]], at: float) -> float:
    """Interpolate linearly."""
    for (t0, v0), (t1, v1) in pairwise(points):
        if at <= t1:
            return v0 + (v1 - v0) * max(at - t0, 0.0) / (t1 - t0)
    return points[-1][1]
