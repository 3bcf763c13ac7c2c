"""What a map says of the roads, lanes and junctions that it has for a scenario (DSL 8.12)."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

import osc2tx_runtime
from osc2tx_runtime import (
    Behaviour,
    CompoundLane,
    CompoundRoute,
    Crossing,
    GeodeticPoint,
    Junction,
    Lane,
    LaneSection,
    Map,
    Pose,
    Road,
    Route,
    RunSettings,
    Scenario,
    ScenarioError,
    TrafficLight,
    TrafficLightGroup,
    TrafficLightStopLine,
    Wait,
    elapsed,
)
from osc2tx_runtime import (
    Path as Way,
)
from osc2tx_runtime.domain.points_and_poses import Point
from osc2tx_runtime.modifiers import roads_follow_in_junction, routes_are_in_sequence
from osc2tx_runtime.running.preparation import make_context, place_actors
from osc2tx_runtime.running.world_choice import make_world

MAPS = Path(osc2tx_runtime.__file__).parent / "maps"


def road_element(name: str, road: str) -> etree._Element:
    found = etree.parse(MAPS / f"{name}.xodr").find(f"road[@id='{road}']")
    assert found is not None
    return found


def on_map(file: str, *relations: Any, **parts: Any) -> Any:
    """A scenario with these parts, on its map."""

    class Parts(Scenario):
        name = "parts"
        source = "parts.osc"

        def declare(self) -> None:
            self.net = Map(map_file=file)
            for name, part in parts.items():
                setattr(self, name, part)

        def placement(self) -> None:
            for relation in relations:
                self.require(self.net, relation)

        def behavior(self) -> Behaviour:
            return Wait(elapsed(0.05))

    scenario = Parts(RunSettings())
    scenario.create_tree()
    place_actors(scenario, make_context(scenario, make_world(scenario)))
    return scenario


def test_a_road_with_several_sections() -> None:
    """The motorway behind the merge: its lanes by section, in one direction only."""
    element = road_element("merge", "2")
    starts = [float(e.get("s", "")) for e in element.iterfind("lanes/laneSection")]
    scenario = on_map("merge", road=Road(anchors=["2"]))
    road = scenario.road
    assert road.length == float(element.get("length", "")) == road.end_point().s
    lengths = [end - begin for begin, end in zip(starts, [*starts[1:], road.length], strict=True)]
    # In the second one the rightmost lane closes: its centre moves 1.75 m to the left over 100 m,
    # along 3 u^2 - 2 u^3, whose slope squared has the mean 36 / 30.
    lengths[1] += 0.5 * (1.75 / 100.0) ** 2 * 36.0 / 30.0 * 100.0
    assert [section.length for section in road.s_positive] == pytest.approx(lengths, abs=1e-4)
    assert road.s_negative == ()
    written = [
        [lane for lane in e.iterfind("right/lane") if lane.get("type") in ("driving", "entry")]
        for e in element.iterfind("lanes/laneSection")
    ]
    assert [len(section.lanes) for section in road.s_positive] == [len(each) for each in written]
    assert (road.min_lanes, road.max_lanes) == (2, 3)
    assert road.directionality == "uni_direction"
    assert road.anchors == ["2"]
    first = road.s_positive[0]
    assert [lane.lane_use for lane in first.lanes] == ["entry", "normal", "normal"]
    assert first.s_axis.lane_use == "entry"
    assert first.road.found == road.found
    assert first.lanes[0].lane_section.found == first.found


def test_lanes_of_a_curve_have_lengths_of_their_own() -> None:
    """Per radian of the bend a lane is as much longer as it lies outside of the reference line."""
    scenario = on_map("highway", inner=Lane(anchors=["1:1"]), outer=Lane(anchors=["1:-4"]))
    bend = (120.0 / 2 + 260.0 + 120.0 / 2) / 800.0  # rad, to the left
    assert scenario.inner.length == pytest.approx(2000.0 - bend * 1.75, abs=1e-3)
    assert scenario.outer.length == pytest.approx(2000.0 + bend * 3.5 * 3.5, abs=1e-3)
    assert (scenario.outer.lane_type, scenario.outer.width) == ("driving", pytest.approx(3.5))


def test_ends_of_all_sorts_of_routes() -> None:
    """Where a route begins and ends, as points of the world."""
    scenario = on_map(
        "urban_crossing",
        roads_follow_in_junction(
            in_road=(arm := Road(anchors=["east"])),
            out_road=(out := Road()),
            direction="left",
            resulting_route=(turn := CompoundRoute()),
        ),
        arm=arm,
        out=out,
        turn=turn,
        chain=CompoundLane(anchors=["1:-1"]),
    )

    def world(point: Any) -> tuple[float, float]:
        found: Point = scenario.net.route_point_to_xyz(point).position
        return found.x, found.y

    # The arm runs from x = 170 m to 20 m; the road to the south from y = -170 m to -20 m.
    assert world(arm.start_point()) == pytest.approx((170.0, 0.0), abs=1e-6)
    assert world(arm.end_point()) == pytest.approx((20.0, 0.0), abs=1e-6)
    assert world(scenario.chain.start_point()) == pytest.approx((170.0, 1.75), abs=1e-4)
    assert world(scenario.chain.end_point()) == pytest.approx((20.0, 1.75), abs=1e-4)
    assert world(turn.start_point()) == pytest.approx((170.0, 1.75), abs=1e-4)
    assert world(turn.end_point())[1] == pytest.approx(-170.0, abs=1e-3)
    assert turn.length == pytest.approx(300.0 + 0.5 * math.pi * 21.75, abs=1e-3)
    assert [type(each) for each in turn.route_elements] == [Road, Road, Road]
    assert [each.found.road for each in turn.route_elements][::2] == ["1", "4"]
    assert [lane.found.lane for lane in scenario.chain.lanes] == [-1]
    assert scenario.chain.directionality == "uni_direction"


def test_the_network_as_lists() -> None:
    """All roads, junctions and groups of lights of a map, in the order of their numbers."""
    root = etree.parse(MAPS / "urban_crossing.xodr").getroot()
    scenario = on_map("urban_crossing", middle=Junction())
    net = scenario.net
    outside = [e.get("id") for e in root.iterfind("road") if e.get("junction") == "-1"]
    assert [road.found.road for road in net.routes] == outside
    assert [road.found.road for road in net.junctions[0].roads] == outside
    assert [road.found.road for road in scenario.middle.roads] == outside
    assert len(net.junctions) == len(root.findall("junction"))
    groups = net.traffic_light_groups
    assert [group.map_id for group in groups] == [e.get("id") for e in root.iterfind("controller")]
    assert [light.map_id for light in groups[0].traffic_lights] == ["101", "103"]
    assert net.map_file == "urban_crossing"


def test_what_a_route_is_decides_its_modifier() -> None:
    """A plain `route` is a lane where a lane belongs, and a road on its own."""
    scenario = on_map(
        "urban_crossing",
        roads_follow_in_junction(in_lane=(lane := Lane()), junction_route=(inside := Route())),
        lane=lane,
        inside=inside,
        alone=Route(),
    )
    assert inside.found.kind == "lane"
    assert scenario.alone.found.kind == "road"
    one, other = Lane(), Lane()
    on_map("merge", routes_are_in_sequence(one, other), one=one, other=other)
    assert one.found != other.found


def test_a_path_is_a_route() -> None:
    """The way through three points: its length, its ends, points beside it."""
    way = Way([Pose(0.0, 0.0), Pose(3.0, 4.0), Pose(3.0, 14.0)])
    scenario = on_map("highway")
    assert way.length == pytest.approx(15.0)
    assert (way.directionality, way.min_lanes, way.max_lanes, way.anchors) == (
        "uni_direction", 0, 0, [],
    )  # fmt: skip
    net = scenario.net
    end = net.route_point_to_xyz(way.end_point()).position
    assert (end.x, end.y) == pytest.approx((3.0, 14.0))
    assert way.start_point().s == 0.0
    beside = net.route_point_to_xyz(net.create_route_point(way, 10.0, 2.0)).position
    assert (beside.x, beside.y) == pytest.approx((1.0, 9.0))
    with pytest.raises(ScenarioError, match=r"the path is 15.0 m long, so it has no s = 16 m"):
        net.route_point_to_xyz(net.create_route_point(way, 16.0, 0.0))


@pytest.mark.parametrize("part", [Road(), Lane(), LaneSection(), Junction(), Crossing()])
def test_nothing_is_known_before_the_run(part: Any) -> None:
    with pytest.raises(ScenarioError, match="before the"):
        part.roads if isinstance(part, Junction) else part.length


def test_a_place_on_the_globe_needs_a_map_that_knows_it(tmp_path: Path) -> None:
    """It is refused before the run, with the name of the point."""
    text = (MAPS / "crossing.xodr").read_text(encoding="utf-8")
    begin, end = text.index("<geoReference>"), text.index("</geoReference>")
    (tmp_path / "nowhere.xodr").write_text(
        text[:begin] + "<geoReference>" + text[end:], encoding="utf-8"
    )

    class Nowhere(Scenario):
        name = "nowhere"
        source = "nowhere.osc"

        def declare(self) -> None:
            self.net = Map(map_file="nowhere")
            self.there = GeodeticPoint(0.0, 0.0)

        def behavior(self) -> Behaviour:
            return Wait(elapsed(0.05))

    scenario = Nowhere(RunSettings(map_path=(tmp_path,)))
    scenario.create_tree()
    context = make_context(scenario, make_world(scenario))
    with pytest.raises(
        ScenarioError, match="there: map nowhere cannot locate the point: it has no"
    ):
        place_actors(scenario, context)


# --- traffic lights -------------------------------------------------------------------------------


def test_a_light_where_the_map_has_it() -> None:
    """Pose, height and width of a signal; it looks where the traffic that it is for goes."""
    element = road_element("urban_crossing", "2").find("signals/signal[@id='102']")
    assert element is not None
    scenario = on_map("urban_crossing", light=TrafficLight(map_id="102"))
    pose, light = scenario.light.pose, scenario.light
    s, t = float(element.get("s", "")), float(element.get("t", ""))
    # The northern arm comes down from y = 170 m; left of it is the east.
    assert (pose.x, pose.y) == pytest.approx((t, 170.0 - s), abs=1e-6)
    assert pose.z == float(element.get("zOffset", ""))
    assert pose.yaw == pytest.approx(-0.5 * math.pi)
    assert light.height == float(element.get("height", ""))
    assert light.width == float(element.get("width", ""))
    assert light.group.map_id == "2"
    assert [each.map_id for each in light.group.traffic_lights] == ["102", "104"]
    with pytest.raises(ScenarioError, match="group of 102 has no cycle"):
        light.group.cycle  # noqa: B018


def stop_line(**said: Any) -> Any:
    group = TrafficLightGroup(map_id="1")
    line = TrafficLightStopLine(traffic_light_group=group, **said)
    return on_map("urban_crossing", group=group, line=line).line


def test_the_stop_line_of_the_map() -> None:
    element = road_element("urban_crossing", "1").find("signals/signal[@id='101']")
    assert element is not None
    line = stop_line()
    assert line.offset == line.secondary_stop_offset == float(element.get("s", ""))
    assert (line.rightmost_lane, line.leftmost_lane) == (1, 2)
    assert (line.route.found.road, line.route.found.forwards) == ("1", True)
    with pytest.raises(
        ScenarioError, match="the primary_stop_line_marking of the stop line is not stated"
    ):
        line.primary_stop_line_marking  # noqa: B018


def test_a_stop_line_of_the_scenario() -> None:
    line = stop_line(
        offset=90.0,
        rightmost_lane=2,
        secondary_stop_offset=85.0,
        primary_stop_line_marking="broken",
        secondary_stop_line_marking="none",
    )
    assert (line.offset, line.secondary_stop_offset) == (90.0, 85.0)
    assert (line.rightmost_lane, line.leftmost_lane) == (2, 2)
    assert (line.primary_stop_line_marking, line.secondary_stop_line_marking) == ("broken", "none")
    moved = line.context.world.signals.lines({})
    # Both lights of the group hold there, for the left lane of the arm alone.
    assert {key: [(p.signal, p.s) for p in places] for key, places in moved.items()} == {
        ("1", -1): [("101", 90.0), ("103", 90.0)]
    }


@pytest.mark.parametrize(
    ("said", "reason"),
    [
        ({"rightmost_lane": 3}, "lanes 3 to 2 of road 1 cannot have a stop line: it has 2"),
        ({"leftmost_lane": 4}, "lanes 1 to 4 of road 1 cannot have a stop line"),
        ({"offset": 151.0}, "road 1 has no place at s = 151 m"),
        ({"route": Road()}, "a stop line lies on a lane_section"),
    ],
)
def test_stop_lines_that_cannot_be(said: dict[str, Any], reason: str) -> None:
    extra = {"road": said["route"]} if "route" in said else {}
    group = TrafficLightGroup(map_id="1")
    line = TrafficLightStopLine(traffic_light_group=group, **said)
    with pytest.raises(ScenarioError, match=reason):
        on_map("urban_crossing", group=group, line=line, **extra)
