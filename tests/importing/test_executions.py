"""Events and groups that are executed several times."""

from pathlib import Path

import pytest

from osc2tx.importing.board import MOST_EXECUTIONS
from tests.importing.documents import (
    after,
    at_time,
    document,
    event,
    imported,
    lane_change,
    speed_change,
)
from tests.importing.test_changes import is_same

FURTHER = """<LongitudinalAction><SpeedAction>
  <SpeedActionDynamics dynamicsShape="linear" dynamicsDimension="time" value="1"/>
  <SpeedActionTarget><RelativeTargetSpeed entityRef="other" value="{}"
  speedTargetValueType="delta" continuous="false"/></SpeedActionTarget></SpeedAction>
  </LongitudinalAction>"""
ONLY = "only the first is here"


def times(text: str, count: int, element: str) -> str:
    """Return a document whose first event or group is executed several times."""
    bare = text.replace(f'<{element} maximumExecutionCount="1"', f"<{element}")
    bare = (
        bare.replace(' maximumExecutionCount="1">', ">", 1) if element == "ManeuverGroup" else bare
    )
    return bare.replace(f"<{element} ", f'<{element} maximumExecutionCount="{count}" ', 1)


def test_an_event_that_is_met_again_is_executed_again(tmp_path: Path) -> None:
    """Each time 2 m/s more, from 15 m/s on."""
    text = times(document(event("Further", FURTHER.format(2), at_time("1"))), 3, "Event")
    found = imported(text).text
    assert found.count("other.change_speed(") == 3
    assert found.count("wait elapsed(1s)") == 1  # the time has come
    assert is_same(text, tmp_path)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_group_comes_again_as_a_whole(count: int, tmp_path: Path) -> None:
    events = event("Away", speed_change("20", "1"), at_time("1"))
    events += event("Back", speed_change("15", "1"), after("Away", delay="0.5"))
    text = times(document(events), count, "ManeuverGroup")
    found = imported(text)
    assert found.text.count("target: 20mps") == found.text.count("target: 15mps") == count
    assert ONLY not in found.report.to_json()
    assert is_same(text, tmp_path)


@pytest.mark.parametrize(
    ("state", "edge"), [("endTransition", "rising"), ("completeState", "none")]
)
def test_an_event_ends_with_each_execution_and_is_over_with_the_last(
    state: str, edge: str, tmp_path: Path
) -> None:
    """What waits for its transition comes behind the first one, beside the others."""
    ended = after("Further").replace("completeState", state).replace('"none"', f'"{edge}"')
    events = event("Further", FURTHER.format(2), at_time("1"), "parallel")
    text = document(events + event("Aside", lane_change(-1), ended, "parallel"))
    assert is_same(times(text, 3, "Event"), tmp_path)


def test_what_comes_once_is_executed_once(tmp_path: Path) -> None:
    once = at_time("1").replace('conditionEdge="none"', 'conditionEdge="rising"')
    text = times(document(event("Further", FURTHER.format(2), once)), 3, "Event")
    found = imported(text)
    assert found.text.count("other.change_speed(") == 1
    assert ONLY not in found.report.to_json()
    assert is_same(text, tmp_path)


@pytest.mark.parametrize("element", ["Event", "ManeuverGroup"])
def test_of_many_executions_there_is_the_first(element: str) -> None:
    text = document(event("Further", FURTHER.format(2), at_time("1")))
    found = imported(times(text, MOST_EXECUTIONS + 1, element))
    assert found.text.count("other.change_speed(") == 1
    assert f"of 6 executions {ONLY}" in found.report.to_json()
