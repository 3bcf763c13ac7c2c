"""C09 to C12: being put somewhere, turned, led along paths and trajectories."""

import math

import pytest

from tests.capabilities.kit import DT, ROUNDED, Perform


def test_c09_a_car_is_put_where_it_is_told(perform: Perform) -> None:
    run = perform("C09_assign_position")
    assert run.status == "success"
    to_point, to_road, to_route, beside = run.spans("ego assign_position")
    assert [span.length for span in (to_point, to_road, to_route, beside)] == [0.0] * 4
    there = run.at("ego", to_point.end)
    assert (there["x"], there["y"], there["lane"], there["v"]) == (400.0, -5.25, -2, 10.0)
    there = run.at("ego", to_road.end)
    # lane -3 of three lanes of 3.5 m: 8.75 m right of the middle
    assert (there["x"], there["y"], there["lane"], there["v"]) == (700.0, -8.75, -3, 10.0)
    there = run.at("ego", to_route.end)
    assert (there["x"], there["y"], there["lane"], there["v"]) == (800.0, -12.25, -4, 10.0)
    there, other = run.at("ego", beside.end), run.at("other", beside.start)
    assert there["lane"] == other["lane"] + 1  # to the left of a lane with a negative number
    assert there["s"] == pytest.approx(other["s"] + 20.0, abs=ROUNDED)


def test_c10_a_person_turns_at_once_and_walks_on(perform: Perform) -> None:
    run = perform("C10_assign_orientation")
    assert run.status == "success"
    east, onward = run.spans("walker walk")
    turn = run.span("walker assign_orientation")
    assert (turn.start, turn.length) == (east.end, 0.0)
    assert {line["h"] for line in run.during("walker", east)[:-1]} == {0.0}
    begin, end = run.at("walker", turn.end), run.last("walker")
    assert begin["h"] == pytest.approx(math.radians(60.0), abs=ROUNDED)
    way = 1.0 * onward.length
    assert end["x"] - begin["x"] == pytest.approx(way * math.cos(math.radians(60)), abs=ROUNDED)
    assert end["y"] - begin["y"] == pytest.approx(way * math.sin(math.radians(60)), abs=ROUNDED)


def test_c11_paths_lead_through_their_points(perform: Perform) -> None:
    run = perform("C11_follow_path")
    assert run.status == "success"
    curve, line = run.span("ego follow_path"), run.span("ego replay_path")
    assert curve.start == 1.0 and line.start == curve.end
    states = run.during("ego", curve)
    nearest = min(states, key=lambda e: math.hypot(e["x"] - 100.0, e["y"] + 4.0))
    # A car steers after the path: it passes within half a metre, and a step (0.5 m) apart.
    assert math.hypot(nearest["x"] - 100.0, nearest["y"] + 4.0) < 0.6
    # At its own speed all the time, whatever the path.
    assert {e["v"] for e in run.states("ego")} == {10.0}
    # Replayed exactly: on the straight line between its points, to six decimals.
    for e in run.during("ego", line)[1:-1]:
        share = (e["x"] - 140.0) / 100.0
        assert e["y"] == pytest.approx(-8.75 - 3.5 * share, abs=1e-5)
    assert line.length == pytest.approx(math.hypot(100.0, 3.5) / 10.0, abs=DT)


def test_c12_trajectories_say_when(perform: Perform) -> None:
    run = perform("C12_follow_trajectory")
    assert run.status == "success"
    timed, exact = run.span("ego follow_trajectory"), run.span("ego replay_trajectory")
    # Followed: by acceleration, so it is late by a little where the speed is to jump.
    for t, x in ((0.0, 60.0), (3.0, 90.0), (7.0, 130.0)):
        assert run.at("ego", timed.start + t)["x"] == pytest.approx(x, abs=0.2)
    assert timed.length == pytest.approx(7.0, abs=DT + ROUNDED)
    # Replayed: 20 m in 4 s, to six decimals
    assert exact.length == 4.0
    for e in run.during("ego", exact)[1:]:
        assert e["x"] == pytest.approx(130.0 + 5.0 * (e["t"] - exact.start), abs=ROUNDED)
        assert e["y"] == pytest.approx(-8.75, abs=ROUNDED)


def test_c11_a_target_is_reached_on_an_own_way(perform: Perform) -> None:
    run = perform("C11_change_position")
    assert run.status == "success"
    drive, walk = run.span("car change_position"), run.span("walker change_position")
    there = run.at("car", drive.end)
    # Through the goal within the step (0.75 m) in which it ends, in the middle of lane -3
    assert 200.0 <= there["x"] <= 200.0 + 15.0 * DT + ROUNDED
    assert there["y"] == pytest.approx(-8.75, abs=0.05)
    # The walker turns towards the goal: 5 m east and 8 m south of where it is after a second.
    begin, goal = run.at("walker", walk.start), run.at("walker", walk.end)
    assert (goal["x"], goal["y"]) == pytest.approx((106.0, -38.0), abs=0.1)
    way = math.hypot(106.0 - begin["x"], -38.0 - begin["y"])
    assert walk.length == pytest.approx(way / 1.0, abs=0.5)


def test_c12_a_trajectory_in_the_frame_of_the_car(perform: Perform) -> None:
    run = perform("C12_relative_trajectory")
    assert run.status == "success"
    span = run.span("ego replay_trajectory")
    begin = run.at("ego", span.start)
    assert span.length == 8.0
    for line in run.during("ego", span)[1:]:
        t = line["t"] - span.start
        # 10 m/s along for 4 s, then as far along and 3.5 m to the left in 4 s
        left = 3.5 * max(t - 4.0, 0.0) / 4.0
        assert line["x"] - begin["x"] == pytest.approx(10.0 * t, abs=ROUNDED)
        assert line["y"] - begin["y"] == pytest.approx(left, abs=ROUNDED)


def test_c11_a_path_along_a_road_takes_its_bend(perform: Perform) -> None:
    run = perform("C11_road_path")
    assert run.status == "success"
    bend = run.span("ego follow_path")
    end = run.at("ego", bend.end)
    # A straight line between the points would leave the road by far: the bend turns 1.1 rad.
    assert all(abs(e["offset"]) < 0.5 for e in run.during("ego", bend) if e["lane"] == -1)
    assert {e["lane"] for e in run.during("ego", bend)} == {-1}
    assert end["s"] == pytest.approx(260.0, abs=12.0 * DT)


def test_c11_one_shape_in_two_places(perform: Perform) -> None:
    run = perform("C11_relative_path")
    assert run.status == "success"
    spans = {actor: run.span(f"{actor} replay_path") for actor in ("one", "other")}
    assert spans["one"].start == spans["other"].start == 1.0
    moves = []
    for actor, span in spans.items():
        begin = run.at(actor, span.start)
        along = run.during(actor, span)
        moves.append([(e["x"] - begin["x"], e["y"] - begin["y"]) for e in along])
    for one, other in zip(*moves, strict=True):
        assert one == pytest.approx(other, abs=ROUNDED)
        # On 30 m straight ahead, then on 30 m with 3.5 m to the right
        share = min(max(one[0] - 30.0, 0.0) / 30.0, 1.0)
        assert one[1] == pytest.approx(-3.5 * share, abs=0.05)


def test_c12_a_drive_along_a_trajectory(perform: Perform) -> None:
    run = perform("C12_along_trajectory")
    assert run.status == "success"
    _, timed = run.spans("ego drive")
    assert timed.length == pytest.approx(9.0, abs=DT + ROUNDED)
    # Where the speed is to jump from 10 to 12 m/s, a car takes a second and lags by decimetres.
    for t, x, lag in ((2.0, 80.0, 0.01), (4.0, 100.0, 0.2), (9.0, 160.0, 0.2)):
        assert run.at("ego", timed.start + t)["x"] == pytest.approx(x, abs=lag)
