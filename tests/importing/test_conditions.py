"""Conditions on places and clearances: the same events at the same times as in the document."""

import pytest

from tests.importing.documents import document, event, faults, imported, speed_change
from tests.importing.test_forms import HEADWAY
from tests.importing.test_structure import apart

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
