"""Forms that a person would write: places, gaps, dimensions, what goes on by itself."""

import re

import pytest

from tests.importing.documents import (
    AT_ONCE,
    at_time,
    document,
    event,
    faults,
    imported,
    speed_change,
)
from tests.importing.test_structure import apart

GAP = """<LongitudinalAction><LongitudinalDistanceAction entityRef="ego" freespace="true"
  continuous="false" {} displacement="leadingReferencedEntity"/></LongitudinalAction>"""
SAME_LANE = 'dLane="0" ds="30"'
OPEN = (
    '<ParameterDeclaration name="Ahead" parameterType="double" value="30"/>'
    '<ParameterDeclaration name="Aside" parameterType="double" value="0.5"/>'
)
PRODUCT = (
    '<ParameterDeclaration name="Speed" parameterType="double" value="20"/>'
    '<ParameterDeclaration name="Headway" parameterType="double" value="1.5"/>'
)


def in_same_lane(text: str) -> str:
    return text.replace('dLane="1" ds="30"', SAME_LANE)


def test_on_a_straight_road_actors_go_on_by_themselves() -> None:
    text = document(event("Faster", speed_change("20"), at_time("1")))
    assert "ego.keep_speed()" in imported(text).text  # the highway bends: drivers would brake
    text = text.replace("highway.xodr", "merge.xodr").replace('"-3" s="100"', '"-2" s="20"')
    found = imported(text.replace('roadId="1"', 'roadId="2"'))
    assert "keep_speed" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_an_actor_turned_against_its_lane_drives_there() -> None:
    beside = '<RelativeLanePosition entityRef="ego" dLane="1" ds="30" offset="0"/>'
    turned = """<LanePosition roadId="1" laneId="-1" s="400" offset="0.5">
      <Orientation type="relative" h="3.141592653589793"/></LanePosition>"""
    found = imported(document("").replace(beside, turned))
    assert 'road.create_odr_point("1", "1", 400m, ' in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_step_to_a_relative_speed_that_is_kept_is_there_at_once() -> None:
    faster = f"""<LongitudinalAction><SpeedAction>{AT_ONCE}<SpeedActionTarget>
      <RelativeTargetSpeed entityRef="ego" value="5" speedTargetValueType="delta"
      continuous="true"/></SpeedActionTarget></SpeedAction></LongitudinalAction>"""
    found = imported(document(event("Faster", faster, at_time("1"))))
    assert "other.assign_speed(ego.speed + 5mps)" in found.text
    assert "speed(5mps, faster_than: ego)" in found.text
    assert apart(found) < 0.1


def test_a_gap_without_limits_is_there_at_once() -> None:
    text = in_same_lane(document(event("Gap", GAP.format('distance="20"'), at_time("1"))))
    found = imported(text)
    assert "position(25m, ahead_of: ego)" in found.text
    assert apart(found) < 0.1


def test_a_gap_in_time_counts_the_speed_of_the_one_behind() -> None:
    text = in_same_lane(document(event("Gap", GAP.format('timeGap="2"'), at_time("1"))))
    found = imported(text)
    assert "position(2s * ego.speed + 5m, ahead_of: ego)" in found.text
    assert faults(found) == []


def test_an_open_place_beside_another_actor_stays_open() -> None:
    text = document("", parameters=OPEN).replace(
        'ds="30" offset="0"', 'ds="$Ahead" offset="$Aside"'
    )
    found = imported(text)
    assert '"-2", 100m + ahead, aside)' in found.text
    assert faults(found) == []


def test_the_factor_beside_a_speed_in_a_length_is_a_time() -> None:
    text = document("", parameters=PRODUCT, ego_speed="$Speed").replace(
        'ds="30"', 'ds="${$Headway * $Speed}"'
    )
    found = imported(text)
    assert "headway: time = 1.5s" in found.text
    assert "position(headway * speed, ahead_of: ego)" in found.text


def test_places_of_nearby_actors_are_looked_for_once() -> None:
    """Two actors that begin beside each other are put there, not on the road before that."""
    found = imported(document(""))
    assert list(found.starts) == ["ego"]


def offset_change(target: str) -> str:
    return f"""<LateralAction><LaneOffsetAction continuous="false">
      <LaneOffsetActionDynamics maxLateralAcc="0.5" dynamicsShape="sinusoidal"/>
      <LaneOffsetTarget>{target}</LaneOffsetTarget></LaneOffsetAction></LateralAction>"""


def test_an_offset_is_reached_with_the_lateral_acceleration_of_the_document() -> None:
    """A smooth course has its peak at the square root of half of change times acceleration."""
    action = offset_change('<AbsoluteTargetLaneOffset value="1.5"/>')
    found = imported(document(event("Aside", action, at_time("1"))))
    peak = (0.5 * 1.5 * 0.5) ** 0.5
    assert f"rate_peak: {peak:.4f}mps" in found.text
    assert apart(found) < 0.1


@pytest.mark.parametrize("value", ["3", "-0.5"])
def test_an_offset_beside_another_actor(value: str) -> None:
    """It counts from there, 3.5 m to the right of the own lane."""
    action = offset_change(f'<RelativeTargetLaneOffset entityRef="ego" value="{value}"/>')
    found = imported(document(event("Aside", action, at_time("1"))))
    assert faults(found) == []
    assert f"offset: {float(value) - 3.5:g}m" in found.text
    assert apart(found) < 0.1


def test_an_offset_into_another_lane_counts_there_from_then_on() -> None:
    """At 3 m to the right of its lane it is in the one of `ego`, 0.5 m beside that one."""
    aside = offset_change('<AbsoluteTargetLaneOffset value="-3"/>')
    back = offset_change('<RelativeTargetLaneOffset entityRef="ego" value="0"/>')
    found = imported(
        document(event("Aside", aside, at_time("1")) + event("Back", back, at_time("7")))
    )
    assert apart(found) < 0.1


BACKWARDS = """<PrivateAction><RoutingAction><FollowTrajectoryAction>
  <TimeReference><None/></TimeReference><TrajectoryFollowingMode followingMode="position"/>
  <TrajectoryRef><Trajectory name="back" closed="false"><Shape><Polyline>
  <Vertex><Position><RoadPosition roadId="2" s="100" t="0"/></Position></Vertex>
  <Vertex><Position><RoadPosition roadId="2" s="20" t="0"/></Position></Vertex>
  </Polyline></Shape></Trajectory></TrajectoryRef></FollowTrajectoryAction></RoutingAction>
  </PrivateAction>"""
DRIVEN = """<Condition name="driven" delay="0" conditionEdge="none"><ByEntityCondition>
  <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="ego"/>
  </TriggeringEntities><EntityCondition><TraveledDistanceCondition value="12"/></EntityCondition>
  </ByEntityCondition></Condition>"""


def test_a_teleport_ends_the_trajectory_before_it_and_a_way_driven_backwards_counts() -> None:
    text = document("", end=DRIVEN, ego_speed="-2").replace("highway.xodr", "merge.xodr")
    text = text.replace('roadId="1" laneId="-3" s="100"', 'roadId="2" laneId="-2" s="100"')
    first = '<Private entityRef="ego">'
    found = imported(text.replace(first, first + BACKWARDS))
    assert "replay_path" not in found.text
    assert "wait ego.get_s_coord() <= 88m" in found.text
    assert apart(found) < 0.1


HEADWAY = """<Condition name="far" delay="0" conditionEdge="none"><ByEntityCondition>
  <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="{}"/>
  </TriggeringEntities><EntityCondition>{}</EntityCondition></ByEntityCondition></Condition>"""


def test_a_headway_behind_an_actor_counts_like_one_ahead() -> None:
    """`ego`, 5 m/s faster, comes from 30 m behind and is 40 m ahead after 14 s."""
    said = '<TimeHeadwayCondition entityRef="ego" value="2" freespace="false" {} rule="{}"/>'
    along = 'coordinateSystem="road" relativeDistanceType="longitudinal"'
    condition = HEADWAY.format("other", said.format(along, "greaterThan"))
    found = imported(document(event("Faster", speed_change("20", "2"), condition)))
    assert "> 2s * other.speed or" in " ".join(found.text.split())
    assert faults(found) == []


def test_the_time_to_collision_of_reference_points() -> None:
    """30 m behind and 5 m/s faster: after 2 s it is 4 s, of boxes it is less."""
    target = '<TimeToCollisionConditionTarget><EntityRef entityRef="other"/>'
    said = f"""<TimeToCollisionCondition value="4" freespace="false" coordinateSystem="road"
      relativeDistanceType="longitudinal" rule="lessThan">{target}
      </TimeToCollisionConditionTarget></TimeToCollisionCondition>"""
    condition = HEADWAY.format("ego", said)
    found = imported(in_same_lane(document(event("Away", speed_change("25", "2"), condition))))
    assert "< 4s * (ego.speed - other.speed)" in " ".join(found.text.split())
    assert apart(found) < 0.1


def test_a_gap_at_the_start_keeps_the_offset_of_the_place_before() -> None:
    text = in_same_lane(document("", parameters=OPEN)).replace(
        'ds="30" offset="0"', 'ds="30" offset="$Aside"'
    )
    gap = GAP.format('distance="20"')
    gap = f"<PrivateAction>{gap}</PrivateAction></Private></Actions>"
    found = imported(re.sub(r"</Private>\s*</Actions>", gap, text))
    assert "125m, aside)" in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_trajectory_in_lanes_leads_along_points_of_the_map() -> None:
    corner = '<Vertex><Position><LanePosition roadId="1" laneId="-2" s="{}"/></Position></Vertex>'
    shape = f"<Polyline>{corner.format(130)}{corner.format(190)}</Polyline>"
    action = f"""<RoutingAction><FollowTrajectoryAction><TimeReference><None/></TimeReference>
      <TrajectoryFollowingMode followingMode="position"/><TrajectoryRef>
      <Trajectory name="way" closed="false"><Shape>{shape}</Shape></Trajectory></TrajectoryRef>
      </FollowTrajectoryAction></RoutingAction>"""
    found = imported(document(event("Follow", action, at_time("0")), end=at_time("3")))
    assert "create_path_odr_points" in found.text
    assert "pose_3d" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_text_with_the_name_of_an_argument_is_no_parameter_of_the_scenario() -> None:
    declared = '<ParameterDeclaration name="target" parameterType="string" value="a"/>'
    faster = event("Faster", speed_change("20"), at_time("3"))
    found = imported(document(faster, parameters=declared))
    assert "change_speed(target: 20mps" in found.text
    assert found.text == imported(document(faster)).text
