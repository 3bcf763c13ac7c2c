"""`keep(default …)` in a type is the default of its class; objects state what differs."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import asam

Load = Callable[[GeneratedModule], type[Scenario]]

SCENARIO = """import osc.standard.all

namespace null use std, stdtypes

struct profile:
    # How hard
    hardness: acceleration with:
        keep(default it == 3mpsps)
    grip: float = 0.2
    # Of dry asphalt
    keep(default grip == 0.5)
    margin: length = 2m
    doubled: length
    keep(default doubled == 2 * margin)
    keep(hardness < 9mpsps)

actor probe inherits vehicle:
    limit: speed with:
        keep(default it == 12mps)
    label: string
    keep(default label == "x")

actor fast_probe inherits probe:
    keep(default limit == 20mps)

extend fast_probe:
    bonus: float with:
        keep(default it == 1.5)

scenario class_defaults:
    road: map with:
        keep(it.map_file == "highway.xodr")
    plain: profile
    given: profile with:
        keep(it.grip == 0.7)
    ego: probe
    fast: fast_probe
    slow: probe with:
        keep(default it.limit == 9mps)
    open_: probe with:
        remove_default(it.limit)
        keep(it.limit in [3mps..4mps])
    do ego.drive(duration: 1s) with:
        lane(1, at: start)
        position(10m, at: start)
        speed(ego.limit)
"""


def test_defaults_of_classes(load: Load, tmp_path: Path) -> None:
    made = emit(asam(SCENARIO, tmp_path))
    scenario = load(made)()
    values = vars(scenario)
    plain, given = values["plain"], values["given"]
    assert (plain.hardness, plain.grip, plain.margin, plain.doubled) == (3.0, 0.5, 2.0, 4.0)
    assert (given.hardness, given.grip) == (3.0, 0.7)
    limits = {name: values[name].limit for name in ("ego", "fast", "slow")}
    assert limits == {"ego": 12.0, "fast": 20.0, "slow": 9.0}
    assert 3.0 <= values["open_"].limit <= 4.0
    assert (values["fast"].label, values["fast"].bonus) == ("x", 1.5)
    own = inspect.signature(type(values["ego"])).parameters
    assert (own["limit"].default, own["label"].default) == (12.0, "x")
    assert type(plain)(doubled=1.0).grip == 0.5


@pytest.mark.parametrize(
    "line",
    [
        "    hardness: Acceleration = 3 * mpsps\n",
        "    # Of dry asphalt\n    grip: float = 0.5\n",
        "Probe()",
        "Probe(limit=9 * mps)",
        "FastProbe(limit=20 * mps)",
        "Profile(doubled=2 * (2 * m))",
    ],
)
def test_the_module_states_them_once(line: str, tmp_path: Path) -> None:
    assert line in emit(asam(SCENARIO, tmp_path)).python
