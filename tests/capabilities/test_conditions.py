"""C36 to C38: one_of, rise, fall."""

import pytest

from tests.capabilities.kit import DT, Perform, next_step


def test_c36_the_first_to_succeed_ends_the_race(perform: Perform) -> None:
    run = perform("C36_one_of")
    assert run.status == "success"
    reached = run.span("ego change_speed")
    assert (reached.start, reached.end) == (0.0, 2.5)  # 5 m/s at 2 m/s^2, before the wait of 4 s
    loser = run.span("ego change_lane")
    assert (loser.start, loser.end, loser.line["reason"]) == (0.0, 2.5, "stopped")
    (choice,) = run.of_kind("choice")
    assert (choice["name"], choice["policy"], choice["t"]) == ("race", "race", 2.5)
    assert "change_speed" in choice["chosen"] or choice["chosen"] == "reached"
    assert run.span("ego drive").start == 2.5
    assert run.result["steps"] == round(3.5 / DT)


def test_c37_only_a_rising_edge_counts(perform: Perform) -> None:
    run = perform("C37_rise")
    assert run.status == "success"
    speeds = {line["t"]: line["v"] for line in run.states("ego")}
    edges = [t for t, v in speeds.items() if t > 0.0 and v > 12.05 >= speeds[round(t - DT, 6)]]
    # Up from 10 m/s at 2 m/s^2 from 0 s and from 4 s on: 12.05 m/s after 1.025 s.
    assert edges == [next_step(1.025), next_step(5.025)]
    assert [run.event("fast"), run.event("fast_again")] == edges


def test_c38_only_a_falling_edge_counts(perform: Perform) -> None:
    run = perform("C38_fall")
    assert run.status == "success"
    # 45.4 m between the ends, 5 m/s faster: 10 m after 7.08 s.
    assert run.event("caught_up") == next_step((50.0 - 4.6 - 10.0) / 5.0)
    assert run.span("ego change_lane").start == run.event("caught_up")
    assert run.last("ego")["lane"] == -3
    assert run.of_kind("collision") == []
    gap = run.rear("slow", run.event("caught_up")) - run.front("ego", run.event("caught_up"))
    assert gap == pytest.approx(10.0 - 5.0 * (run.event("caught_up") - 7.08), abs=1e-4)
