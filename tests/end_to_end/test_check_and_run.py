"""`check` and `run` say the same about what comes before the first step, on many scenarios.

Each scenario is checked, and then run by `run_scenario` until its first step is done: what the run
refuses before that with a code, the check has found with the same code, message and line, and
nothing else of a run.
"""

from __future__ import annotations

import os
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from osc2tx import ir
from osc2tx.building.jobs import RunTexts, find_jobs
from osc2tx.building.results import check
from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.map_files import named_maps
from osc2tx.compilation.needed_modules import sibling_drafts
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.module_loading import scenarios_of_module
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.running.main import failure
from osc2tx_runtime.running.options import read_options
from osc2tx_shared.classes import replace
from osc2tx_shared.map_files import map_places

ROOT = Path(__file__).parents[2]
Found = set[tuple[str, int | None, str]]


class FirstStepDone(Exception):
    """A run has begun."""


class UntilFirstStep:
    """Ends a run after its first step."""

    def begin(self, context: ExecutionContext) -> None:
        """Nothing has happened yet."""

    def observe(self, step: int) -> None:
        """The first step is done."""
        raise FirstStepDone

    def sampled(self, kind: str, values: object) -> None:
        """Samples do not count."""


def refused_by_run(scenario: type[Scenario], settings: RunSettings) -> Found:
    """Return why a run does not come to the end of its first step."""
    place: str | None
    try:
        result = run_scenario(scenario, settings, keep_trace=False, observer=UntilFirstStep())
    except FirstStepDone:
        return set()
    except ScenarioError as error:
        code, message, place = error.code, error.message, error.source
    else:
        if result.status != "failure":
            return set()
        (code, message), place = failure(scenario.name, result), result.place
    line = (place or "").rpartition(":")[2]
    return {(code, int(line) if line.isdigit() else None, message)}


def compared(path: Path, maps: tuple[Path, ...] = (), dialect: str | None = None) -> int:
    """Compare `check` and `run` on the scenarios of a file; return how many runs there were."""
    (job,) = find_jobs([str(path)], GivenOptions(dialect=dialect), ConfigFiles())
    compilation = job.compilation()
    texts: RunTexts = job.run
    if maps:
        texts = (*texts, ("map-path", tuple(map(str, maps))))
    check(compilation, texts)
    if any(each.code < "OSC8" and each.severity.value == "error" for each in compilation.reports):
        return 0
    found: Found = {
        (each.code, each.primary and each.primary.line, each.message)
        for each in compilation.reports
        if each.code.startswith("OSC8")
    }
    refused: Found = set()
    count = 0
    folders = (path.parent, *maps)
    for scenario, refusals in runs(compilation, dict(texts), folders):
        if names_a_map(scenario, folders):
            count += 1
            refused |= refusals
        else:  # on other maps a run may begin
            refused |= {each for each in refusals if "no installed package" in each[2]}
    lines = {(code, message): line for code, line, message in found}
    assert {(code, message) for code, _, message in refused} == lines.keys(), path
    for code, line, message in refused:
        assert line in (None, lines[code, message]), (path, code, message)
    return count


def runs(
    compilation: Compilation, texts: dict[str, Any], folders: tuple[Path, ...]
) -> Iterator[tuple[ir.Scenario, Found]]:
    """Yield the scenarios of a file that can run, with what their runs refuse."""
    module = compilation.draft
    if module is None or compilation.ir is None:
        return
    settings = replace(read_options(texts, is_trusted=True), map_path=folders)
    with scenarios_of_module(module, sibling_drafts(compilation)) as classes:
        for scenario in compilation.ir.scenarios:
            if scenario.is_runnable and scenario.name in classes:
                yield scenario, refused_by_run(classes[scenario.name], settings)


def names_a_map(scenario: ir.Scenario, folders: tuple[Path, ...]) -> bool:
    """Whether a scenario names maps that are there."""
    names = [each.name for each in named_maps(scenario)]
    found = [any(place.is_file() for place in map_places(name, folders)) for name in names]
    return bool(found) and all(found)


# --- variants ---

HEAD = """import osc.standard.all
namespace null use std, stdtypes
scenario top:
    road: map with:
        keep(it.map_file == "{map}.xodr")
    ego: vehicle
    npc: vehicle
    third: vehicle
    {open}
    do {how}:
"""
MAPS = ("highway", "highway", "curve", "merge", "urban_crossing")
HOW = ("serial", "parallel", "parallel(duration: 3s)", "serial(duration: 5s)", "one_of")
OPEN = ("d: time", *("d: time with:\n        keep(it in [1s..2s])",) * 5)
LIMITS = ("", "", "duration: 1s", "duration: 2s", "duration: [1s..3s]", "duration: d")
AT = ("", ", at: start", ", at: start", ", at: end")
MODIFIERS = {
    "speed": ("5mps", "20mps", "[5mps..15mps]", "400kph", "1mps, faster_than: {ref}"),
    "lane": ("1", "3", "5", "[1..2]", "same_as: {ref}", "side_of: {ref}, side: left"),
    "position": (
        "10m",
        "50m",
        "5000m",
        "[10m..60m]",
        "20m, ahead_of: {ref}",
        "5m, behind: {ref}",
        "time: 3s, ahead_of: {ref}",
    ),
    "lateral": ("0.5m", "5m"),
    "acceleration": ("1mpss", "[1mpss..3mpss]", "30mpss"),
    "distance": ("20m", "9000m"),
}
SHARES = {"speed": 0.6, "lane": 0.6, "position": 0.6}
OTHERS = (
    "{who}.change_speed(target: 20mps, rate_profile: constant, rate_peak: 2mpss)",
    "{who}.change_speed(target: 500mps)",
    "{who}.change_speed(target: 5mps, duration: 2s)",
    "{who}.change_lane(num_of_lanes: 1, side: left, duration: 3s)",
    "{who}.change_lane(num_of_lanes: 4, side: right)",
    "{who}.change_space_gap(target: 20m, direction: ahead, reference: {ref})",
    "{who}.keep_speed({limit})",
    "{who}.assign_speed(300mps)",
    "wait elapsed(1s)",
    "wait elapsed(d)",
)


def variant(seed: int) -> str:
    """Return a scenario: durations, places, lanes, gaps, speeds and references from the tables."""
    draw = random.Random(seed)
    text = HEAD.format(map=draw.choice(MAPS), open=draw.choice(OPEN), how=draw.choice(HOW))
    for _ in range(draw.choice((1, 2, 2, 3))):
        if draw.random() < 0.25:
            text += "        parallel:\n"
            text += "".join(member(who, draw, 12) for who in ("ego", "npc"))
        else:
            text += member(draw.choice(("ego", "npc", "third")), draw, 8)
    return text


def member(who: str, draw: random.Random, indent: int) -> str:
    """Return an action with its modifiers."""
    ref = draw.choice([each for each in ("ego", "npc", "third") if each != who])
    words = {"who": who, "ref": ref, "limit": draw.choice(LIMITS)}
    blank = " " * indent
    if draw.random() < 0.35:
        return f"{blank}{draw.choice(OTHERS).format(**words)}\n"
    lines = [
        f"{name}({draw.choice(values).format(**words)}{draw.choice(AT)})"
        for name, values in MODIFIERS.items()
        if draw.random() < SHARES.get(name, 0.08)
    ]
    head = f"{blank}{who}.drive({words['limit']})"
    return "\n".join([f"{head} with:" if lines else head, *(f"{blank}    {e}" for e in lines), ""])


def compare_variants(seeds: range, folder: Path) -> int:
    """Compare `check` and `run` on variants; return how many runs there were."""
    count = 0
    for seed in seeds:
        path = folder / f"variant_{seed}.osc"
        path.write_text(variant(seed), encoding="utf-8")
        count += compared(path)
    return count


def test_variants(tmp_path: Path) -> None:
    assert compare_variants(range(30), tmp_path) > 8


@pytest.mark.slow
def test_many_variants(tmp_path: Path) -> None:
    assert compare_variants(range(30, 400), tmp_path) > 100


@pytest.mark.slow
def test_scenarios_of_the_project() -> None:
    assert sum(map(compared, sorted((ROOT / "scenarios").rglob("*.osc")))) > 80


@pytest.mark.slow
def test_scenarios_of_others() -> None:
    data = os.environ.get("OSC2TX_TEST_DATA")
    if data is None:
        pytest.skip("OSC2TX_TEST_DATA names no folder")
    folders = [each for each in Path(data, "maps").iterdir() if each.is_dir()]
    maps = tuple(sorted(folders))
    files = sorted(Path(data, "defects").rglob("*.osc"))
    assert sum(compared(each, maps) for each in files) > 30
    files = sorted(Path(data, "corpus").rglob("*.osc"))
    assert sum(compared(each, maps, "carla") for each in files) > 5
