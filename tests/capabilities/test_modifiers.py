"""C19 to C26: what modifiers make of a movement."""

import math

import pytest

from tests.capabilities.kit import DT, ROUNDED, Perform, Trapezoid, cosine, cosine_duration


def test_c19_speeds_of_its_own_and_of_others(perform: Perform) -> None:
    run = perform("C19_speed_modifier")
    assert run.status == "success"
    pace = 54.0 / 3.6
    for actor, v in (
        ("pace", pace),
        ("faster", pace + 3.0),
        ("slower", pace - 3.0),
        ("scaled", 1.2 * pace),
    ):
        assert run.at(actor, 0.0)["v"] == 10.0
        # Speeds by a reference are followed, and count as reached within 0.05 m/s.
        assert run.last(actor)["v"] == pytest.approx(v, abs=0.05)
    # Half of what a car can: 2 m/s^2, with 10 m/s^3.
    reached = next(line["t"] for line in run.states("pace") if line["v"] == pace)
    gain = Trapezoid(pace - 10.0, acceleration=2.0, jerk=10.0).duration
    assert reached - DT < gain <= reached + 1e-9


def test_c20_accelerations_until_a_stand(perform: Perform) -> None:
    run = perform("C20_acceleration_modifier")
    assert run.status == "success"
    for line in run.states("ego"):
        t = line["t"]
        v = 8.0 + 1.25 * min(max(t - 1.0, 0.0), 4.0)
        assert line["v"] == pytest.approx(max(v - 2.0 * max(t - 5.0, 0.0), 0.0), abs=ROUNDED)
    # 8 m, a ramp from 8 to 13 m/s, and 13^2 / (2 * 2) to stand
    way = 8.0 + 0.5 * (8.0 + 13.0) * 4.0 + 13.0**2 / 4.0
    assert run.last("ego")["s"] - 50.0 == pytest.approx(way, abs=2e-3)


def test_c21_places_at_the_start_and_at_the_end(perform: Perform) -> None:
    run = perform("C21_position_modifier")
    assert run.status == "success"
    place = {actor: run.at(actor, 0.0) for actor in ("ego", "front", "late", "rear")}
    assert {actor: line["s"] for actor, line in place.items()} == {
        "ego": 200.0,
        "front": 230.0,
        "late": 200.0 - 2.0 * 15.0,
        "rear": 180.0,
    }
    assert {actor: line["lane"] for actor, line in place.items()} == {
        "ego": -3,
        "front": -3,
        "late": -2,
        "rear": -4,
    }
    assert run.last("rear")["t"] == 6.0
    # A goal in place counts as reached within 0.1 m.
    assert run.last("rear")["s"] - run.last("ego")["s"] == pytest.approx(10.0, abs=0.1)


def test_c22_lanes_and_places_in_them(perform: Perform) -> None:
    run = perform("C22_lateral_modifier")
    assert run.status == "success"
    last = {actor: run.last(actor) for actor in ("ego", "shifted", "changing", "joining")}
    assert {actor: line["lane"] for actor, line in last.items()} == {
        "ego": -3,
        "shifted": -4,
        "changing": -3,
        "joining": -3,
    }
    assert run.at("changing", 0.0)["lane"] == -1 and run.at("joining", 0.0)["lane"] == -2
    # Middles of the lanes, 3.5 m wide each; left of them is more.
    assert last["ego"]["y"] == pytest.approx(-8.75, abs=ROUNDED)
    assert last["shifted"]["y"] == pytest.approx(-12.25 + 0.6, abs=ROUNDED)
    assert last["changing"]["y"] == pytest.approx(-8.75, abs=ROUNDED)
    assert last["joining"]["y"] == pytest.approx(-8.75, abs=ROUNDED)


def test_c23_physics_takes_its_time(perform: Perform) -> None:
    run = perform("C23_physical_movement")
    assert run.status == "success"
    assert [line["v"] for line in run.states("free")[:2]] == [10.0, 20.0]
    gain = Trapezoid(10.0, acceleration=2.0, jerk=10.0).duration
    reached = next(line["t"] for line in run.states("bound") if line["v"] == 20.0)
    assert reached - DT < gain <= reached + 1e-9
    assert max(line["a"] for line in run.states("bound")) == pytest.approx(2.0, abs=1e-3)


def test_c24_delays_limits_and_ends_in_time(perform: Perform) -> None:
    run = perform("C24_temporal_modifiers")
    assert run.status == "success"
    first, limited, planned = run.spans("ego drive")
    assert first.end == 1.0
    assert (limited.start, limited.length) == (1.0 + 1.5, 2.0)
    assert (planned.start, planned.length) == (limited.end, 4.0)
    # Nothing before the end of the delay
    assert {line["v"] for line in run.states("ego") if line["t"] <= limited.start} == {10.0}
    assert run.at("ego", planned.start)["v"] == 12.0
    speeds = [line["v"] for line in run.during("ego", planned)]
    assert speeds == sorted(speeds)
    assert speeds[-2] < 18.0 and speeds[-1] == 18.0


def test_c25_all_by_the_other_car(perform: Perform) -> None:
    run = perform("C25_relative_modifiers")
    assert run.status == "success"
    lead, wing = run.at("lead", 0.0), run.at("wing", 0.0)
    assert (wing["lane"], lead["lane"]) == (-2, -3)
    assert lead["s"] - wing["s"] == 25.0
    # The lead's smooth change from 15 to 21 m/s in 6 s peaks with 15/8 of 1 m/s^2; what is seen at
    # one step is driven by the next.
    lag = 15.0 / 8.0 * 1.0 * DT
    for one, other in zip(run.states("lead"), run.states("wing"), strict=True):
        assert 0.0 <= one["v"] - other["v"] <= lag + ROUNDED
    assert run.last("wing")["v"] == pytest.approx(21.0, abs=ROUNDED)


def test_c26_headings_against_road_world_and_others(perform: Perform) -> None:
    run = perform("C26_orientation_modifiers")
    assert run.status == "success"
    for actor, degrees, y in (
        ("along", 30.0, -30.0),
        ("guide", -45.0, -40.0),
        ("opposite", 135.0, -50.0),
    ):
        h = math.radians(degrees)
        last = run.last(actor)
        assert last["h"] == pytest.approx(h, abs=ROUNDED)
        # 1 m/s for 5 s
        assert last["x"] == pytest.approx(100.0 + 5.0 * math.cos(h), abs=1e-5)
        assert last["y"] == pytest.approx(y + 5.0 * math.sin(h), abs=1e-5)


def test_c19_shapes_give_the_course_of_the_speed(perform: Perform) -> None:
    run = perform("C19_speed_shape")
    assert run.status == "success"
    smooth = cosine_duration(6.0, 2.0)
    for line in run.states("even"):
        v = min(10.0 + 1.6 * line["t"], 18.0)
        assert line["v"] == pytest.approx(v, abs=ROUNDED)
    for line in run.states("gentle"):
        assert line["v"] == pytest.approx(cosine(10.0, 16.0, smooth, line["t"]), abs=ROUNDED)


def test_c20_shapes_give_the_course_of_the_acceleration(perform: Perform) -> None:
    run = perform("C20_acceleration_shape")
    assert run.status == "success"
    for line in run.states("ego"):
        t = max(line["t"] - 1.0, 0.0)
        # 1.5 m/s^2 with 0.5 m/s^3 takes 3 s, and it stays
        v = 10.0 + 0.25 * min(t, 3.0) ** 2 + 1.5 * max(t - 3.0, 0.0)
        assert line["v"] == pytest.approx(v, abs=ROUNDED)


def test_c21_ways_end_and_places_stay(perform: Perform) -> None:
    run = perform("C21_distance")
    assert run.status == "success"
    first, second = run.spans("ego drive")
    # 15 m/s by steps of 0.75 m: both ways are whole numbers of them.
    assert (first.length, second.start, second.length) == (4.0, 4.0, 2.4)
    assert run.last("ego")["s"] == pytest.approx(50.0 + 96.0, abs=ROUNDED)
    assert {(line["x"], line["y"]) for line in run.states("walker")} == {(80.0, -30.0)}


def test_c22_offsets_in_a_lane_and_rates_across(perform: Perform) -> None:
    run = perform("C22_lane_offset")
    assert run.status == "success"
    aside, across = run.span("ego follow_lane"), run.span("ego change_lane")
    at_end = run.at("ego", aside.end)
    assert (at_end["lane"], at_end["offset"]) == (-3, 0.4)
    # From 0.4 m left of one middle to the next one: 3.9 m at 1 m/s
    assert across.length == pytest.approx(3.9, abs=DT)
    for line in run.during("ego", across)[:-1]:
        y = -8.75 + 0.4 - 1.0 * (line["t"] - across.start)
        assert line["y"] == pytest.approx(y, abs=ROUNDED)
    assert (run.last("ego")["lane"], run.last("ego")["offset"]) == (-4, 0.0)


def test_c19_so_much_faster_than_before(perform: Perform) -> None:
    run = perform("C19_change_speed")
    assert run.status == "success"
    _, gain, hold = run.spans("ego drive")
    course = Trapezoid(4.0, acceleration=2.0, jerk=10.0)
    speeds = [line["v"] for line in run.during("ego", gain)]
    assert (speeds[0], speeds[-1]) == (12.0, 16.0)
    assert len([v for v in speeds if v < 16.0]) == math.ceil(course.duration / DT)
    assert {line["v"] for line in run.during("ego", hold)} == {16.0}


def test_c21_along_a_path_until_before_its_end(perform: Perform) -> None:
    run = perform("C21_along")
    assert run.status == "success"
    _, ride, _ = run.spans("ego drive")
    # From x = 70 m to 10 m before x = 190 m at 20 m/s
    assert (ride.start, ride.length) == (1.0, (180.0 - 70.0) / 20.0)
    assert run.at("ego", ride.end)["x"] == pytest.approx(180.0, abs=ROUNDED)


def test_c22_overtaking_in_the_lane_of_oncoming_traffic(perform: Perform) -> None:
    run = perform("C22_overtaking")
    assert run.status == "success"
    out, back = run.spans("ego change_lane")
    assert run.at("ego", out.end)["x"] < run.at("slow", out.end)["x"]
    for at, y in ((out.start, -1.75), (out.end, 1.75), (back.start, 1.75), (back.end, -1.75)):
        state = run.at("ego", at)
        assert state["y"] == pytest.approx(y, abs=ROUNDED)
        assert state["h"] == pytest.approx(0.0, abs=1e-3)
    gap = run.at("ego", back.start)["x"] - run.at("slow", back.start)["x"]
    assert 12.0 + 4.6 < gap < 12.0 + 4.6 + 7.0 * DT + ROUNDED  # faster by 7 m/s; cars of 4.6 m


def test_c22_outside_is_left_where_one_drives_on_the_left(perform: Perform) -> None:
    run = perform("C22_map_sides")
    assert run.status == "success"
    outwards, inwards = run.spans("ego change_lane")

    def left(start: float, end: float) -> float:
        """Metres to the left of the direction at the start, on a straight road."""
        one, other = run.at("ego", start), run.at("ego", end)
        h, dx, dy = one["h"], other["x"] - one["x"], other["y"] - one["y"]
        return float(dy * math.cos(h) - dx * math.sin(h))

    assert left(outwards.start, outwards.end) == pytest.approx(3.5, abs=ROUNDED)
    assert left(inwards.start, inwards.end) == pytest.approx(-3.5, abs=ROUNDED)
