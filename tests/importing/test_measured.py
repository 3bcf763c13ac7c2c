"""A run of the scenario against its document decides the grade."""

import json
from pathlib import Path
from typing import Any

import pytest

from osc2tx.grading.imports import ImportDeviation
from osc2tx.grading.plain import plain
from osc2tx.xosc import read
from osc2tx.xosc.arithmetic import evaluated
from tests.importing.documents import after, at_time, document, event, lane_change, speed_change
from tests.importing.test_command import PARAMETER, VALUES, command, written

FASTER = event("Faster", speed_change("20"), at_time("1"))
STANDS = """<Condition name="stands" delay="0" conditionEdge="none"><ByEntityCondition>
  <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="other"/>
  </TriggeringEntities><EntityCondition><StandStillCondition duration="2"/></EntityCondition>
  </ByEntityCondition></Condition>"""


def report_of(folder: Path, text: str) -> dict[str, Any]:
    """Return the report of the import of a document."""
    source = written(folder, "two_cars.xosc", text)
    command("import", source, "-o", folder / "out")
    place = folder / "out" / "two_cars.import.json"
    return dict(json.loads(place.read_text(encoding="utf-8")))


def test_the_same_run_is_exact(tmp_path: Path) -> None:
    report = report_of(tmp_path, document(FASTER + event("Back", lane_change(-1), after("Faster"))))
    assert (report["grade"], report["basis"]) == ("exact", "run")
    assert report["measured"]["exact"] is True
    assert report["measured"]["place_m"] < 0.1


def test_another_run_is_a_finding_with_a_bound(tmp_path: Path) -> None:
    """A cubic change of the speed is faster in its middle than a smooth one."""
    text = document(event("Faster", speed_change("60", "8", "cubic"), at_time("1")))
    report = report_of(tmp_path, text)
    assert report["basis"] == "run"
    bounds = [each["bound"] for each in report["findings"] if each["construct"] == "the scenario"]
    assert bounds
    assert bounds[0] >= report["measured"]["place_m"] > 0.1


def test_what_is_not_played_is_said(tmp_path: Path) -> None:
    offroad = STANDS.replace(
        '<StandStillCondition duration="2"/>', '<OffroadCondition duration="1"/>'
    )
    report = report_of(tmp_path, document(FASTER, end=offroad + at_time("3")))
    assert report["basis"] == "constructs"
    assert "is not played" in report["measured"]["reason"]


def test_an_end_by_standing_still(tmp_path: Path) -> None:
    report = report_of(
        tmp_path, document(event("Stop", speed_change("0"), at_time("1")), end=STANDS)
    )
    assert report["measured"]["exact"] is True


def test_open_parameters_have_values_in_the_run(tmp_path: Path) -> None:
    text = document("", parameters=PARAMETER, ego_speed="${$Speed_kph / 3.6}")
    written(tmp_path, "speeds.xosc", text)
    source = written(tmp_path, "values.xosc", VALUES)
    assert command("import", source, "-o", tmp_path / "out").return_value == 0
    report = json.loads((tmp_path / "out" / "values.import.json").read_text(encoding="utf-8"))
    assert report["measured"]["exact"] is True


def test_the_summary_counts_runs(tmp_path: Path) -> None:
    source = written(tmp_path, "two_cars.xosc", document(FASTER))
    result = command("import", source, "-o", tmp_path / "out")
    assert "1 scenario run against the documents: 1 the same" in result.output


@pytest.mark.parametrize(
    ("place", "time", "is_exact"),
    [(0.05, 0.0, True), (0.2, 0.0, False), (0.0, 0.1, True), (0.0, 0.3, False)],
)
def test_exactness(place: float, time: float, *, is_exact: bool) -> None:
    assert ImportDeviation(place, "ego", 1.0, 1.0, time, late=0.1).is_exact is is_exact


def test_tools_parts_move_nothing() -> None:
    root = read(
        '<Event name="e"><Action name="a"><PrivateAction><ControllerAction/></PrivateAction>'
        '</Action><StartTrigger><ConditionGroup><Condition name="c"/></ConditionGroup>'
        "</StartTrigger></Event>"
    )
    found = plain(root)
    assert [node.tag for node in found.walk()] == [
        "Event",
        "StartTrigger",
        "ConditionGroup",
        "Condition",
    ]
    assert found.get("maximumExecutionCount") == "1"


def test_pi_is_a_number() -> None:
    assert evaluated("${$a * pi / 180}", {"a": 180.0}) == pytest.approx(3.14159265)


def test_a_trigger_that_waits_for_nothing_starts_at_once() -> None:
    """As tools take it: the event starts with its act."""
    found = plain(read('<Act name="a"><StartTrigger/><StopTrigger/></Act>'))
    assert [node.tag for node in found.children] == ["StopTrigger"]


def test_an_actor_that_is_put_elsewhere_in_the_run(tmp_path: Path) -> None:
    """The player shows it there one step later, when it has moved on."""
    place = '<LanePosition roadId="1" laneId="-2" s="250" offset="0"/>'
    action = f"<TeleportAction><Position>{place}</Position></TeleportAction>"
    report = report_of(tmp_path, document(event("Jump", action, at_time("2"))))
    assert report["measured"]["exact"] is True
    assert report["measured"]["place_m"] < 0.01


def test_a_step_more_at_speed_is_late_and_not_off(tmp_path: Path) -> None:
    """Behind a strict comparison an event begins a step later; what it makes at speed shrinks."""
    strict = at_time("2").replace("greaterOrEqual", "greaterThan")
    report = report_of(tmp_path, document(event("Slow", speed_change("1", "0", "step"), strict)))
    assert report["measured"]["exact"] is True
