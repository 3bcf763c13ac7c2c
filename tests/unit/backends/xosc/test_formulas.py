"""Formulas of documents over whole ranges: each has a value everywhere, and demands have a sign."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.xosc.arithmetic import Range, evaluated, range_of
from tests.unit.backends.xosc.test_parameters import RANGE, emitted

RANGES = ("[30kph..60kph]", "[10mps..12.5mps]")
TARGETS = ("45kph", "v", "v + 5mps", "2 * v - 12.5mps", "(v + 45kph) / 2")
COURSES = (
    ("constant", "rate_peak: 2.7mpss"),
    ("constant", "duration: 4s"),
    ("smooth", "rate_peak: 2.7mpss"),
    ("smooth", "duration: 4s"),
    ("none", "rate_peak: 2mpss"),
)
POINTS = 97


@pytest.mark.parametrize("range_", RANGES)
@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(("profile", "course"), COURSES)
def test_no_formula_divides_by_zero(
    range_: str, target: str, profile: str, course: str, tmp_path: Path
) -> None:
    """Also at speeds at which nothing has to change: 45 km/h is within some of the ranges."""
    found = emitted(
        tmp_path,
        RANGE.format("v", "speed", range_),
        speed="v",
        target=target,
        profile=profile,
        course=course,
    )
    root = etree.fromstring(found.xml.encode())
    limits = [float(node.get("value", "")) for node in root.iter("ValueConstraint")]
    low, high = (min(limits), max(limits)) if limits else (0.0, 0.0)
    values = [low + step * (high - low) / POINTS for step in range(POINTS + 1)]
    values += [each for each in (12.5, 6.25) if low <= each <= high]
    formulas = {
        text for node in root.iter() for text in node.attrib.values() if text.startswith("${")
    }
    others = {
        node.get("name", ""): float(node.get("value", ""))
        for node in root.iter("ParameterDeclaration")
        if node.get("parameterType") == "double"
    }
    for formula, value in itertools.product(formulas, values):
        assert evaluated(formula, {**others, "v": value}) is not None, (formula, value)


def test_what_a_change_with_a_peak_asks_of_the_vehicle_is_a_constant(tmp_path: Path) -> None:
    """The formula of the peak was 0 / 0 where the change has nothing to do."""
    found = emitted(
        tmp_path,
        RANGE.format("v", "speed", "[30kph..60kph]"),
        speed="v",
        target="45kph",
        course="rate_peak: 9mpss",
    )
    (performance,) = etree.fromstring(found.xml.encode()).iter("Performance")
    assert performance.get("maxAcceleration") == "9"
    assert performance.get("maxDeceleration") == "9"


@pytest.mark.parametrize(
    ("speed", "target", "acceleration", "deceleration"),
    [("20mps", "5mps", "4", "9.5"), ("5mps", "20mps", "9.5", "8")],
)
def test_demands_count_in_their_own_direction(
    speed: str, target: str, acceleration: str, deceleration: str, tmp_path: Path
) -> None:
    """What an actor has to brake says nothing of how it speeds up."""
    for start in (speed, "v"):
        low, high = (18, 22) if speed == "20mps" else (4, 6)
        found = emitted(
            tmp_path,
            RANGE.format("v", "speed", f"[{low}mps..{high}mps]"),
            speed=start,
            target=target,
            course="rate_peak: 9.5mpss",
        )
        (performance,) = etree.fromstring(found.xml.encode()).iter("Performance")
        assert performance.get("maxAcceleration") == acceleration
        assert performance.get("maxDeceleration") == deceleration


@pytest.mark.parametrize(
    ("formula", "is_right"),
    [
        ("$x", True),
        ("${$x - 3}", True),
        ("${1 / $x}", True),
        ("${1 / ($x - 3)}", False),
        ("${1 / ($x + $y)}", True),
        ("${1 / (2 * $x - 3 * $y)}", False),
        ("${$x / (1 - -$x)}", True),
        ("${1 / $z}", False),
        ("${1 / round($x)}", False),
    ],
)
def test_divisors_over_ranges(formula: str, is_right: bool) -> None:
    found = range_of(formula, {"x": Range(2.0, 4.0), "y": Range(1.0, 2.0)})
    assert (found is not None) is is_right
