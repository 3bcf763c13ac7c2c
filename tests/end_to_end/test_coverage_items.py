"""Coverage items are sampled at their events, in their units and slices."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario sampled:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    event tick is every(500ms, offset: 500ms)
    event twice(v: speed)
"""
BODY = """    do ego.change_speed(target: 36kph, rate_profile: constant, duration: 2s) with:
        speed(0kph, at: start)
"""


@pytest.fixture
def sampled(load: Load, tmp_path: Path) -> Callable[..., Trace]:
    def run_one(items: str, body: str = BODY) -> Trace:
        lines = "".join(f"    {line}\n" for line in items.strip().splitlines())
        return run(load(emit(asam(HEAD + lines + body, tmp_path))))

    return run_one


def rows(trace: Trace, kind: str = "cover") -> list[tuple[float, object, object]]:
    return [(line["t"], line["value"], line.get("bucket")) for line in trace.of_kind(kind)]


def test_at_an_event_in_slices_of_the_unit(sampled: Callable[..., Trace]) -> None:
    """The speed grows linearly from 0 to 36 km/h in 2 s."""
    trace = sampled("cover(v, expression: ego.speed, unit: kph, event: tick, every: 10)")
    assert rows(trace) == [
        (0.5, pytest.approx(9.0), [0, 10]),
        (1.0, pytest.approx(18.0), [10, 20]),
        (1.5, pytest.approx(27.0), [20, 30]),
        (2.0, pytest.approx(36.0), [30, 40]),
    ]
    assert {line["unit"] for line in trace.of_kind("cover")} == {"kph"}


def test_range_and_buckets(sampled: Callable[..., Trace]) -> None:
    trace = sampled(
        "cover(a, expression: ego.speed, unit: mps, event: tick, range: [4..10], every: 2.5)\n"
        "cover(b, expression: ego.speed, unit: kph, event: tick, buckets: [18kph, 27kph, 36kph])"
    )
    found = {name: [] for name in "ab"}  # type: dict[str, list[object]]
    for line in trace.of_kind("cover"):
        found[line["name"]].append(line["bucket"])
    assert found["a"] == [None, [4.0, 6.5], [6.5, 9.0], [9.0, 10]]
    assert found["b"] == [None, [18, 27], [27, 36], [27, 36]]


def test_start_and_end(sampled: Callable[..., Trace]) -> None:
    trace = sampled(
        "record(first, expression: ego.speed, unit: mps, event: start)\n"
        "record(last, expression: ego.speed, unit: mps)"
    )
    assert rows(trace, "record") == [(0.0, 0.0, None), (2.0, pytest.approx(10.0), None)]


def test_filters_and_crosses(sampled: Callable[..., Trace]) -> None:
    trace = sampled(
        "cover(v, expression: ego.speed, unit: kph, event: tick, every: 20, ignore: v < 10kph,\n"
        "    illegal: it > 30kph)\n"
        "cover(late, expression: ego.speed > 6mps, event: tick)\n"
        "cover(both, items: [v, late])\n"
        "cover(off, expression: ego.speed, unit: kph, disable: true)"
    )
    lines = [line for line in trace.of_kind("cover") if line["name"] == "v"]
    assert [(line["t"], line.get("illegal", False)) for line in lines] == [
        (1.0, False),
        (1.5, False),
        (2.0, True),
    ]
    assert trace.warnings == ("v has the illegal value 36.0 kph at 2.00 s",)
    crosses = [line for line in trace.of_kind("cover") if line["name"] == "both"]
    assert [line["value"]["late"] for line in crosses] == [False, True, True]
    assert {line["name"] for line in trace.of_kind("cover")} == {"v", "late", "both"}


def test_an_override_refines_an_item(sampled: Callable[..., Trace]) -> None:
    trace = sampled(
        "cover(v, expression: ego.speed, unit: kph, event: tick, every: 10)\n"
        'cover(override: v, every: 100, target: 3, text: "coarse")'
    )
    assert {
        (tuple(line["bucket"]), line["target"], line["text"]) for line in trace.of_kind("cover")
    } == {((0.0, 100.0), 3, "coarse")}


def test_items_of_an_invoked_scenario_have_its_path(load: Load, tmp_path: Path) -> None:
    text = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.step:
    v: speed = 20kph
    cover(v, unit: kph)
    do drive(duration: 1s)

scenario sampled:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do serial:
        one: ego.step(v: 10kph)
        two: ego.step(v: 30kph)
"""
    trace = run(load(emit(asam(text, tmp_path))))
    assert [(line["t"], line["name"], line["value"]) for line in trace.of_kind("cover")] == [
        (1.0, "one.v", pytest.approx(10.0)),
        (2.0, "two.v", pytest.approx(30.0)),
    ]


@pytest.mark.parametrize(
    ("max_time", "body", "outcome", "time"),
    [
        (1.0, BODY, "timeout", 1.0),
        (60.0, "    do serial:\n        wait elapsed(1.5s)\n        emit fail\n", "failure", 1.5),
    ],
)
def test_runs_that_do_not_succeed_have_an_end_as_well(
    load: Load, tmp_path: Path, max_time: float, body: str, outcome: str, time: float
) -> None:
    """But only what is sampled there, and of that what has a value."""
    items = """    cover(v, expression: ego.speed, unit: kph)
    cover(none, expression: ego.speed / (ego.speed - ego.speed))
    cover(first, expression: ego.speed, unit: kph, event: start)
"""
    trace = run(load(emit(asam(HEAD + items + body, tmp_path))), RunSettings(max_time=max_time))
    assert trace.status == outcome
    ends = [line for line in trace.of_kind("cover") if line["t"] > 0]
    assert [(line["t"], line["name"], line["outcome"]) for line in ends] == [(time, "v", outcome)]


def test_what_is_cut_short_in_a_run_that_goes_on_has_no_end(load: Load, tmp_path: Path) -> None:
    text = """import osc.standard

scenario vehicle.step:
    v: speed = 20kph
    cover(v, unit: kph)
    do drive(duration: 10s)

scenario sampled:
    ego: vehicle
    do serial:
        one_of:
            one: ego.step()
            wait elapsed(1s)
        ego.drive(duration: 30s)
"""
    trace = run(load(emit(asam(text, tmp_path))), RunSettings(max_time=5.0))
    assert trace.status == "timeout"
    assert not list(trace.of_kind("cover"))


def test_items_of_actors_and_structs(load: Load, tmp_path: Path) -> None:
    """They are sampled for each object, where it is declared, by its own events or at the end."""
    text = """import osc.standard

struct load:
    weight: mass = 3kg
    cover(weight, unit: kg)

actor robot inherits vehicle:
    gear: int with:
        keep(it in [1..3])
        cover(it, event: late)
    box: load
    event late is elapsed(0.98s)
    record(v, expression: speed, unit: kph, event: late)
    cover(both, items: [gear, v], event: late)
    cover(override: gear, text: "the gear")

scenario robot.leg:
    other: robot
    do drive(duration: 1s) with:
        speed(36kph)

scenario sampled:
    one: robot with:
        keep(it.gear == 2)
    two: robot with:
        keep(it.gear == 3)
    open: robot
    do one.leg(other: two)
"""
    module = asam(text, tmp_path)
    items = {item.name: item for item in module.scenarios[-1].coverage}
    assert items["one.gear"].text == "the gear"
    assert [bucket.value for bucket in items["two.gear"].graded] == [3]
    assert [bucket.value for bucket in items["open.gear"].graded] == [1, 2, 3]
    trace = run(load(emit(module)))
    found = [
        (line["t"], line["name"], line["value"])
        for kind in ("cover", "record")
        for line in trace.of_kind(kind)
        if line["name"] not in ("one.both", "two.both") and not line["name"].startswith("open")
    ]
    values = {
        "one": {"box.weight": 3.0, "gear": 2, "v": 36.0},
        "two": {"box.weight": 3.0, "gear": 3, "v": 0.0},
    }
    assert sorted(found) == [
        (1.0, f"{name}.{item}", pytest.approx(value))
        for name, of_object in values.items()
        for item, value in of_object.items()
    ]
