"""What changes at once: variables, lanes; and what elements are called by their paths."""

from pathlib import Path

import pytest

from osc2tx.cli.import_ import import_all
from osc2tx.importing.document import Folders
from tests.importing.documents import after, at_time, document, event, faults, imported, lane_change
from tests.importing.documents import speed_change as change
from tests.importing.test_structure import apart

CHANGE = """<Event name="{0}" priority="parallel"><Action name="{0}Action"><GlobalAction>
  <VariableAction variableRef="count"><ModifyAction><Rule><{1} value="{2}"/></Rule></ModifyAction>
  </VariableAction></GlobalAction></Action><StartTrigger><ConditionGroup>{3}</ConditionGroup>
  </StartTrigger></Event>"""
COUNT = """<VariableDeclarations>
  <VariableDeclaration name="count" variableType="integer" value="4"/></VariableDeclarations>"""
IS = """<Condition name="count" delay="0" conditionEdge="none"><ByValueCondition>
  <VariableCondition variableRef="count" value="{}" rule="equalTo"/></ByValueCondition>
  </Condition>"""


def is_same(text: str, folder: Path) -> bool:
    """Whether a run of a document and one of its scenario are the same, late events apart."""
    source = folder / "cars.xosc"
    source.write_text(text, encoding="utf-8")
    (found,), _ = import_all([source], folder / "out", Folders())
    measured = found.imported.report.measured
    return not found.faults and measured is not None and measured.is_exact


def counting(value: str) -> str:
    """Return a document in which 4 becomes 12, then 19, at which `other` drives faster."""
    events = (
        CHANGE.format("Thrice", "MultiplyByValue", "3", at_time("1"))
        + CHANGE.format("More", "AddValue", "7", at_time("2"))
        + event("Faster", change("20"), IS.format(value), "parallel")
    )
    return document(events).replace("<CatalogLocations/>", f"{COUNT}<CatalogLocations/>")


@pytest.mark.parametrize(("value", "said"), [("19", "count_19"), ("12", "count_12")])
def test_a_variable_that_is_computed_has_its_values_in_the_order_of_the_document(
    value: str, said: str
) -> None:
    found = imported(counting(value))
    assert f"emit {said}" in found.text
    assert f"wait @{said}" in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_variable_that_is_no_number_is_not_computed() -> None:
    found = imported(counting("19").replace('value="4"', 'value="none"'))
    assert "emit" not in found.text
    assert "has no number" in found.report.to_json()


@pytest.mark.parametrize(("lanes", "side"), [(1, "left"), (-1, "right")])
def test_another_lane_at_once(lanes: int, side: str, tmp_path: Path) -> None:
    jump = f"""<LateralAction><LaneChangeAction>
      <LaneChangeActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/>
      <LaneChangeTarget><RelativeTargetLane entityRef="other" value="{lanes}"/></LaneChangeTarget>
      </LaneChangeAction></LateralAction>"""
    text = document(event("Jump", jump, at_time("1.5")))
    assert f"lane(side_of: other, side: {side})" in imported(text).text
    assert is_same(text, tmp_path)


DIFFERENCE = """<Condition name="slower" delay="0" conditionEdge="none"><ByEntityCondition>
  <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="ego"/>
  </TriggeringEntities><EntityCondition><RelativeSpeedCondition entityRef="other" value="{}"
  rule="lessThan" direction="{}"/></EntityCondition></ByEntityCondition></Condition>"""


@pytest.mark.parametrize(
    ("value", "direction", "said"),
    [
        ("2", "longitudinal", "ego.velocity.translational.x - other.velocity.translational.x"),
        ("-1", "lateral", "ego.velocity.translational.y - other.velocity.translational.y"),
        ("-1", "vertical", "ego.velocity.translational.z - other.velocity.translational.z"),
    ],
)
def test_the_part_of_a_difference_of_speeds(
    value: str, direction: str, said: str, tmp_path: Path
) -> None:
    """`ego` drives at 20, `other` from 15 to 25 m/s in 5 s: the difference is 2 after 2.5 s."""
    events = event("Faster", change("25", "5"), at_time("1")) + event(
        "Aside", LANE, DIFFERENCE.format(value, direction)
    )
    assert said in imported(document(events)).text
    assert is_same(document(events), tmp_path)


LANE = """<LateralAction><LaneChangeAction>
  <LaneChangeActionDynamics dynamicsShape="sinusoidal" dynamicsDimension="time" value="3"/>
  <LaneChangeTarget><RelativeTargetLane entityRef="other" value="-1"/></LaneChangeTarget>
  </LaneChangeAction></LateralAction>"""


@pytest.mark.parametrize("name", ["Maneuver::Faster", "Act::Group::Maneuver::Faster"])
def test_an_element_is_named_with_those_around_it(name: str) -> None:
    events = event("Faster", change("20"), at_time("1")) + event(
        "Slower", change("10"), after(name)
    )
    found = imported(document(events))
    assert "change_speed(target: 10mps" in found.text
    assert "wait @" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


AT_A_RATE = """<LateralAction><LaneChangeAction>
  <LaneChangeActionDynamics dynamicsShape="{}" dynamicsDimension="rate" value="1.5"/>
  <LaneChangeTarget><AbsoluteTargetLane value="-3"/></LaneChangeTarget></LaneChangeAction>
  </LateralAction>"""


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        ("linear", "rate_profile: constant, rate_peak: 1.5mps"),
        ("sinusoidal", "rate_profile: smooth, rate_peak: 1.5mps"),
        ("cubic", "rate_profile: smooth, rate_peak: 1.570796mps"),  # as long as 1.5 of a cubic one
    ],
)
def test_a_lane_change_at_a_rate_has_that_peak(shape: str, said: str, tmp_path: Path) -> None:
    text = document(event("Aside", AT_A_RATE.format(shape), at_time("1")))
    assert said in imported(text).text
    assert is_same(text, tmp_path)


def test_an_actor_of_several_branches_holds_its_speed_in_bends(tmp_path: Path) -> None:
    """Either change of the lane may come first, so neither branch is behind the other."""
    reached = """<Condition name="there" delay="0" conditionEdge="none"><ByEntityCondition>
      <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="other"/>
      </TriggeringEntities><EntityCondition><ReachPositionCondition tolerance="3"><Position>
      <LanePosition roadId="1" laneId="{}" s="{}"/></Position></ReachPositionCondition>
      </EntityCondition></ByEntityCondition></Condition>"""
    events = event("Out", lane_change(-1), reached.format(-1, 180))
    events += event("In", lane_change(1), reached.format(-2, 320))
    text = (
        document(events, end=at_time("20"))
        .replace("highway.xodr", "curve.xodr")
        .replace('laneId="-3" s="100"', 'laneId="-2" s="100"')
    )
    text = text.replace('<AbsoluteTargetSpeed value="15"/>', '<AbsoluteTargetSpeed value="25"/>')
    assert "other.keep_speed()" in imported(text).text
    assert is_same(text, tmp_path)


def test_a_cubic_change_of_the_speed_at_a_rate_takes_as_long(tmp_path: Path) -> None:
    """1.5 of 3 m/s at a peak of 3 m/s^2, 1.5 s; half a cosine with that peak takes 0.07 s more."""
    at_a_rate = change("18", "3", "cubic").replace('Dimension="time"', 'Dimension="rate"')
    text = document(event("Faster", at_a_rate, at_time("1")))
    assert "rate_peak: 3.141593mpss" in imported(text).text
    assert is_same(text, tmp_path)


def test_a_cubic_change_of_the_offset_has_a_bound(tmp_path: Path) -> None:
    """Of 7 m."""
    action = """<LateralAction><LaneOffsetAction continuous="false"><LaneOffsetActionDynamics
      dynamicsShape="cubic" maxLateralAcc="1"/><LaneOffsetTarget>
      <AbsoluteTargetLaneOffset value="-7"/></LaneOffsetTarget></LaneOffsetAction>
      </LateralAction>"""
    text = document(event("Aside", action, at_time("1")), end=at_time("11"))
    found = imported(text)
    (bound,) = {each.bound for each in found.report.findings if "cubic" in each.reason}
    assert bound == pytest.approx(0.0101 * 7.0, abs=1e-3)
    assert is_same(text, tmp_path)
