"""Conditions on places and clearances: the same events at the same times as in the document."""

from pathlib import Path

import pytest

from tests.importing.documents import document, event, faults, imported, speed_change
from tests.importing.test_forms import HEADWAY
from tests.importing.test_measured import report_of
from tests.importing.test_structure import apart

BESIDE = '<RelativeLanePosition entityRef="ego" dLane="1" ds="30" offset="0"/>'

FAR = """<DistanceCondition freespace="false" rule="{}" value="{}" coordinateSystem="{}"
  relativeDistanceType="longitudinal"><Position>{}</Position></DistanceCondition>"""
AHEAD = '<RoadPosition roadId="1" s="200" t="0"/>'
BEYOND = '<RelativeWorldPosition entityRef="ego" dx="-5000" dy="0"/>'
CLEAR = """<RelativeClearanceCondition distanceForward="{}" distanceBackward="{}" freeSpace="false"
  oppositeLanes="true"><EntityRef entityRef="{}"/></RelativeClearanceCondition>"""


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        (FAR.format("lessThan", "40", "road", AHEAD), "other.get_s_coord() > 160m"),
        (
            FAR.format("greaterThan", "40", "road", AHEAD.replace("200", "120")),
            "other.get_s_coord() > 160m",
        ),
        (
            FAR.format("greaterThan", "4980", "entity", BEYOND),
            "other.object_distance(ego, longitudinal) < 20m",
        ),
        (CLEAR.format(0, 5000, "ego"), "other.road_distance(ego, longitudinal) > 0m"),
    ],
)
def test_when_a_place_or_another_actor_is_near(condition: str, expected: str) -> None:
    """`ego`, 5 m/s faster, comes from 30 m behind; `other` begins at 130 m."""
    found = imported(document(event("Stop", speed_change("5"), HEADWAY.format("other", condition))))
    assert expected in " ".join(found.text.split())
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_clearance_tells_the_sign_of_the_distance_beside_it() -> None:
    """`ego` is 30 m behind at first: only ahead does the distance count."""
    far = """<RelativeDistanceCondition entityRef="ego" rule="greaterThan" value="10"
      freespace="false" coordinateSystem="road" relativeDistanceType="longitudinal"/>"""
    both = HEADWAY.format("other", far) + HEADWAY.format("other", CLEAR.format(0, 5000, "ego"))
    found = imported(document(event("Stop", speed_change("5"), both)))
    assert "wait other.road_distance(ego, longitudinal) > 10m" in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_an_acceleration_across_the_lane() -> None:
    condition = '<AccelerationCondition rule="lessThan" value="1" direction="lateral"/>'
    found = imported(document(event("Stop", speed_change("5"), HEADWAY.format("other", condition))))
    assert "wait other.acceleration.translational.y < 1mpss" in found.text
    assert faults(found) == []


def collision_time(target: str) -> str:
    """Return a condition of `other` on a time to a collision."""
    return f"""<Condition name="near" delay="0" conditionEdge="none"><ByEntityCondition>
      <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="other"/>
      </TriggeringEntities><EntityCondition><TimeToCollisionCondition value="2" rule="lessThan"
      freespace="false" coordinateSystem="entity" relativeDistanceType="longitudinal">
      <TimeToCollisionConditionTarget>{target}</TimeToCollisionConditionTarget>
      </TimeToCollisionCondition></EntityCondition></ByEntityCondition></Condition>"""


def test_the_time_to_a_collision_with_oncoming_traffic() -> None:
    text = document(
        event("Brake", speed_change("5"), collision_time('<EntityRef entityRef="ego"/>'))
    )
    oncoming = '<LanePosition roadId="1" laneId="3" s="400" offset="0"/>'
    lane = '<LanePosition roadId="1" laneId="-3" s="100" offset="0"/>'
    found = imported(text.replace(lane, oncoming, 1).replace(BESIDE, lane.replace("-3", "-2")))
    way = "other.object_distance(ego, longitudinal)"
    assert f"wait {way} > 0m and {way} < 2s * (other.speed + ego.speed)" in found.text
    assert faults(found) == []


def test_the_time_to_a_place(tmp_path: Path) -> None:
    """15 m/s: 2 s before a place 100 m ahead are 70 m, after 4.67 s."""
    place = '<Position><LanePosition roadId="1" laneId="-2" s="230"/></Position>'
    text = document(event("Brake", speed_change("5"), collision_time(place)))
    report = report_of(tmp_path, text)
    assert report["measured"]["exact"] is True


def test_a_place_is_as_high_as_its_road(tmp_path: Path) -> None:
    """The curve climbs: a point below it would never be reached."""
    there = '<ReachPositionCondition tolerance="2"><Position>{}</Position></ReachPositionCondition>'
    place = '<LanePosition roadId="1" laneId="-1" s="300" offset="0"/>'
    stops = event("Stop", speed_change("5"), HEADWAY.format("other", there.format(place)))
    text = (
        document(stops).replace("highway.xodr", "curve.xodr").replace('laneId="-3"', 'laneId="-2"')
    )
    found = imported(text).text
    assert "create_xyz_point(" in found and ", 0m)" not in found.split("create_xyz_point(")[1][:40]
    assert report_of(tmp_path, text)["measured"]["exact"] is True


def test_a_distance_along_the_road_is_no_distance_along_the_lane_in_a_bend(tmp_path: Path) -> None:
    text = (
        document("").replace("highway.xodr", "curve.xodr").replace('"-3" s="100"', '"-2" s="220"')
    )
    assert 'create_odr_point("1", "-1", 250m, 0m)' in imported(text).text
    assert report_of(tmp_path, text)["measured"]["exact"] is True
