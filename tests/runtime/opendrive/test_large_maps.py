"""Work on large maps: a query costs what lies near it, and the search what it has to look at."""

from __future__ import annotations

import math
import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx_runtime.opendrive import DRIVING, LanePosition, RoadMap
from osc2tx_runtime.opendrive.lane_line import lane_length, lane_line
from osc2tx_runtime.opendrive.projection import lane_at, place_score, position_of, project
from tests.runtime.opendrive.small_maps import LANES, WIDTH, make_map, map_text, road_text, shape
from tests.work import calls

LENGTH = 400.0
LINKED = LANES
for _lane in (1, -1):
    LINKED = LINKED.replace(
        f'<lane id="{_lane}" type="driving">',
        f'<lane id="{_lane}" type="driving"><link><predecessor id="{_lane}"/>'
        f'<successor id="{_lane}"/></link>',
    )


def chain(roads: int) -> RoadMap:
    """Roads one after the other along x."""

    def road(i: int) -> str:
        before = f'<predecessor elementType="road" elementId="{i - 1}" contactPoint="end"/>'
        after = f'<successor elementType="road" elementId="{i + 1}" contactPoint="start"/>'
        link = (before if i else "") + (after if i + 1 < roads else "")
        geometry = shape("line", LENGTH, x=i * LENGTH)
        return road_text(geometry, LENGTH, identity=str(i), lanes=LINKED, link=link)

    return make_map(*map(road, range(roads)))


def test_the_first_query_does_not_sample_the_map() -> None:
    """A road of 400 m has 100 samples, each of many calls."""

    def first_query(roads: int) -> int:
        road_map = chain(roads)
        return calls(lambda: road_map.locate(120.0, -1.0))

    assert (first_query(200) - first_query(100)) / 100 < 100


def test_bounds_sample_the_rim_of_the_map() -> None:
    def work(edge: int) -> int:
        geometries = [
            shape("line", LENGTH, x=i * LENGTH, y=j * LENGTH)
            for i in range(edge)
            for j in range(edge)
        ]
        made = make_map(*(road_text(g, LENGTH, identity=str(i)) for i, g in enumerate(geometries)))
        assert made.locate(-5000.0, 0.0) is None  # makes the index
        number = calls(made.bounds)
        assert made.bounds() == (0.0, -3.0, edge * LENGTH, (edge - 1) * LENGTH + 3.0)
        return number

    assert work(16) < 3.0 * work(8)  # four times as many roads, twice as many at the rim


@pytest.mark.parametrize("starts", [(0.0, 1e8), (-1e9, -9e8), (-5.0, 200.0), (0.0, LENGTH)])
def test_geometry_beyond_the_road_is_not_looked_at(starts: tuple[float, float]) -> None:
    pieces = "".join(shape("line", LENGTH, s=s) for s in starts)

    def ask() -> None:
        made = make_map(road_text(pieces, LENGTH))
        made.locate(10.0, -1.0)
        made.bounds()

    assert calls(ask) < 20_000


def test_stretches_as_wide_as_the_world_are_in_no_tile() -> None:
    poly = 'paramPoly3 aU="0" bU="1e9" cU="0" dU="0" aV="0" bV="0" cV="0" dV="0"'
    assert calls(lambda: make_map(road_text(shape(poly, 400.0), LENGTH)).locate(9.0, 0.0)) < 50_000


def test_a_search_looks_no_farther_than_the_goal() -> None:
    road_map = chain(200)
    begin = LanePosition("3", -1, 10.0)
    assert road_map.route_distance(begin, LanePosition("0", -1, 10.0)) == pytest.approx(-1200.0)
    route = road_map.route_to(LanePosition("9", -1, 10.0))

    def near() -> float | None:
        return route.distance(LanePosition("7", -1, 10.0))

    assert near() == pytest.approx(800.0)
    work = calls(lambda: road_map.route_to(LanePosition("8", -1, 9.0)).distance(begin))
    assert work < 500  # 190 roads follow


@pytest.mark.slow
def test_memory_for_a_map_of_a_city(tmp_path: Path) -> None:
    """20,000 roads with four lanes each, in a process of its own: 30 MB of text."""
    sides = [(2, "sidewalk"), (1, "driving"), (-1, "driving"), (-2, "sidewalk")]
    mark = '<roadMark sOffset="0" type="solid" weight="standard" color="white" width="0.12"/>'
    made = [
        f'<lane id="{i}" type="{kind}" level="false"><link><predecessor id="{i}"/>'
        f'<successor id="{i}"/></link>{WIDTH}{mark}</lane>'
        for i, kind in sides
    ]
    lanes = (
        f'<laneSection s="0"><left>{made[0]}{made[1]}</left><center><lane id="0" type="none"/>'
        f"</center><right>{made[2]}{made[3]}</right></laneSection>"
    )
    grid = ((i, j) for i in range(100) for j in range(200))
    roads = (
        road_text(shape("line", 100.0, x=i * 100.0, y=j * 50.0), 100.0, identity=f"{i * 200 + j}")
        for i, j in grid
    )
    path = tmp_path / "city.xodr"
    path.write_text(map_text(*(each.replace(LANES, lanes) for each in roads)), encoding="utf-8")
    program = (
        "import re, sys; from pathlib import Path;"
        "from osc2tx_runtime.opendrive import read_map;"
        "road_map = read_map(Path(sys.argv[1]));"
        "assert road_map.locate(4950.0, 5001.0).road == '9900';"
        "assert len(road_map.roads) == 20_000;"
        # Its own peak: what `getrusage` says counts the process that started it.
        "status = Path('/proc/self/status').read_text();"
        "print(re.search(r'VmHWM:\\s+(\\d+) kB', status)[1])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(path)], capture_output=True, text=True, check=True
    )
    # MB: 195, and up to 7 more by how the system hands out memory.
    assert int(done.stdout) / 1024 < 205


def test_a_way_makes_no_tables_of_the_lanes_it_passes() -> None:
    """Straight lanes and arcs have their lengths without."""

    def first_search(roads: int) -> int:
        road_map = chain(roads)
        begin, goal = LanePosition("0", -1, 10.0), LanePosition(str(roads - 1), -1, 10.0)
        work = calls(lambda: road_map.route_distance(begin, goal))
        assert road_map.route_distance(begin, goal) == pytest.approx((roads - 1) * LENGTH)
        between = road_map.roads["1"].sections[0].lanes[-1]
        assert between.line is None
        return work

    assert (first_search(200) - first_search(100)) / 100 < 60


def test_what_is_not_connected_is_found_out_once() -> None:
    road_map = chain(100)
    route = road_map.route_to(LanePosition("50", 1, 10.0))
    assert route.distance(LanePosition("50", -1, 10.0)) is None
    assert calls(lambda: route.distance(LanePosition("40", -1, 10.0))) < 100


@pytest.mark.parametrize("name", ["crossing", "curve", "merge", "urban_crossing", "left_hand"])
def test_the_index_finds_what_a_search_of_all_roads_finds(
    name: str, own: Callable[[str], RoadMap]
) -> None:
    road_map = own(name)
    west, south, east, north = road_map.bounds()
    random_ = random.Random(name)
    for _ in range(60):
        x, y = random_.uniform(west, east), random_.uniform(south, north)
        found = road_map.locate(x, y, max_distance=8.0)
        expected = everywhere(road_map, x, y, 8.0)
        assert (found is None) == (expected is None), (x, y)
        if found is not None and expected is not None:
            assert found[:2] == expected[:2]
            assert found == pytest.approx(expected, abs=1e-6)


def everywhere(road_map: RoadMap, x: float, y: float, reach: float) -> LanePosition | None:
    """The best place of all roads, each searched from the nearest of points every metre."""
    places = []
    for road in road_map.roads.values():
        starts = [min(float(i), road.length) for i in range(math.ceil(road.length) + 1)]
        start = min(starts, key=lambda s: math.dist(road.reference.at(s)[:2], (x, y)))
        foot = project(road, x, y, start)
        hit = lane_at(road, foot.s, foot.t, DRIVING)
        if hit is not None and math.hypot(hit[0], foot.beyond) <= reach:
            distance = math.hypot(hit[0], foot.beyond)
            score = place_score(foot, hit[1], distance, None, None)
            places.append((score, position_of(foot, hit[1])))
    return min(places, default=((), None), key=lambda place: place[0])[1]


def test_lengths_without_a_table_are_those_of_the_table(own: Callable[[str], RoadMap]) -> None:
    compared = 0
    for name in ("crossing", "curve", "merge", "urban_crossing"):
        for road in own(name).roads.values():
            for section in road.sections:
                for lane in section.lanes.values():
                    before, lane.line = lane.line, None
                    short = lane_length(lane)
                    compared += lane.line is None
                    assert short == pytest.approx(lane_line(lane).length, abs=1e-9)
                    lane.line = before
    assert compared > 50


@pytest.mark.parametrize("away", [1e6, 1e12, math.inf, math.nan])
def test_work_does_not_grow_with_the_distance_from_the_map(away: float) -> None:
    """Within reach or not: rings without roads are passed over."""
    road_map = chain(5)
    road_map.locate(0.0, 0.0)
    for reach in (50.0, 2e6):
        assert calls(lambda reach=reach: road_map.locate(0.0, away, max_distance=reach)) < 100_000
    assert (road_map.locate(0.0, away, max_distance=2e6) is not None) == (away == 1e6)
    nearest = road_map.locate(0.0, 1e6, max_distance=math.inf)
    assert nearest == road_map.locate(0.0, 1e6, max_distance=2e6)
