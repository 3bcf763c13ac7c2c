"""What reacts and what is chosen, measured in the trace: every, sample, on, events, one_of."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx import ir
from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, OneOfPolicy
from osc2tx_runtime import RunSettings, Scenario, ScenarioError
from tests.end_to_end.harness import Trace, run

Load = Callable[[GeneratedModule], type[Scenario]]
Drive = Callable[..., Trace]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario reacts:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
"""
STEP = 0.05  # s; an event of a condition comes in the step at which it became true


def compiled(text: str, folder: Path, options: CompileOptions | None = None) -> ir.Module:
    path = folder / "case.osc"
    path.write_text(text, encoding="utf-8")
    compilation = Compilation(path, path.name, options or CompileOptions())
    assert compilation.ir is not None, compilation.diagnostics
    return compilation.ir


@pytest.fixture
def drive(load: Load, tmp_path: Path) -> Drive:
    """Run a scenario of some members."""

    def run_one(members: str, one_of: OneOfPolicy = "race", **settings: object) -> Trace:
        body = "".join(f"    {line}\n" for line in members.strip().splitlines())
        module = compiled(HEAD + body, tmp_path, CompileOptions(one_of=one_of))
        return run(load(emit(module)), RunSettings(**settings))  # type: ignore[arg-type]

    return run_one


def times(trace: Trace, event: str) -> list[float]:
    return [float(line["t"]) for line in trace.of_kind("event") if line["name"] == event]


def test_every_comes_at_each_multiple_of_its_period(drive: Drive) -> None:
    trace = drive("""
event tick
on every(1s, offset: 0.5s):
    emit tick
do ego.drive(duration: 3.8s) with:
    speed(10mps)
""")
    assert times(trace, "tick") == pytest.approx([0.5, 1.5, 2.5, 3.5], abs=STEP)


def test_a_sample_is_taken_at_its_event_and_kept(drive: Drive) -> None:
    """It accelerates by 2 m/s²: at 3 s it has 6 m/s, and that it still has in the variable."""
    trace = drive("""
event look
event late
var seen: speed = sample(ego.speed, @look, 0mps)
do parallel:
    ego.change_speed(target: 20mps, rate_profile: constant, rate_peak: 2mpsps, duration: 10s)
    serial:
        wait elapsed(3s)
        emit look
        wait seen > 1mps and ego.speed > seen + 4mps
        emit late
with:
    until @late
""")
    (line,) = [line for line in trace.of_kind("variable") if line["t"] > 0.0]
    assert line["value"] == pytest.approx(6.0, abs=2.0 * STEP)
    assert times(trace, "late") == pytest.approx([5.0], abs=3.0 * STEP)


def test_on_takes_the_values_of_each_occurrence(drive: Drive) -> None:
    trace = drive("""
event near(gap: length, limit: length = 10m)
event close
event far
on @near as n if n.gap < n.limit:
    emit close
on @near as n if n.gap >= n.limit:
    emit far
do serial:
    wait elapsed(1s)
    emit near(gap: 12m)
    wait elapsed(1s)
    emit near(gap: 12m, limit: 20m)
    wait elapsed(1s)
    emit near(gap: 5m)
    wait elapsed(1s)
""")
    assert times(trace, "far") == pytest.approx([1.0], abs=STEP)
    assert times(trace, "close") == pytest.approx([2.0, 3.0], abs=2.0 * STEP)


def test_an_event_counts_only_where_its_condition_holds(drive: Drive) -> None:
    trace = drive("""
event go
event gone
on every(1s):
    emit go
do parallel:
    ego.change_speed(target: 20mps, rate_profile: constant, rate_peak: 2mpsps, duration: 10s)
    serial:
        wait @go if ego.speed > 5mps
        emit gone
with:
    until @gone
""")
    assert times(trace, "gone") == pytest.approx([3.0], abs=2.0 * STEP)


ALTERNATIVES = """
event slow
event fast
do one_of:
    serial:
        wait elapsed(3s)
        emit slow
    serial:
        wait elapsed(1s)
        emit fast
"""


def test_one_of_as_a_race_ends_with_the_first_to_finish(drive: Drive) -> None:
    trace = drive(ALTERNATIVES)
    assert (len(times(trace, "slow")), len(times(trace, "fast"))) == (0, 1)


def test_one_of_first_takes_the_first_in_the_text(drive: Drive) -> None:
    trace = drive(ALTERNATIVES, one_of="first")
    assert times(trace, "slow") == pytest.approx([3.0], abs=2.0 * STEP)
    assert times(trace, "fast") == []


def test_one_of_seeded_takes_one_by_the_seed(drive: Drive) -> None:
    def chosen(seed: int) -> str:
        trace = drive(ALTERNATIVES, one_of="seeded", seed=seed)
        (choice,) = trace.of_kind("choice")
        happened = [name for name in ("slow", "fast") if times(trace, name)]
        assert len(happened) == 1
        assert choice["policy"] == "seeded"
        return happened[0]

    found = [chosen(seed) for seed in range(8)]
    assert set(found) == {"slow", "fast"}
    assert found == [chosen(seed) for seed in range(8)]


def test_a_conditional_subtype_is_told_by_its_member(load: Load, tmp_path: Path) -> None:
    lorry = "actor lorry inherits vehicle(vehicle_category == truck)\n\nscenario"
    text = HEAD.replace("scenario", lorry) + (
        "    event big\n"
        "    do serial:\n"
        "        wait elapsed(1s)\n"
        "        wait ego.is(lorry)\n"
        "        emit big\n"
    )
    fixed = text.replace(
        "ego: vehicle", "ego: vehicle with:\n        keep(it.vehicle_category == V)"
    )
    truck = load(emit(compiled(fixed.replace("== V", "== truck"), tmp_path)))
    assert times(run(truck), "big") == pytest.approx([1.0], abs=STEP)
    car = load(emit(compiled(fixed.replace("== V", "== car"), tmp_path)))
    assert times(run(car, RunSettings(max_time=2.0)), "big") == []
    unsaid = load(emit(compiled(text, tmp_path)))
    with pytest.raises(ScenarioError, match="the vehicle_category of ego is not stated"):
        run(unsaid)


def test_members_of_two_actors_are_related(drive: Drive) -> None:
    """Colours are drawn from the seed, and drawn again until they differ."""
    members = """
npc: vehicle
keep(ego.color in [red, green])
keep(npc.color in [red, green])
keep(ego.color != npc.color)
do ego.drive(duration: 0.1s)
"""
    for seed in range(6):
        (header,) = drive(members, seed=seed).of_kind("header")
        drawn = header["parameters"]
        assert {drawn["ego.color"], drawn["npc.color"]} == {"green", "red"}


CARLA = """import basic.osc

scenario top:
    path: Path
    path.set_map("highway")
    path.path_min_driving_lanes(LANES)
    path.path_length(100m)
    npc: Model3
    ego_vehicle: Rubicon

    do parallel(duration: 2s):
        npc.drive(path) with:
            speed(30kph)
            lane(2, at: start)
        ego_vehicle.drive(path) with:
            speed(30kph)
            lane(same_as: npc, at: start)
            position(15m, behind: npc, at: start)
"""


def test_a_path_of_carla_is_a_road_with_room(load: Load, tmp_path: Path) -> None:
    options = CompileOptions(dialect="carla")
    three = load(emit(compiled(CARLA.replace("LANES", "3"), tmp_path, options)))
    trace = run(three)
    assert trace.status == "success"
    npc, ego = trace.state("npc", 0.0), trace.state("ego_vehicle", 0.0)
    assert (npc["road"], npc["lane"]) == (ego["road"], ego["lane"])
    assert npc["v"] == pytest.approx(30 / 3.6)
    nine = load(emit(compiled(CARLA.replace("LANES", "9"), tmp_path, options)))
    with pytest.raises(ScenarioError, match="at least 9 lanes") as refused:
        run(nine)
    assert refused.value.source == "case.osc:4"


def test_a_path_through_labels_of_compositions(drive: Drive) -> None:
    trace = drive("""
event inner
event outer
do parallel:
    a: serial:
        b: serial:
            c: wait elapsed(1s)
        wait elapsed(1s)
    serial:
        wait @a.b.c.end
        emit inner
        wait @a.end
        emit outer
""")
    events = [(line["t"], line["name"]) for line in trace.of_kind("event")]
    assert events == [(1.0, "c.end"), (1.0, "inner"), (2.0, "a.end"), (2.0, "outer")]
