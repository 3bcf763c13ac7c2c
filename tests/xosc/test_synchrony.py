"""Synchronized entities: both are at their places at the same time."""

import pytest

from osc2tx.importing.importer import import_document
from osc2tx.importing.libraries import Library
from osc2tx.xosc import read
from osc2tx.xosc.player import BY_THE_STANDARD, Evaluator
from osc2tx.xosc.player.synchrony import Plan, plan
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.opendrive import read_map
from tests.importing.documents import document, event

MASTER, OWN = 300.0, 220.0  # s of the places


def synchronized(final: str, steady: str = "") -> str:
    """Return a document in which `other` meets `ego`, from 130 m on at 15 m/s."""
    speed = f'<FinalSpeed><AbsoluteSpeed value="{final}">{steady}</AbsoluteSpeed></FinalSpeed>'
    action = f"""<SynchronizeAction masterEntityRef="ego">
      <TargetPositionMaster><LanePosition roadId="1" laneId="-3" s="{MASTER}"/>
      </TargetPositionMaster><TargetPosition><LanePosition roadId="1" laneId="-2" s="{OWN}"/>
      </TargetPosition>{speed}</SynchronizeAction>"""
    started = '<Condition name="now" delay="0" conditionEdge="none"><ByValueCondition>'
    started += '<SimulationTimeCondition value="0" rule="greaterOrEqual"/></ByValueCondition>'
    return document(event("Meet", action, started + "</Condition>"))


def distance(found: Plan, v: float, final: float) -> float:
    """Return the metres that a plan makes."""
    way = found.hold * v + found.steady * final
    if found.through is None:
        return way + 0.5 * (v + final) * found.change
    return way + 0.25 * found.change * (v + 2.0 * found.through + final)


@pytest.mark.parametrize(
    ("way", "time", "v", "final", "steady"),
    [
        (10.0, 12.0, 0.0, 2.0, 2.0),  # it stands first
        (100.0, 10.0, 5.0, 15.0, 1.0),
        (90.0, 10.0, 9.0, 9.0, 0.0),
        (60.0, 10.0, 10.0, 10.0, 2.0),  # it slows down on the way
        (150.0, 10.0, 10.0, 12.0, 0.0),
    ],
)
def test_a_plan_makes_the_way_in_time(
    way: float, time: float, v: float, final: float, steady: float
) -> None:
    found = plan(way, time, v, final, steady)
    assert found.hold + found.change + found.steady == pytest.approx(time)
    assert distance(found, v, final) == pytest.approx(way)
    assert found.steady == steady


@pytest.mark.parametrize("final", ["5", "10", "15", "12"])
def test_both_are_there_at_the_same_time(final: str) -> None:
    dt, road_map = 0.02, read_map(find_map("highway.xodr", ()))
    played = Evaluator(read(synchronized(final).encode()), road_map, dt, reading=BY_THE_STANDARD)
    played.play(11.0)
    at = round((MASTER - 100.0) / 20.0 / dt)  # the master drives at 20 m/s
    there = played.track["other"][at]
    start = played.track["other"][0]
    assert there[1] - start[1] == pytest.approx(OWN - 130.0, abs=0.3)
    assert there[3] == pytest.approx(float(final), abs=0.1)


def test_the_import_waits_for_the_master() -> None:
    steady = '<TargetDistanceSteadyState distance="20"/>'
    text = import_document(synchronized("5", steady).encode(), "x", Library(), name="meet").text
    assert "ego.get_s_coord() >= 300m - " in text
    assert "other.change_speed(target: 5mps, rate_profile: constant" in text


def test_a_master_that_drives_backwards() -> None:
    """It comes to its place, 40 m behind it, in 10 s, and the other one to its own."""
    text = synchronized("4").replace('value="20"', 'value="-4"').replace('value="12"', 'value="30"')
    text = text.replace(f's="{MASTER}"', 's="60"')
    dt, road_map = 0.02, read_map(find_map("highway.xodr", ()))
    played = Evaluator(read(text.encode()), road_map, dt, reading=BY_THE_STANDARD)
    played.play(11.0)
    start, there = played.track["other"][0], played.track["other"][round(10.0 / dt)]
    assert there[1] - start[1] == pytest.approx(OWN - 130.0, abs=0.3)
    assert there[3] == pytest.approx(4.0, abs=0.1)
