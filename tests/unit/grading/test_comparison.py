"""Deviations of motions that are known in closed form."""

import math

import pytest

from osc2tx.grading.comparison import EXACT, Recording, Row, compare
from osc2tx.grading.values import corners
from osc2tx.xosc import elements as xml

DT = 0.05  # s
EMPTY = xml.OpenSCENARIO(xml.Storyboard())


def straight(speed: float, *, late: float = 0.0, aside: float = 0.0, end: float = 4.0) -> list[Row]:
    """Return a motion along x that begins at standstill, after one second and a delay."""
    rows = []
    for step in range(round(end / DT) + 1):
        t = step * DT
        driven = max(t - 1.0 - late, 0.0)
        rows.append((t, speed * driven, aside, speed if driven else 0.0))
    return rows


def recording(rows: list[Row]) -> Recording:
    return Recording(rows[-1][0], {}, {"car": rows})


def test_equal_motions_do_not_deviate() -> None:
    found = compare(EMPTY, {}, recording(straight(10.0)), recording(straight(10.0)), DT)
    assert (found.place, found.speed, found.time, found.problems) == (0.0, 0.0, 0.0, ())
    assert not found.beyond(EXACT)


@pytest.mark.parametrize("aside", [0.05, 0.3, 2.0])
def test_an_offset_is_a_deviation(aside: float) -> None:
    moved = recording(straight(10.0, aside=aside))
    found = compare(EMPTY, {}, recording(straight(10.0)), moved, DT)
    assert found.place == pytest.approx(aside)
    assert found.beyond(EXACT) == ["car"] * (aside >= EXACT)


def test_a_step_of_delay_without_a_late_event_is_a_deviation() -> None:
    """Half a metre behind, it is where the other one was one step before."""
    found = compare(EMPTY, {}, recording(straight(10.0)), recording(straight(10.0, late=DT)), DT)
    assert found.place == pytest.approx(10.0 * DT)
    assert found.speed == 0.0
    assert found.beyond(EXACT)  # no event is late, so nothing explains it


def test_another_speed_is_a_deviation_that_grows() -> None:
    found = compare(EMPTY, {}, recording(straight(10.0)), recording(straight(9.0)), DT)
    assert found.place == pytest.approx(3.0)
    assert found.speed == pytest.approx(1.0)
    assert found.actors["car"].at == pytest.approx(4.0)
    assert found.actors["car"].since == pytest.approx(1.1, abs=DT)
    assert found.beyond(EXACT) == ["car"]


def test_ends_are_compared_unless_the_run_was_left() -> None:
    long, short = recording(straight(10.0, end=5.0)), recording(straight(10.0))
    found = compare(EMPTY, {}, long, short, DT)
    assert found.end == pytest.approx(1.0)
    assert "ends at 4 s instead of 5 s" in found.problems[0]
    left = Recording(math.inf, {}, short.track)
    assert not compare(EMPTY, {}, left, long, DT).problems


def ranges(*limits: tuple[str, str]) -> xml.OpenSCENARIO:
    parts = (
        xml.DeterministicSingleParameterDistribution(
            xml.DistributionRange(xml.Range(lowerLimit=low, upperLimit=high), stepWidth=1.0),
            parameterName=f"p{index}",
        )
        for index, (low, high) in enumerate(limits)
    )
    return xml.OpenSCENARIO(xml.ParameterValueDistribution(xml.Deterministic(*parts)))


def test_corners_of_ranges() -> None:
    assert corners(None) == []
    assert corners(ranges(("1", "2"))) == [{"p0": "1"}, {"p0": "2"}]
    assert corners(ranges(("1", "2"), ("3", "4"))) == [
        {"p0": "1", "p1": "3"},
        {"p0": "2", "p1": "4"},
        {"p0": "1", "p1": "4"},
        {"p0": "2", "p1": "3"},
    ]


def test_corners_of_tables_are_their_first_and_last_rows() -> None:
    rows = (
        xml.ParameterValueSet(xml.ParameterAssignment(parameterRef="p", value=str(value)))
        for value in range(9)
    )
    table = xml.DeterministicMultiParameterDistribution(xml.ValueSetDistribution(*rows))
    found = corners(xml.OpenSCENARIO(xml.ParameterValueDistribution(xml.Deterministic(table))))
    assert [row["p"] for row in found] == ["0", "1", "7", "8"]
