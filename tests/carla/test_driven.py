"""Pedals and steering: the same story as in the embedded world, at nearly the same times."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from osc2tx_runtime import RunResult

from .runs import GENERATED, happenings, in_carla, in_the_world, modules, run_all, settings_for
from .stand_in.process import StandInProcess

pytestmark = pytest.mark.slow

SOON = 0.2  # s
LATE = {
    "C13_time_gap": 0.6,  # a gap is reached when its speed is, too
    "C15_headway": 0.4,  # so, too
    "C17_behavioral_model": 0.6,  # brakes make the last few cm/s of a stop longer
    "C23_physical_movement": 2.2,  # a speed that may jump is reached with pedals
    "C32_motion_readings": 0.6,  # what is measured brakes a little after what is commanded
}
"""Modules that are later, the seconds that they may be, and why."""

MODULES = modules()


def test_few_are_late() -> None:
    assert len(LATE) <= 0.1 * len(MODULES)


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.relative_to(GENERATED).stem)
def test_all_modules_tell_the_same_story(module: Path, towns: StandInProcess) -> None:
    """Verdict, contacts, and all events, begins and ends of actions, in the same order."""
    here = in_the_world(module)
    driven = in_carla(settings_for(module), towns.port, control={"": "driven"})
    there = run_all(module, driven)
    for name, expected in here.items():
        found = there[name]
        if isinstance(expected, str) or isinstance(found, str):
            assert found == expected
        else:
            compare(expected, found, LATE.get(module.stem, SOON))
    assert towns.ask("stand_in_actors") == {}
    assert towns.ask("stand_in_unknown") == {}


def compare(expected: RunResult, found: RunResult, soon: float) -> None:
    """Compare two runs."""
    assert (found.status, found.reason) == (expected.status, expected.reason)
    before, after = happenings(expected), happenings(found)
    assert [what for what, _ in after] == [what for what, _ in before]
    late = max((abs(b - a) for (_, a), (_, b) in zip(before, after, strict=True)), default=0.0)
    assert late <= soon + 1e-9


def test_hello_world_twice(towns: StandInProcess) -> None:
    """The case study: no contact, and the same trace to the byte."""
    module = GENERATED / "hello_world.py"
    if module not in MODULES:
        pytest.skip("no test data with the town")
    settings = in_carla(settings_for(module), towns.port, control={"": "driven"})
    (one,), (other,) = run_all(module, settings).values(), run_all(module, settings).values()
    assert isinstance(one, RunResult) and isinstance(other, RunResult)
    assert one.trace_lines == other.trace_lines
    assert one.collisions == () and one.status == "success"
    header = json.loads(one.trace_lines[0])
    assert header["world"] == "carla 0.9.16"
    assert header["control"] == {"hero": "driven", "npc": "driven", "obstacle": "exact"}
