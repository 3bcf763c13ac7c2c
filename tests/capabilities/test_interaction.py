"""C13 to C15: gaps in time and space, headways.

The controller of gaps ends a change when the gap has been right within 0.1 m for four steps at
about equal speeds; across the road, within 0.05 m. A gap is measured here by the boxes in the
header and the places in the trace.
"""

import pytest

from tests.capabilities.kit import Perform

REACHED = 0.1  # m, tolerance of a gap that counts as reached


def test_c13_time_gap_is_reached_and_held(perform: Perform) -> None:
    run = perform("C13_time_gap")
    assert run.status == "success"

    def gap(t: float) -> float:
        """Rear end to front end over the speed of the one behind (s)."""
        between = run.rear("leader", t) - run.front("follower", t)
        return float(between / run.at("follower", t)["v"])

    assert gap(0.0) == pytest.approx((60.0 - 4.6) / 20.0, abs=1e-6)
    change = run.span("follower change_time_gap")
    assert change.end == run.event("closed_up")
    assert gap(change.end) == pytest.approx(1.5, abs=REACHED / 20.0)
    # 15 m/s since a while: the follower has let the distance shrink to 1.5 s at its new speed.
    end = run.last("leader")["t"]
    assert run.at("leader", end)["v"] == 15.0
    assert run.at("follower", end)["v"] == pytest.approx(15.0, abs=0.05)
    assert gap(end) == pytest.approx(1.5, abs=2 * REACHED / 15.0)
    # In between the wanted distance shrinks with 1.5 s times the deceleration, 15/8 of 5 m/s in 6 s
    # at most; the controller closes 0.6 of its error in a second.
    most = 1.5 * (15.0 / 8.0 * 5.0 / 6.0) / 0.6 / 15.0
    gaps = [gap(line["t"]) for line in run.states("leader") if line["t"] > change.end]
    assert min(gaps) > 1.5 - REACHED / 15.0 and max(gaps) < 1.5 + most


def test_c14_space_gap_behind_and_beside(perform: Perform) -> None:
    run = perform("C14_space_gap")
    assert run.status == "success"

    def gap(t: float) -> float:
        return run.rear("leader", t) - run.front("follower", t)

    assert gap(0.0) == pytest.approx(50.0 - 4.6, abs=1e-6)
    change = run.span("follower change_space_gap")
    assert gap(change.end) == pytest.approx(12.0, abs=REACHED)
    stay = run.span("follower keep_space_gap")
    assert stay.length == 5.0
    gaps = [gap(line["t"]) for line in run.during("follower", stay)]
    # what was found at its start is what it keeps
    assert gaps == pytest.approx([gaps[0]] * len(gaps), abs=REACHED)
    # Side to side: the middles are a whole car width further apart.
    beside = run.span("side_car change_space_gap")
    left = run.at("side_car", beside.end)["y"] - run.at("leader", beside.end)["y"]
    assert left - run.box("leader")["width"] == pytest.approx(1.2, abs=0.05)


def test_c15_headway_counts_from_front_to_front(perform: Perform) -> None:
    run = perform("C15_headway")
    assert run.status == "success"

    def headway(actor: str, t: float) -> float:
        return run.front("leader", t) - run.front(actor, t)

    near = run.span("near change_space_headway")
    assert headway("near", near.end) == pytest.approx(25.0, abs=REACHED)
    for line in run.during("near", run.span("near keep_space_headway")):
        assert headway("near", line["t"]) == pytest.approx(25.0, abs=2 * REACHED)
    far = run.span("far change_time_headway")
    # 3 s at its own speed, within 0.1 m
    own = run.at("far", far.end)["v"]
    assert headway("far", far.end) == pytest.approx(3.0 * own, abs=REACHED)
    for line in run.during("far", run.span("far keep_time_headway")):
        assert headway("far", line["t"]) / line["v"] == pytest.approx(3.0, abs=0.02)


def test_c13_a_careful_driver_keeps_its_time_gap(perform: Perform) -> None:
    run = perform("C13_careful_following")
    assert run.status == "success"
    assert run.of_kind("collision") == []
    # At rest against the leader the gap of the model is 2 m + 1.5 s * v; it gets there slowly.
    for t, v, tolerance in ((30.0, 12.0, 0.05), (60.0, 6.0, 0.02)):
        gap = run.rear("slower", t) - run.front("ego", t)
        assert gap == pytest.approx(2.0 + 1.5 * v, abs=tolerance)
        assert run.at("ego", t)["v"] == pytest.approx(v, abs=0.01)
    assert min(e["a"] for e in run.states("ego")) > -8.0
