"""C30 to C32: one after the other, side by side, when something happens."""

import math

import pytest

from tests.capabilities.kit import DT, ROUNDED, Perform, cosine, next_step


def test_c30_steps_follow_without_a_gap(perform: Perform) -> None:
    run = perform("C30_serial")
    assert run.status == "success"
    swerve, back = run.spans("ego change_lane")
    steps = [run.span("ego drive"), swerve, run.span("ego change_speed"), back]
    assert [(step.start, step.end) for step in steps] == [
        (0.0, 2.0),
        (2.0, 6.0),
        (6.0, 9.0),  # 12 to 18 m/s at 2 m/s^2
        (9.5, 13.5),  # after the pause
    ]
    assert run.result["steps"] == round(13.5 / DT)
    # From the middle of lane 1 (12.25 m right of the road's) to that of lane 2, 3.5 m further left.
    for line in run.states("ego"):
        t = line["t"]
        y = cosine(-12.25, -8.75, 4.0, t - 2.0) + cosine(0.0, -3.5, 4.0, t - 9.5)
        assert line["y"] == pytest.approx(y, abs=ROUNDED)


def test_c31_members_of_a_parallel_share_time(perform: Perform) -> None:
    run = perform("C31_parallel")
    assert run.status == "success"
    left, right = run.spans("ego change_lane")
    faster = run.span("ego change_speed")
    assert (faster.start, faster.end) == (0.0, 4.0)
    assert (left.start, left.end) == (0.0, 5.0)
    for line in run.during("ego", left):
        # Both changes take their course as if they were alone.
        assert line["v"] == pytest.approx(cosine(10.0, 16.0, 4.0, line["t"]), abs=ROUNDED)
        assert line["y"] == pytest.approx(cosine(-8.75, -5.25, 5.0, line["t"]), abs=ROUNDED)
    assert run.span("other drive").end == 3.0
    # overlap: end - the short one starts late, so that both end together.
    short = run.span("other change_speed")
    assert (right.start, right.end) == (5.0, 10.0)
    assert (short.start, short.end) == (8.0, 10.0)
    assert run.last("other")["v"] == 16.0


def test_c32_what_happens_starts_what_is_next(perform: Perform) -> None:
    run = perform("C32_conditional_triggers")
    assert run.status == "success"
    # 100 m between the rear axles, 4.6 m of them car: the gap of 95.4 m shrinks by 10 m/s to 20 m.
    near = run.event("near")
    assert near == next_step((95.4 - 20.0) / 10.0)
    swerve = run.span("ego change_lane")
    assert (swerve.start, swerve.length) == (near, 3.0)
    assert run.span("ego drive").end == near
    # What is emitted is heard in the same instant, and so is the reaction to it.
    assert run.event("ready") == run.event("noticed") == swerve.end
    for actor in ("ego", "other"):
        span = run.span(f"{actor} change_speed")
        assert (span.start, span.length) == (swerve.end, 2.0)
    assert run.last("other")["v"] == 15.0 and run.last("ego")["v"] == 16.0
    assert math.isclose(run.result["steps"] * DT, swerve.end + 2.0)


def test_c31_overlaps_place_the_second_member(perform: Perform) -> None:
    run = perform("C31_overlaps")
    assert run.status == "success"
    ego = [(span.start, span.end) for span in run.spans("ego change_lane")]
    first = run.span("other change_lane")
    drives = [(span.start, span.end) for span in run.spans("other drive")][1:]
    others = [(first.start, first.end), *drives]
    pairs = list(zip(ego, others, strict=True))
    assert all(end - start == 4.0 for start, end in ego)
    (equal, e2), (inside, i2), (initial, n2), (final, f2), (full, u2), (any_way, a2) = pairs[:6]
    assert e2 == equal
    assert inside[0] <= i2[0] and i2[1] <= inside[1] and i2[1] - i2[0] == 2.0
    # initial: it is there when the first one starts, and does not start later
    assert n2[0] <= initial[0] <= n2[1]
    # final: it is there when the first one ends, and does not end earlier
    assert f2[0] <= final[1] <= f2[1] and f2[1] - f2[0] == 6.0
    assert u2[0] <= full[0] and full[1] <= u2[1] and u2[1] - u2[0] == 6.0
    # any: at some instant both are there
    assert max(any_way[0], a2[0]) < min(any_way[1], a2[1])
    (offset, o2), (ending, d2) = pairs[6:]
    assert o2 == (offset[0] + 1.0, offset[0] + 6.0)
    assert d2 == (ending[1] + 2.0 - 3.0, ending[1] + 2.0)


def test_c32_measures_trigger_and_are_noted(perform: Perform) -> None:
    run = perform("C32_measures")
    assert run.status == "success"
    values = {line["name"]: (line["t"], line["value"]) for line in run.of_kind("variable")}
    # 100 m between the axles, 4.6 m of them car, at 20 m/s behind 10 m/s
    for name, limit, course in (
        ("gap", 2.5, lambda t: (95.4 - 10.0 * t) / 20.0),
        ("ttc", 4.0, lambda t: (95.4 - 10.0 * t) / 10.0),
        ("headway", 1.52, lambda t: (100.0 - 10.0 * t) / 20.0),
        ("space", 20.2, lambda t: 100.0 - 10.0 * t),
    ):
        t, value = values[name]
        assert value == pytest.approx(course(t), abs=1e-6)
        assert course(t) < limit < course(t - DT)


def test_c32_motion_triggers_and_is_noted(perform: Perform) -> None:
    """Against differences of the states in the trace."""
    run = perform("C32_motion_readings")
    assert run.status == "success"
    noted = {line["name"]: (line["t"], line["value"]) for line in run.of_kind("variable")}

    def rate(t: float, of: str) -> float:
        return float(run.at("ego", t)[of] - run.at("ego", t - DT)[of]) / DT

    bend, yaw_rate = noted["yaw_rate"]
    assert rate(bend - DT, "h") <= 0.1 < rate(bend, "h")
    # The road leans by a few degrees, which is a permille of the rate.
    assert yaw_rate == pytest.approx(rate(bend, "h"), rel=5e-3)
    assert noted["aside"] == (bend, pytest.approx(15.0 * rate(bend, "h"), rel=5e-3))
    assert noted["drift"] == (bend, pytest.approx(0.0, abs=1e-3))
    out, slope = noted["slope"]
    up = 0.5 * (rate(out, "z") + rate(out + DT, "z"))
    assert slope == pytest.approx(math.hypot(15.0, up), abs=1e-3)
    assert noted["pitch"] == (out, pytest.approx(-math.atan2(up, 15.0), abs=1e-3))
    braking, ahead = noted["ahead"]
    assert braking == pytest.approx(out + DT)
    assert ahead == pytest.approx(-3.0, abs=0.01)


def test_actors_enter(perform: Perform) -> None:
    """Who acts first in the second phase is there by then, and has not jumped."""
    run = perform("C30_entering")
    assert run.status == "success"
    lead, merging, walker = (run.states(actor) for actor in ("lead", "merging", "walker"))
    for line in run.states("merging"):
        t = line["t"]
        assert line["x"] == pytest.approx(130.0 + 18.0 * (t - 4.0))
        assert line["v"] == pytest.approx(18.0)
    begin = round(4.0 / DT)
    assert merging[begin]["x"] - lead[begin]["x"] == pytest.approx(20.0)
    assert [walker[begin][k] for k in ("x", "y", "v")] == pytest.approx([300.0, -20.0, 1.4])
    assert walker[0]["v"] == 0.0
