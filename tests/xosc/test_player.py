"""What the player refuses, and what it makes of parameters: with a place and a reason."""

import math
import re
from itertools import pairwise
from pathlib import Path

import pytest

from osc2tx.grading.plain import plain
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from osc2tx.xosc.arithmetic import evaluated, text_value
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player import Evaluator, Unplayable, map_of
from osc2tx_runtime.opendrive import LanePosition, read_map
from osc2tx_shared.map_files import SHIPPED
from tests.importing.documents import after, at_time, document, event, speed_change

GENERATED = Path(__file__).parents[2] / "generated"
TEXT = (GENERATED / "cut_in.xosc").read_text(encoding="utf-8")
MAP = read_map(map_of(TEXT, (SHIPPED,)))
CYCLE = (
    '<TrafficSignals><TrafficSignalController name="c"><Phase name="p" duration="0"/>'
    "</TrafficSignalController></TrafficSignals></RoadNetwork>"
)


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("</RoadNetwork>", CYCLE, "cycle that takes no time"),
        ("TeleportAction", "VisibilityAction", "<VisibilityAction> is not played"),
    ],
)
def test_what_is_not_played_is_refused_with_a_reason(before: str, after: str, reason: str) -> None:
    assert before in TEXT
    with pytest.raises(Unplayable, match=reason):
        Evaluator(TEXT.replace(before, after), MAP, 0.05).play(5.0)


def test_a_route_of_a_catalog_is_refused_with_a_reason() -> None:
    route = (
        "</PrivateAction><PrivateAction><RoutingAction><AssignRouteAction>"
        '<CatalogReference catalogName="routes" entryName="north"/>'
        "</AssignRouteAction></RoutingAction></PrivateAction>"
    )
    with pytest.raises(Unplayable, match="the route has no positions"):
        Evaluator(TEXT.replace("</PrivateAction>", route, 1), MAP, 0.05).play(5.0)


def test_what_is_missing_has_a_place() -> None:
    text = TEXT.replace(' conditionEdge="none"', "")
    with pytest.raises(Unresolved, match=r"^\d+:\d+: <Condition> without conditionEdge"):
        Evaluator(text, MAP, 0.05).play(5.0)


def test_a_map_that_is_not_there_has_a_place() -> None:
    with pytest.raises(Unplayable, match=r"^\d+:\d+: there is no map"):
        map_of(TEXT, (GENERATED,))


def test_equal_elements_are_two() -> None:
    """Two equal conditions in two places remember on their own what they have seen."""
    root = read(TEXT)
    assert Evaluator(root, MAP, 0.05).play(300.0) == Evaluator(TEXT, MAP, 0.05).play(300.0)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2.5", 2.5),
        ("$a", 3.0),
        ("${$a * ($b - 1)}", 12.0),
        ("${-$a / 2 + 1}", -0.5),
        ("${pow($a, 2) % 5 + max(round(2.5), 1)}", 7.0),
        ("${1e1 - .5}", 9.5),
        ("${sin(pi / 2) + cos(0)}", 2.0),
        ("${acos(2)}", None),
        ("${$a / 0}", None),
        ("${sqrt(-1)}", None),
        ("${pow(9e99, 9e99)}", None),
        ("fast", None),
        ("$c", None),
    ],
)
def test_expressions_are_computed_not_run(text: str, value: float | None) -> None:
    assert evaluated(text, {"a": 3.0, "b": 5.0}) == value


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("plain", "plain"),
        ("$name", "Car"),
        ("${$a + 1}", "4.0"),
        ("${Brake at + _ + $a}", "Brake at_3"),
        ("${$name + Event}", "CarEvent"),
        ("${$other + Event}", None),
        ("${$name * 2}", None),
    ],
)
def test_texts_of_attributes_are_joined(text: str, value: str | None) -> None:
    assert text_value(text, {"a": "3", "name": "Car"}) == value


@pytest.mark.parametrize(
    "text",
    [
        "${__import__('os')}",
        "${$c + 1}",
        "${1 +}",
        "${(1}",
        "${}",
        "${inf}",
        "${1 2}",
        f"${{{'(' * 999}1{')' * 999}}}",
    ],
)
def test_what_is_no_expression_has_no_value(text: str) -> None:
    assert evaluated(text, {"a": 3.0}) is None


ROUTE = """<RoutePosition><RouteRef><Route name="r" closed="false">
<Waypoint routeStrategy="shortest"><Position>
<LanePosition roadId="1" laneId="-2" s="100"/></Position></Waypoint>
<Waypoint routeStrategy="shortest"><Position>
<LanePosition roadId="1" laneId="-2" s="400"/></Position></Waypoint></Route></RouteRef>
<InRoutePosition>{}</InRoutePosition></RoutePosition>"""


@pytest.mark.parametrize(
    "position",
    [
        '<FromLaneCoordinates pathS="100" laneId="-3"/>',
        '<FromRoadCoordinates pathS="100" t="{t}"/>',
    ],
)
def test_a_place_on_a_route(position: str) -> None:
    """It counts from the first waypoint on."""
    at = MAP.pose(LanePosition("1", -3, 200.0))
    start, end = TEXT.index("<LanePosition"), TEXT.index("/>", TEXT.index("<LanePosition")) + 2
    told = ROUTE.format(position.format(t=at.y - MAP.road_pose("1", 200.0, 0.0).y))
    evaluator = Evaluator(TEXT[:start] + told + TEXT[end:], MAP, 0.05)
    placed = next(body.here for body in evaluator.bodies.values() if body.pose is not None)
    assert placed[:2] == pytest.approx((at.x, at.y))


def test_at_the_end_of_its_road_an_entity_stands() -> None:
    evaluator = Evaluator(TEXT, MAP, 0.05)
    body = next(iter(evaluator.bodies.values()))
    body.v = 50.0
    while not body.is_at_end:
        body.move(MAP, 50.0, None, 1.0)
    body.note_motion(body.here, 1.0)
    body.note_motion(body.here, 1.0)
    assert (body.v, body.beyond) == (0.0, 2.0)
    evaluator.play(1.0)
    assert evaluator.ends == {body.name: 0.0}
    assert {row[1:] for row in evaluator.track[body.name]} == {(*body.here[:2], 0.0)}


def test_a_maneuver_ends_with_its_last_event() -> None:
    """The storyboard ends at once with it, as with the event."""
    maneuver = next(read(TEXT).below(xml.Maneuver))
    *_, event = maneuver.below(xml.Event)
    ends = []
    for kind, name in (("maneuver", maneuver.name), ("event", event.name)):
        condition = (
            f'<StopTrigger><ConditionGroup><Condition name="c" delay="0" conditionEdge="rising">'
            f'<ByValueCondition><StoryboardElementStateCondition storyboardElementType="{kind}" '
            f'storyboardElementRef="{name}" state="endTransition"/></ByValueCondition></Condition>'
            f"</ConditionGroup></StopTrigger></Storyboard>"
        )
        text = re.sub(r"<StopTrigger>.*</StopTrigger>\s*</Storyboard>", condition, TEXT, flags=re.S)
        ends.append(Evaluator(text, MAP, 0.05).play(30.0))
    assert ends[0] == ends[1] < 30.0


# --- lane changes: `other` begins in lane -2 at 15 m/s, its lanes are 3.5 m wide -----------------

LANE = 3.5


def played(action: str, before: str = "", speed: str = "") -> Evaluator:
    """Return the run of a document in which `other` does something at 1 s, up to 11 s."""
    text = document(before + event("It", action, at_time("1"), "parallel"), end=at_time("11"))
    evaluator = Evaluator(plain(read(text)), MAP, 0.01)
    if speed:
        evaluator.bodies["other"].v = float(speed)
    evaluator.play(11.0)
    return evaluator


def change(shape: str, dimension: str, value: str, lane: str = "-3") -> str:
    """Return a lane change."""
    return (
        f'<LateralAction><LaneChangeAction><LaneChangeActionDynamics dynamicsShape="{shape}" '
        f'dynamicsDimension="{dimension}" value="{value}"/><LaneChangeTarget>'
        f'<AbsoluteTargetLane value="{lane}"/></LaneChangeTarget></LaneChangeAction>'
        "</LateralAction>"
    )


def moved_aside(evaluator: Evaluator, time: float) -> float:
    """Return how far `other` is beside its first place."""
    rows = evaluator.track["other"]
    return abs(rows[round(time / 0.01)][2] - rows[0][2])


def test_a_step_into_another_lane_takes_no_time() -> None:
    evaluator = played(change("step", "time", "5"))
    assert moved_aside(evaluator, 1.0) == 0.0
    assert moved_aside(evaluator, 1.01) == pytest.approx(LANE)
    assert evaluator.time == pytest.approx(11.0)


def test_a_step_into_the_lane_of_oncoming_traffic_turns_nobody() -> None:
    evaluator = played(change("step", "time", "0", "1"))
    rows = evaluator.track["other"]
    assert moved_aside(evaluator, 2.0) == pytest.approx(7.0)  # lane -2 lies at -5.25 m
    assert rows[-1][1] - rows[0][1] == pytest.approx(15.0 * 11.0, abs=0.2)


@pytest.mark.parametrize("shape", ["linear", "sinusoidal", "cubic"])
def test_a_change_by_distance_goes_on_with_the_way(shape: str) -> None:
    """At a quarter of the way; the speed falls from 15 to 5 m/s in the first 5 s."""
    slower = event("Slower", speed_change("5", "5"), at_time("0"))
    evaluator = played(change(shape, "distance", "60"), slower)
    part = {"linear": 0.25, "sinusoidal": 0.5 - math.sqrt(0.125), "cubic": 0.15625}[shape]
    # since 1 s: 13 t - t^2 = 15
    quarter = 1.0 + 0.5 * (13.0 - math.sqrt(13.0**2 - 60.0))
    assert moved_aside(evaluator, quarter) == pytest.approx(part * LANE, abs=0.02)
    # 13 t - t^2 = 40 at 5 m/s after 4 s, 36 m; 24 m are left at 5 m/s
    assert moved_aside(evaluator, 5.0 + 24.0 / 5.0 - 0.1) < LANE - 1e-4
    assert moved_aside(evaluator, 5.0 + 24.0 / 5.0 + 0.02) == pytest.approx(LANE, abs=1e-4)


def test_a_change_by_distance_does_not_proceed_at_standstill() -> None:
    evaluator = played(change("sinusoidal", "distance", "60"), speed="0")
    assert moved_aside(evaluator, 10.9) == 0.0


@pytest.mark.parametrize(
    ("shape", "length"), [("linear", 3.5), ("cubic", 5.25), ("sinusoidal", 3.5 * math.pi / 2)]
)
def test_the_rate_of_a_change_is_its_peak(shape: str, length: float) -> None:
    evaluator = played(change(shape, "rate", "1"))
    rows = evaluator.track["other"]
    fastest = max(abs(b[2] - a[2]) / 0.01 for a, b in pairwise(rows))
    assert fastest == pytest.approx(1.0, abs=1e-3)
    assert moved_aside(evaluator, 1.0 + length - 0.1) < LANE - 1e-4
    assert moved_aside(evaluator, 1.0 + length + 0.02) == pytest.approx(LANE, abs=1e-5)


def test_a_change_at_no_rate_never_ends() -> None:
    assert moved_aside(played(change("linear", "rate", "0")), 10.9) == 0.0


def test_a_change_of_the_speed_from_standstill_to_standstill_takes_no_way() -> None:
    stays = speed_change("0").replace('"time" value="4"', '"distance" value="20"')
    evaluator = played(stays, speed="0")
    assert evaluator.track["other"][-1][1] == evaluator.track["other"][0][1]


# --- groups that are executed several times -------------------------------------------------------


def group_of(count: str, events: str) -> Evaluator:
    """Return the run of a document whose only group is executed several times."""
    text = document(events, end=at_time("20"))
    text = text.replace('maximumExecutionCount="1"', f'maximumExecutionCount="{count}"')
    evaluator = Evaluator(plain(read(text)), MAP, 0.01)
    evaluator.play(20.0)
    return evaluator


def speed_at(evaluator: Evaluator, time: float) -> float:
    return evaluator.track["other"][round(time / 0.01)][3]


@pytest.mark.parametrize("count", ["1", "2", "3"])
def test_a_group_begins_anew_when_its_events_are_over(count: str) -> None:
    """Each execution takes 2 s: 20 m/s, then 15 m/s again."""
    away = event("Away", speed_change("20", "1"), at_time("1"), "parallel")
    back = event("Back", speed_change("15", "1"), after("Away"), "parallel")
    evaluator = group_of(count, away + back)
    executed = [speed_at(evaluator, 2.05 + 2.02 * index) > 19.0 for index in range(4)]
    assert executed == [index < int(count) for index in range(4)]
    assert speed_at(evaluator, 19.0) == 15.0


def test_an_edge_is_waited_for_anew_in_each_execution() -> None:
    """A time has come once; in the second execution its condition is true from the first look."""
    rising = at_time("1").replace('conditionEdge="none"', 'conditionEdge="rising"')
    away = event("Away", speed_change("20", "1"), rising, "parallel")
    evaluator = group_of("3", away + event("Back", speed_change("15", "1"), after("Away")))
    assert speed_at(evaluator, 2.05) > 19.0
    assert [speed_at(evaluator, time) for time in (6.1, 19.0)] == [15.0, 15.0]


def test_an_act_ends_with_the_last_execution_of_its_group() -> None:
    evaluator = group_of("2", event("Away", speed_change("20", "1"), at_time("1")))
    act = next(evaluator.root.below(xml.Act))
    group = next(act.below(xml.ManeuverGroup))
    assert evaluator.is_in(act, "completeState")
    assert evaluator.is_in(group, "completeState")
    waits = group_of("2", event("Away", speed_change("20", "1"), at_time("30")))
    group = next(waits.root.below(xml.ManeuverGroup))
    assert waits.is_in(group, "standbyState")


@pytest.mark.parametrize(
    ("reference", "value", "expected"),
    [
        ('laneId="-3" s="100" offset="0"', "1", -7.75),  # its centre lies at -8.75 m
        ('laneId="-3" s="100" offset="-0.5"', "1", -8.25),
        ('laneId="1" s="900" offset="0"', "3", -1.25),  # its left is the right of the road
    ],
)
def test_an_offset_relative_to_another_entity(reference: str, value: str, expected: float) -> None:
    """It counts from where that one is across the road, in whatever lane, to its left."""
    action = (
        '<LateralAction><LaneOffsetAction continuous="false"><LaneOffsetActionDynamics '
        'dynamicsShape="sinusoidal" maxLateralAcc="2"/><LaneOffsetTarget><RelativeTargetLaneOffset '
        f'entityRef="ego" value="{value}"/></LaneOffsetTarget></LaneOffsetAction></LateralAction>'
    )
    text = document(event("It", action, at_time("1")), end=at_time("9"))
    place = '<RelativeLanePosition entityRef="ego" dLane="1" ds="30" offset="0"/>'
    text = text.replace(place, '<LanePosition roadId="1" laneId="-2" s="130" offset="0"/>')
    text = text.replace('laneId="-3" s="100" offset="0"', reference)
    evaluator = Evaluator(plain(read(text)), MAP, 0.01)
    evaluator.play(9.0)
    assert evaluator.track["other"][-1][2] == pytest.approx(expected)
