"""`osc2tx verify`: a finished trace is judged as the run was."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from osc2tx.testing import run_scenario as perform
from tests.unit.cli.shell import Shell

CAPABILITIES = Path(__file__).parents[3] / "scenarios" / "capabilities"
# One scenario for each kind of condition that a capability does not meet all the time.
NAMES = (
    *("C08_stationary", "C11_follow_path", "C12_along_trajectory", "C13_time_gap"),
    *("C17_careful_crossing", "C19_speed_modifier", "C22_lateral_modifier", "C34_override"),
)

NEVER = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(10mps)
        ego.drive(duration: 1s) with:
            speed(20mps)
            physical_movement(must_be_physical)
"""


def keys(violation: dict[str, Any]) -> tuple[Any, ...]:
    names = ("source", "modifier", "at", "severity", "first", "last")
    return tuple(violation[name] for name in names)


@pytest.mark.parametrize("name", NAMES)
def test_it_finds_what_the_run_found(name: str, tmp_path: Path, shell: Shell) -> None:
    source, trace = CAPABILITIES / f"{name}.osc", tmp_path / "run.jsonl"
    run = perform(source, trace=trace)
    done = shell("verify", trace, source, "--form", "json")
    found = json.loads(done.out)["violations"]
    assert sorted(map(keys, found)) == sorted(map(keys, run.of_kind("violation")))
    assert done.code == 0


OVERRIDDEN = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do parallel:
        slow: ego.drive(duration: 3s) with:
            lane(1, at: start)
            position(100m, at: start)
            speed(10mps, at: start)
            lane(2, at: end)
        serial:
            wait elapsed(1s)
            quick: ego.change_speed(15mps)
    with:
        override(slow, quick)
"""


def test_what_is_overridden_is_not_judged(tmp_path: Path, shell: Shell) -> None:
    """Neither in the run nor from its trace: after 1 s of 3 s it is still in lane 1."""
    source, trace = shell.write("overridden.osc", OVERRIDDEN), tmp_path / "run.jsonl"
    assert shell("run", source, "--trace", trace).code == 0
    verified = shell("verify", trace)
    assert (verified.code, verified.out) == (0, "top: success: 2 phases, 0 failures, 0 warnings\n")


def test_a_failure_has_exit_code_5(tmp_path: Path, shell: Shell) -> None:
    source, trace = shell.write("never.osc", NEVER), tmp_path / "run.jsonl"
    ended = shell("run", source, "--trace", trace)
    assert ended.code == 5
    assert "error[OSC810]: top: failure after 2.00 s" in ended.out
    verified = shell("verify", trace)  # its scenario is beside it
    assert verified.code == 5
    assert "never.osc:15:13: error[OSC810]: ego drive: `speed` does not hold" in verified.out
    assert verified.out.endswith("top: failure: 2 phases, 1 failure, 0 warnings\n")


def test_a_trace_of_another_scenario_is_refused(tmp_path: Path, shell: Shell) -> None:
    source, trace = shell.write("never.osc", NEVER), tmp_path / "run.jsonl"
    shell("run", source, "--trace", trace)
    other = shell.write("other.osc", NEVER.replace("speed(20mps)", "speed(30mps)"))
    refused = shell("verify", trace, other)
    assert refused.code == 4
    assert "its tree differs" in refused.err


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"kind":"header","dt":0.05}', "x"])
def test_what_is_no_trace_is_refused(text: str, shell: Shell) -> None:
    refused = shell("verify", shell.write("run.jsonl", text))
    assert refused.code == 4
    assert "cannot be read" in refused.err
