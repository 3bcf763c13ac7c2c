"""What every run keeps to, from the text of a scenario to its trace.

Time is that of the scenario and not of the host; a choice is the seed's; members of a `parallel`
have no order; the same run has the same trace in every process; trees are as deep as the source.
"""

from __future__ import annotations

import ast
import os
import random
import subprocess
import sys
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from osc2tx import ir
from osc2tx.backends.py_trees.emitter import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, run_scenario
from osc2tx_runtime.errors import ScenarioError
from tests.capabilities.conftest import Load
from tests.capabilities.conftest import load as load  # the fixture
from tests.end_to_end.harness import REPOSITORY, asam, permuted_module, run
from tests.traces import whatever_the_order

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario acceptance:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    npc: vehicle
    event a
    event b
    event c

    do parallel:
        hold_ego: serial:
            ego.drive(duration: 0.5s) with:
                lane(2, at: start)
                position(50m, at: start)
                speed(10mps)
        hold_npc: serial:
            npc.drive(duration: 0.5s) with:
                lane(3, at: start)
                position(60m, at: start)
                speed(12mps)
"""


def compiled(body: str, folder: Path, load: Load) -> type[Scenario]:
    return load(emit(asam(HEAD + body, folder)))


# --- time ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("pause", [0.0, 0.02])
def test_five_seconds_are_a_hundred_steps_however_slow_the_host_is(
    pause: float, load: Load, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_clock(*_: object) -> float:
        raise AssertionError("a run has no business with the clock of the host")

    scenario = compiled("        wait elapsed(5s)\n", tmp_path, load)
    sleep = time.sleep
    for name in ("time", "monotonic", "perf_counter"):
        monkeypatch.setattr(time, name, no_clock)
    result = run_scenario(scenario, RunSettings(), lambda *_: sleep(pause))
    assert (result.status, result.steps, result.time) == ("success", 100, 5.0)


ALLOWED = {"osc2tx_runtime", "collections", "dataclasses", "enum", "typing"}


def test_generated_modules_import_the_runtime_and_nothing_else() -> None:
    """So none has a clock, a timer of py_trees, or a generator of its own."""
    modules = sorted((REPOSITORY / "generated").rglob("*.py"))
    assert len(modules) > 50
    own = {path.stem for path in modules}
    for path in modules:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                top = (node.module or "").partition(".")[0]
                assert top in own or top in ALLOWED, path
            elif isinstance(node, ast.Import):
                raise AssertionError(f"{path} imports {node.names[0].name}")


# --- choices -------------------------------------------------------------------------------------

CHOICE = """        one_of:
            serial:
                wait elapsed(1s)
                emit a
            serial:
                wait elapsed(2s)
                emit b
            serial:
                wait elapsed(3s)
                emit c
"""


def chosen(scenario: type[Scenario], seed: int) -> list[str]:
    trace = run(scenario, RunSettings(seed=seed))
    assert trace.status == "success"
    return [line["name"] for line in trace.lines if line["kind"] == "event"]


@pytest.mark.slow
def test_a_seeded_choice_is_one_alternative_and_each_has_its_seeds(
    load: Load, tmp_path: Path
) -> None:
    path = tmp_path / "case.osc"
    path.write_text(HEAD + CHOICE, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions(one_of="seeded"))
    assert compilation.ir is not None
    scenario = load(emit(compilation.ir))
    choices = [chosen(scenario, seed) for seed in range(40)]
    assert choices == [chosen(scenario, seed) for seed in range(40)]
    counts = Counter(name for choice in choices for name in choice)
    assert all(len(choice) == 1 for choice in choices)
    # 13 of 40 each on average
    assert set(counts) == {"a", "b", "c"} and min(counts.values()) >= 4


def test_a_race_is_won_by_the_first_whatever_the_seed(load: Load, tmp_path: Path) -> None:
    scenario = compiled(CHOICE, tmp_path, load)
    assert {tuple(chosen(scenario, seed)) for seed in range(5)} == {("a",)}


# --- order ---------------------------------------------------------------------------------------

leaves = st.sampled_from(
    [
        "emit a",
        "emit b",
        "wait @a",
        "wait @b",
        "wait elapsed(0.2s)",
        "wait elapsed(0.35s)",
        "wait rise(ego.speed > 11mps)",
        "wait npc.speed < 11mps",
        "ego.change_speed(target: 13mps, rate_profile: constant)",
        "npc.change_speed(target: 9mps)",
        "ego.change_lane(num_of_lanes: 1, side: left)",
        "npc.change_lane(num_of_lanes: 1, side: right)",
        "ego.drive(duration: 0.4s) with:\n    speed(2mps, faster_than: npc)",
        "npc.drive(duration: [0.2s..2s]) with:\n    until @c",
        "ego.change_space_gap(target: 30m, direction: behind, reference: npc, duration: [0s..3s])",
    ]
)


def indented(text: str, by: int) -> str:
    return "".join(f"{' ' * by}{line}\n" for line in text.splitlines())


def block(kind: str, members: list[str]) -> str:
    return f"{kind}:\n" + "".join(indented(member, 4) for member in members)


trees = st.recursive(
    leaves,
    lambda inner: st.builds(
        block,
        st.sampled_from(["serial", "parallel", "parallel", "one_of"]),
        st.lists(inner, min_size=2, max_size=3),
    ),
    max_leaves=8,
)


def shuffled(node: ir.Behavior, draw: random.Random) -> ir.Behavior:
    """The tree with the members of parallels and races in another order."""
    if not isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
        return node
    members = [shuffled(member, draw) for member in node.members]
    if not isinstance(node, ir.Serial):
        draw.shuffle(members)
    return replace(node, members=tuple(members))


def outcome(scenario: type[Scenario]) -> str:
    """The trace, or the error that the run meets."""
    try:
        result = run_scenario(scenario, RunSettings(max_time=4.0, signal={"c": 1.5}))
    except ScenarioError as error:
        return f"{type(error).__name__}: {error}"
    return "\n".join(whatever_the_order(result.trace_lines))


@pytest.mark.slow
@settings(max_examples=60)
@given(trees, st.integers(0, 2**16))
def test_the_members_of_a_written_parallel_have_no_order(
    load: Load, tmp_path: Path, text: str, seed: int
) -> None:
    # Nodes that are alike are numbered in the order of the text: names, not behavior, would differ.
    leaves_of_tree = [line.strip() for line in text.splitlines() if not line.endswith(":")]
    assume(len(set(leaves_of_tree)) == len(leaves_of_tree))
    after = "        after: serial:\n            wait elapsed(0.5s)\n" + indented(text, 12)
    module = asam(HEAD + after + "        wait @c\n", tmp_path)
    first = outcome(load(emit(module)))
    draw = random.Random(seed)
    scenarios = tuple(replace(s, body=shuffled(s.body, draw)) for s in module.scenarios)
    assert outcome(load(emit(replace(module, scenarios=scenarios)))) == first
    assert outcome(load(permuted_module(module))) == first


# --- the same in every process -------------------------------------------------------------------


RUN_EACH = """
import sys
from pathlib import Path
from osc2tx.cli import main
folder, *paths = map(Path, sys.argv[1:])
for path in paths:
    try:
        main(["run", str(path), "--trace", str(folder / f"{path.stem}.jsonl")])
    except SystemExit as ended:
        assert ended.code in (0, 5), (path, ended.code)
"""


@pytest.mark.slow
def test_runs_are_the_same_in_every_process(tmp_path: Path) -> None:
    """All scenarios that need nothing from outside, under two hash seeds."""
    names = sorted((REPOSITORY / "scenarios" / "capabilities").glob("*.osc"))
    folders = []
    for seed in ("1", "77"):
        folder = tmp_path / seed
        folder.mkdir()
        folders.append(folder)
        done = subprocess.run(
            [sys.executable, "-c", RUN_EACH, str(folder), *map(str, names[::4])],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
    first, second = ({p.name: p.read_bytes() for p in folder.iterdir()} for folder in folders)
    assert first == second
    assert len(first) > 10


# --- shape ---------------------------------------------------------------------------------------


def depth(node: object) -> int:
    return 1 + max((depth(child) for child in getattr(node, "children", ())), default=0)


def test_trees_are_as_deep_as_the_source(load: Load, tmp_path: Path) -> None:
    """Blocks in blocks, each with two members: one level of the tree for each of the text."""
    base = None
    for levels in (1, 5, 20):
        text = "wait elapsed(0.1s)"
        for level in range(levels):
            text = block(("serial", "parallel", "one_of")[level % 3], ["wait elapsed(1s)", text])
        scenario = compiled(indented(text, 8), tmp_path, load)
        extra = depth(scenario(RunSettings()).create_tree()) - levels
        base = extra if base is None else base
        assert extra <= base
