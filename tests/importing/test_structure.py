"""Storyboards become compositions, and run as the document plays."""

import json
import math
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.importing.importer import Imported
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx.xosc.player import Evaluator
from osc2tx_runtime import RunSettings, run_scenario
from osc2tx_runtime.opendrive import read_map
from tests.importing.documents import (
    after,
    at_time,
    document,
    event,
    faults,
    imported,
    lane_change,
    speed_change,
)

DT = 0.02


def apart(found: Imported) -> float:
    """Return how far (m) actors are from where the player has them, beyond two steps."""
    compilation = Compilation(
        Path("two_cars.osc"), "two_cars.osc", CompileOptions(), text=found.text
    )
    module = compilation.module
    assert module is not None
    with scenarios_of_module(module) as scenarios:
        result = run_scenario(scenarios["two_cars"], RunSettings(dt=DT))
    assert result.status == "success", result.reason
    assert found.document.map_file is not None
    player = Evaluator(found.document.resolved, read_map(found.document.map_file), DT)
    assert player.play(100.0) == pytest.approx(result.time, abs=3 * DT)
    worst = 0.0
    states = [line for line in map(json.loads, result.trace_lines) if line["kind"] == "state"]
    for line in states:
        rows = player.track[line["actor"]]
        index = min(round(line["t"] / DT), len(rows) - 1)
        _, x, y, v = rows[index]
        worst = max(worst, math.dist((x, y), (line["x"], line["y"])) - 2 * DT * v)
    return worst


def test_an_event_behind_another_one_follows_it() -> None:
    first = event("FasterEvent", speed_change("20"), at_time("1"))
    second = event("ChangeLane", lane_change(-1), after("FasterEvent"))
    found = imported(document(first + second))
    assert found.report.grade == "exact"
    assert not faults(found)
    lines = [line.strip() for line in found.text.splitlines()]
    start = lines.index("other.change_speed(target: 20mps, rate_profile: constant, duration: 4s)")
    assert lines[start + 1] == "other.change_lane(side: right, duration: 3s)"
    assert "override" not in found.text
    assert apart(found) < 0.1


def test_times_are_an_order() -> None:
    """What the later event would break off ends when that begins."""
    first = event("One", speed_change("25", "10"), at_time("1"))
    second = event("Two", speed_change("10", "2"), at_time("4"))
    found = imported(document(second + first))
    assert not faults(found)
    assert "override" not in found.text
    assert "until elapsed(3s)" in found.text
    assert apart(found) < 0.1


def test_a_known_rest_of_the_time_is_waited_for() -> None:
    first = event("One", speed_change("20", "2"), at_time("1"))
    second = event("Two", speed_change("10", "2"), at_time("6"))
    found = imported(document(first + second))
    assert "wait elapsed(3s)" in found.text
    assert apart(found) < 0.1


def test_several_followers_run_side_by_side() -> None:
    first = event("One", speed_change("20", "2"), at_time("1"))
    second = event("Two", speed_change("10", "2"), after("One"), "parallel")
    third = event("Three", lane_change(-1), after("One", "1"), "parallel")
    found = imported(document(first + second + third))
    assert not faults(found)
    assert "wait elapsed(1s)" in found.text
    assert apart(found) < 0.1


def test_speeds_in_kilometres_per_hour_stay_so() -> None:
    parameter = '<ParameterDeclaration name="Ego_Speed_kph" parameterType="double" value="72"/>'
    found = imported(document("", parameters=parameter, ego_speed="${$Ego_Speed_kph / 3.6}"))
    assert "ego_speed: speed = 72kph" in found.text
    assert "ego.assign_speed(ego_speed)" in found.text
    assert apart(found) < 0.1


def test_a_whole_number_gets_its_unit_where_it_is_used() -> None:
    parameter = '<ParameterDeclaration name="Pace" parameterType="integer" value="20"/>'
    found = imported(document("", parameters=parameter, ego_speed="$Pace"))
    assert not faults(found)
    assert "ego.assign_speed(pace * 1mps)" in found.text
    assert apart(found) < 0.1


NEAR = """<Condition name="near" delay="0" conditionEdge="rising"><ByEntityCondition>
  <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="ego"/>
  </TriggeringEntities>
  <EntityCondition><RelativeDistanceCondition entityRef="other" value="18" freespace="true"
  relativeDistanceType="longitudinal" rule="lessThan"/></EntityCondition>
  </ByEntityCondition></Condition>"""


def test_an_unknown_order_is_an_override() -> None:
    first = event("One", speed_change("25", "10"), NEAR)
    second = event("Two", speed_change("10", "2"), at_time("4"))
    found = imported(document(first + second))
    assert not faults(found)
    assert "override(one, two)" in found.text
    assert apart(found) < 0.1


def test_an_event_in_parallel_ends_nothing_but_what_controls_the_same() -> None:
    first = event("One", lane_change(-1, "6"), NEAR)
    second = event("Two", speed_change("10", "2"), at_time("2.5"), "parallel")
    found = imported(document(first + second))
    assert not faults(found)
    assert "override(two, one)" in found.text
    assert "override(one, two)" not in found.text
    assert apart(found) < 0.1


def test_an_act_that_is_stopped_ends_its_events() -> None:
    """Its end is that of the composition; what waits for its start in it does not wait."""
    started = """<Condition name="c" delay="1" conditionEdge="none"><ByValueCondition>
      <StoryboardElementStateCondition storyboardElementType="act" storyboardElementRef="Act"
      state="runningState"/></ByValueCondition></Condition>"""
    ended = started.replace('delay="1"', 'delay="0"').replace("running", "complete")
    text = document(event("Faster", speed_change("30", "20"), started), end=ended)
    stop = f"<StopTrigger><ConditionGroup>{at_time('5')}</ConditionGroup></StopTrigger></Act>"
    found = imported(text.replace("</Act>", stop))
    assert not faults(found)
    assert "until elapsed(5s)" in found.text
    assert "finished" not in found.text  # the scenario is over with its last action
    assert apart(found) < 0.1


FAST = """<Condition name="fast" delay="1.5" conditionEdge="none"><ByEntityCondition>
  <TriggeringEntities triggeringEntitiesRule="any"><EntityRef entityRef="other"/>
  </TriggeringEntities><EntityCondition><SpeedCondition value="18" rule="greaterThan"/>
  </EntityCondition></ByEntityCondition></Condition>"""


def test_a_delay_beside_a_time_looks_back() -> None:
    """From 3 s on the speed of 1.5 s ago counts: at 1.5 s it is too low, so it is met later."""
    faster = event("Faster", speed_change("20", "2"), at_time("0.5"))
    found = imported(document(faster + event("Back", lane_change(-1), at_time("3") + FAST)))
    text = " ".join(found.text.split())
    assert "wait elapsed(1.5s) wait other.speed > 18mps wait elapsed(1.5s)" in text
    assert not any("delays" in each.reason for each in found.report.findings)
    assert apart(found) < 0.1


def test_a_parameter_that_is_set_in_the_run_is_an_event() -> None:
    parameters = '<ParameterDeclaration name="Go" parameterType="boolean" value="false"/>'
    setting = """<Event name="Set" priority="parallel"><Action name="SetAction"><GlobalAction>
      <ParameterAction parameterRef="Go"><SetAction value="true"/></ParameterAction></GlobalAction>
      </Action><StartTrigger><ConditionGroup>%s</ConditionGroup></StartTrigger></Event>"""
    condition = """<Condition name="go" delay="0" conditionEdge="none"><ByValueCondition>
      <ParameterCondition parameterRef="Go" value="true" rule="equalTo"/></ByValueCondition>
      </Condition>"""
    events = event("Back", lane_change(-1), condition) + setting % at_time("2")
    found = imported(document(events, parameters=parameters))
    assert "emit go" in found.text
    assert apart(found) < 0.1


def test_the_end_of_being_earlier_is_a_time() -> None:
    ending = at_time("4").replace("greaterOrEqual", "lessThan").replace("none", "falling")
    found = imported(document("", end=ending))
    assert "parallel(duration: 4s):" in found.text
    assert apart(found) < 0.1
