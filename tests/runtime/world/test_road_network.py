"""Methods of the map, route coordinates, and places by points, on straight and curved roads."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Vehicle, Wait, elapsed
from osc2tx_runtime.domain.actors import OdrPoint, Point, Pose
from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.paths.path_values import Path, RelativePath
from osc2tx_runtime.domain.points_and_poses import RoadRoute, RoutePoint
from osc2tx_runtime.domain.routes.lane_coordinates import (
    place_along_road,
    place_of_route,
    position_along_road,
    route_point_at,
)
from osc2tx_runtime.domain.routes.network_paths import path_in_world, trajectory_in_world
from osc2tx_runtime.domain.routes.road_paths import way_between
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import lane, lateral, position, speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
MAPS = ["highway", "crossing", "curve", "left_hand", "merge", "urban_crossing"]


@pytest.fixture
def asked(run: Run) -> Callable[[Callable[[TwoCars], Any]], Any]:
    """The answer to a question that is asked while a scenario runs."""

    def ask(question: Callable[[TwoCars], Any]) -> Any:
        answers: list[Any] = []

        def body(s: TwoCars) -> Behaviour:
            return Wait(lambda: answers.append(question(s)) is None)

        run(scenario(body))
        return answers[0]

    return ask


def test_points(asked: Callable[..., Any]) -> None:
    def question(s: TwoCars) -> Any:
        on_lane = s.road.xyz_to_route_point(150.0, -8.0, 0.0)
        on_road = s.road.odr_to_route_point("1", None, 150.0, -8.0)
        return (
            on_lane,
            s.road.route_point_to_xyz(on_lane).position,
            s.road.route_point_to_xyz(on_road).position,
            s.road.odr_to_route_point("1", "-3", 150.0, 0.75),
            s.road.create_route_point(RoadRoute("1", -3), 5.0, 0.0),
            s.road.create_xyz_point(1.0, 2.0, 3.0).position,
            s.road.create_odr_point("1", "-3", 4.0, 0.0),
        )

    on_lane, first, second, odr, made, xyz, point = asked(question)
    assert on_lane == odr == RoutePoint(RoadRoute("1", -3), 150.0, pytest.approx(0.75))
    assert first == second == Point(150.0, -8.0, 0.0)
    assert made.route == RoadRoute("1", -3)
    assert (xyz, point) == (Point(1.0, 2.0, 3.0), OdrPoint("1", "-3", 4.0, 0.0))


def test_sides_and_file(asked: Callable[..., Any]) -> None:
    answer = asked(lambda s: (s.road.outer_side(), s.road.inner_side(), s.road.get_map_file()))
    assert answer == ("right", "left", "highway")


def test_off_the_road_is_an_error(run: Run) -> None:
    with pytest.raises(ScenarioError, match="there is no driving lane at"):
        run(scenario(lambda s: Wait(lambda: bool(s.road.xyz_to_route_point(0.0, 90.0, 0.0)))))


def test_create_paths(asked: Callable[..., Any]) -> None:
    def question(s: TwoCars) -> Any:
        points = [OdrPoint("1", -3, 100.0), OdrPoint("1", -2, 200.0)]
        route_points = [RoutePoint(RoadRoute("1", -3), 100.0), RoutePoint(RoadRoute("1"), 200.0)]
        here = s.road.context.world.map
        return (
            s.road.create_path([Pose(0.0, 0.0), Pose(1.0, 0.0)], "smooth"),
            path_in_world(here, s.road.create_path_odr_points(points, "straight_line", False)),
            path_in_world(here, s.road.create_path_odr_points(points, "straight_line", True)),
            path_in_world(here, s.road.create_path_route_points(route_points)),
            trajectory_in_world(
                here,
                s.road.create_trajectory_odr_points(points, [0.0, 10.0], "straight_line", True),
            ),
            trajectory_in_world(
                here, s.road.create_trajectory_route_points(route_points, [0.0, 4.0])
            ),
            s.road.resolve_relative_path(
                RelativePath((Pose(1.0, 2.0),)), s.b, "object_relative"
            ).points,
        )

    plain, odr, on_lanes, route, timed, by_route, resolved = asked(question)
    assert plain.interpolation == "smooth"
    ends = [(p.x, p.y) for p in odr.points]
    assert ends == [(100.0, -8.75), (200.0, -5.25)]
    assert (on_lanes.points[0].y, on_lanes.points[-1].y) == (-8.75, -5.25)
    assert all(-8.75 <= p.y <= -5.25 for p in on_lanes.points)
    assert [(p.x, p.y) for p in route.points] == [(100.0, -8.75), (200.0, 0.0)]
    assert (timed.time_stamps[0], timed.time_stamps[-1]) == (0.0, 10.0)
    assert len(timed.points) == len(timed.time_stamps) == 51
    assert by_route.time_stamps == (0.0, 4.0)
    assert (resolved[0].x, resolved[0].y) == (91.0, -6.75)


@pytest.mark.parametrize("name", MAPS)
def test_route_points_there_and_back(load_map: Callable[[str], RoadMap], name: str) -> None:
    road_map = load_map(name)
    for place in road_map.spawn_points()[::7]:
        point = route_point_at(road_map, place)
        back = place_of_route(road_map, point)
        assert isinstance(back, LanePosition)
        assert (back.road, back.lane) == (place.road, place.lane)
        assert back.s == pytest.approx(place.s, abs=1e-5)
        ahead = road_map.advance(place, 1.0).position
        if ahead.road == place.road:
            gain = route_point_at(road_map, ahead).s - point.s
            assert gain == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("name", MAPS)
def test_positions_along_roads_there_and_back(
    load_map: Callable[[str], RoadMap], name: str
) -> None:
    road_map = load_map(name)
    for place in road_map.spawn_points()[::7]:
        position = position_along_road(road_map, place)
        assert 0.0 <= position <= road_map.roads[place.road].length
        for start in (place, road_map.advance(place, 9.0).position):
            if start.road == place.road:
                found = place_along_road(road_map, start, position)
                assert found is not None
                assert (found.road, found.lane) == (place.road, place.lane)
                assert found.s == pytest.approx(place.s, abs=1e-9)


@pytest.mark.parametrize("name", MAPS)
def test_ways_along_lanes_stay_on_them(load_map: Callable[[str], RoadMap], name: str) -> None:
    road_map = load_map(name)
    for start in road_map.spawn_points()[::11]:
        goal = road_map.advance(start, 45.0)
        if goal.travelled < 45.0:
            continue
        length = road_map.route_distance(start, goal.position)
        if length is None or abs(length - 45.0) > 1e-3:
            continue  # another way is shorter
        curve = Path(way_between(road_map, start, goal.position), "smooth").curve
        assert curve.length == pytest.approx(45.0, abs=0.05)
        for i in range(10):
            there = road_map.pose(road_map.advance(start, 4.5 * i).position)
            x, y, _ = curve.point(curve.at_length(4.5 * i))
            assert math.hypot(x - there.x, y - there.y) < 0.05


def test_no_room_for_a_lane_change(highway: RoadMap) -> None:
    with pytest.raises(PathError, match=r"only 10\.0 m to change from lane -3 to lane -2"):
        way_between(highway, LanePosition("1", -3, 100.0), LanePosition("1", -2, 110.0))


def test_distances_to_points(asked: Callable[..., Any]) -> None:
    def question(s: TwoCars) -> Any:
        here = s.a.get_route_point("on_lane")
        return (
            here,
            s.a.get_s_coord("on_lane"),
            s.a.get_route_point().t,
            s.a.distance_to_xyz_point(s.road.create_xyz_point(80.0, -8.75, 0.0), "euclidean"),
            s.a.distance_to_route_point(RoutePoint(RoadRoute("1", -3), 70.0), "longitudinal"),
            s.a.distance_to_odr_point(OdrPoint("1", -2, 40.0), "longitudinal"),
            s.a.distance_to_odr_point(OdrPoint("1", -2, 40.0), "lateral"),
            s.a.distance_to_odr_point(OdrPoint("1", -3, 80.0), "longitudinal", "bounding_boxes"),
        )

    here, s, t, straight, ahead, behind, aside, front = asked(question)
    assert here == RoutePoint(RoadRoute("1", -3), 50.0, 0.0)
    assert (s, t) == (50.0, -8.75)
    assert (straight, ahead, behind) == pytest.approx((30.0, 20.0, -10.0))
    assert aside == pytest.approx(3.5)
    assert front == pytest.approx(30.0 - (4.6 - 0.92))


@pytest.mark.parametrize(
    ("modifiers", "place"),
    [
        ((position(distance=20.0, ahead_of_point=Point(100.0, -8.0)),), ("1", -3, 120.0, 0.0)),
        ((position(distance=20.0, behind_point=Point(100.0, -8.0)),), ("1", -3, 80.0, 0.0)),
        (
            (position(distance=5.0, behind_point=Point(100.0, -8.0)), lane(1)),
            ("1", -4, 95.0, 0.0),
        ),
        ((position(distance=100.0), lane(2), lateral(0.5, side="right")), ("1", -3, 100.0, -0.5)),
        (
            (position(distance=100.0), lane(2), lateral(0.2, measure_by="right_to_right")),
            ("1", -3, 100.0, 0.2 - 1.75 + 0.95),
        ),
    ],
)
def test_starts(run: Run, modifiers: tuple[Any, ...], place: tuple[Any, ...]) -> None:
    class Start(TwoCars):
        def placement(self) -> None:
            self.place(self.a, *modifiers)
            self.place(self.b, lane(4), position(distance=300.0), speed(1.0))

        def behavior(self) -> Behaviour:
            return Wait(elapsed(0.05))

    e = run(Start).states("a")[0]
    assert (e["road"], e["lane"], e["s"], pytest.approx(e["offset"])) == place


def test_a_start_beside_another(run: Run) -> None:
    class Start(TwoCars):
        def placement(self) -> None:
            super().placement()
            self.place(
                self.c,
                position(distance=0.0, ahead_of=self.b),
                lateral(0.6, side_of=self.b, measure_by="closest"),
            )

        def declare(self) -> None:
            super().declare()
            self.c = Vehicle(width=1.7, model="vehicle.unknown.brand", vehicle_category="van")

        def behavior(self) -> Behaviour:
            return Wait(elapsed(0.05))

    done = run(Start)
    b, c = done.states("b")[0], done.states("c")[0]
    assert c["y"] - b["y"] == pytest.approx(0.6 + 0.5 * (1.7 + 1.9))
    sizes = [e for e in done.lines if e["kind"] == "size"]
    assert sizes == [
        {
            "t": 0.0,
            "kind": "size",
            "actor": "c",
            "model": "vehicle.unknown.brand",
            "source": "category",
        }
    ]
