"""The scenarios of the repository on our own maps: what they claim shows in the trace."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.report.trace_reader import read_run
from tests.end_to_end.harness import (
    SCENARIOS,
    Trace,
    compile_scenario,
    generate,
    permuted_module,
    run,
)
from tests.runtime.world.motion_scan import impossible

Load = Callable[[GeneratedModule], type[Scenario]]
OWN = ["cut_in", "cut_in_and_evade", "follow_leader", "pedestrian_crossing"]


@pytest.fixture(scope="module")
def run_named(load: Load) -> Callable[..., Trace]:
    """Run a scenario by its name, each once with the same settings."""

    done: dict[tuple[str, str], Trace] = {}

    def run_one(name: str, **settings: object) -> Trace:
        given = RunSettings(**settings)  # type: ignore[arg-type]
        key = name, repr(given)
        if key not in done:
            done[key] = run(load(generate(SCENARIOS / f"{name}.osc")), given)
        return done[key]

    return run_one


@pytest.mark.parametrize("name", OWN)
def test_it_succeeds_without_collision(run_named: Callable[..., Trace], name: str) -> None:
    trace = run_named(name)
    assert trace.status == "success"
    assert trace.of_kind("collision") == []
    assert impossible(trace.lines, smoothing=0.0) == set()
    assert read_run(trace.text.splitlines()).skipped == 0  # the report knows every line


@pytest.mark.parametrize("name", OWN)
def test_repetition_and_permutation_change_nothing(load: Load, name: str) -> None:
    module = compile_scenario(SCENARIOS / f"{name}.osc")
    first = run(load(emit(module)))
    assert run(load(emit(module))).text == first.text
    assert run(load(permuted_module(module))).ordered == first.ordered


@pytest.mark.parametrize("name", OWN)
def test_story(name: str, run_named: Callable[..., Trace], golden: Callable[..., None]) -> None:
    """Events and actions in order, as golden text: the end-to-end stage."""
    story = []
    for line in run_named(name).lines:
        if line["kind"] == "event":
            story.append(f"{line['t']:7.2f}  event {line['name']}")
        elif line["kind"] == "action":
            story.append(f"{line['t']:7.2f}  {line['name']} {line['status']} {line['source']}")
        elif line["kind"] == "result":
            story.append(f"result {line['status']} after {line['steps']} steps")
    folder = Path(__file__).parent.parent / "golden" / "end_to_end" / name
    golden("\n".join(story) + "\n", folder / "expected" / "story.txt")


def test_cut_in_speed_is_drawn_from_the_seed(run_named: Callable[..., Trace]) -> None:
    speeds = [run_named("cut_in", seed=seed).state("other", 1.0)["v"] for seed in range(4)]
    assert len(set(speeds)) == 4
    assert all(80 / 3.6 <= v <= 95 / 3.6 for v in speeds)
    assert run_named("cut_in", set={"v_other": 25.0}).state("other", 1.0)["v"] == 25.0


def test_cut_in_happens_at_the_gap(run_named: Callable[..., Trace]) -> None:
    trace = run_named("cut_in")
    (start,) = [
        line["t"]
        for line in trace.of_kind("action")
        if line["name"] == "other change_lane" and line["status"] == "start"
    ]
    sizes = trace.of_kind("header")[0]["actors"]
    ego, other = trace.state("ego", start), trace.state("other", start)
    front = ego["s"] + sizes["ego"]["length"] - sizes["ego"]["rear"]
    gap = other["s"] - sizes["other"]["rear"] - front
    assert 8.0 < gap <= 8.0 + 0.05 * (other["v"] - ego["v"]) + 1e-6


def test_follower_keeps_its_gap(run_named: Callable[..., Trace]) -> None:
    trace = run_named("follow_leader")
    gaps = [
        leader["s"] - follower["s"]
        for leader, follower in zip(trace.states("leader"), trace.states("follower"), strict=True)
    ]
    assert gaps[0] == pytest.approx(25.0)
    assert all(abs(gap - 25.0) < 2.0 for gap in gaps)
    assert min(line["v"] for line in trace.states("leader")) == pytest.approx(30 / 3.6)


def test_pedestrian_walks_straight_across_in_front_of_a_standing_car(
    run_named: Callable[..., Trace],
) -> None:
    trace = run_named("pedestrian_crossing")
    walker = trace.states("walker")
    assert {line["x"] for line in walker} == {250.0}
    assert walker[0]["y"] == -5.0
    walked = [line["t"] for line in trace.of_kind("action") if line["name"] == "walker walk"]
    # 8 s at 1.4 m/s, less what is lost while a person speeds up: by 0.75 m/s^2, jerk 10 m/s^3
    way = 8.0 * 1.4 - 1.4 / 2 * (1.4 / 0.75 + 0.75 / 10.0)
    assert walked[1] - walked[0] == pytest.approx(8.0)
    assert trace.state("walker", walked[1])["y"] == pytest.approx(-5.0 + way, abs=1e-4)
    in_lane = [line["t"] for line in walker if -3.5 < line["y"] < 0.0]
    sizes = trace.of_kind("header")[0]["actors"]["ego"]
    for t in in_lane:
        ego = trace.state("ego", t)
        assert ego["x"] + sizes["length"] - sizes["rear"] < 250.0
