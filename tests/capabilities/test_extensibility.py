"""C33 to C35: own actions, two wills for one car, what is refused before anything is built."""

import json
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Severity
from osc2tx.options import CompileOptions
from osc2tx_runtime.errors import SlotConflict
from tests.capabilities.kit import CAPABILITIES, DT, ROUNDED, Perform, cosine, next_step
from tests.end_to_end.harness import generate
from tests.own_actions import install, run_module

VALID = CAPABILITIES / "C35_semantic_validation.osc"


def test_c33_own_actions_come_from_a_package(tmp_path: Path) -> None:
    """In a process of its own, as the package must not stay registered for other tests."""
    install(tmp_path)
    module = tmp_path / "C33_custom_action.py"
    module.write_text(generate(CAPABILITIES / "C33_custom_action.osc").python, encoding="utf-8")
    done = run_module(module, tmp_path / "trace.jsonl", tmp_path)
    assert done.code == 0, done.err
    lines = [json.loads(line) for line in (tmp_path / "trace.jsonl").read_text().splitlines()]
    ends = {
        line["name"]: line["t"]
        for line in lines
        if line["kind"] == "action" and line["status"] == "end"
    }
    # 1 s of driving, 3 s of creeping; the class rolls out at 0.5 m/s^2: 4 s from 2 m/s.
    assert ends == {"ego drive": 1.0, "ego creep": 4.0, "ego roll_out": 8.0}
    speeds = {line["t"]: line["v"] for line in lines if line["kind"] == "state"}
    assert (speeds[1.0], speeds[4.0], speeds[6.0], speeds[8.0]) == pytest.approx(
        (3.0, 2.0, 1.0, 0.0), abs=ROUNDED
    )


def test_c34_a_car_is_handed_over_and_shared(perform: Perform) -> None:
    run = perform("C34_conflict_resolution")
    assert run.status == "success"
    evade, recover = run.spans("ego change_speed")
    assert run.span("ego drive").end == evade.start == 2.0
    assert (evade.length, recover.start) == (2.5, 5.0)  # 10 m/s at 4 m/s^2; swerve takes longer
    for line in run.states("ego"):
        t = line["t"]
        v = max(20.0 - 4.0 * max(t - 2.0, 0.0), 10.0) + 2.0 * max(t - 5.0, 0.0)
        assert line["v"] == pytest.approx(v, abs=ROUNDED)
        assert line["y"] == pytest.approx(cosine(-8.75, -5.25, 3.0, t - 2.0), abs=ROUNDED)


def test_c34_a_conflict_ends_the_run_and_is_named(perform: Perform) -> None:
    with pytest.raises(SlotConflict) as caught:
        perform("C34_conflict_reported")
    message = str(caught.value)
    assert "longitudinal slot of ego" in message
    for line in (13, 19):  # where the two actions stand
        assert f"C34_conflict_reported.osc:{line}" in message


def test_c35_the_scenario_itself_is_right(perform: Perform) -> None:
    run = perform("C35_semantic_validation")
    assert run.status == "success"
    # 60 m apart at 17 m/s after some time against 12 m/s: it sees the other one at 30 m.
    t = run.span("ego change_lane").start
    assert run.at("other", t)["s"] - run.at("ego", t)["s"] == pytest.approx(30.0, abs=5.0 * DT)


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        # names
        ("ego, other: vehicle", "ego, other: vehicel", "OSC202"),
        ("speed(v_other + 5mps)", "speed(v_othr + 5mps)", "OSC201"),
        ("until @near", "until @nearby", "OSC210"),
        ("side: left)", "side: up)", "OSC208"),
        ("num_of_lanes: 1", "number_of_lanes: 1", "OSC402"),
        ("gap: length = 15m", "gap: length = 15parsec", "OSC209"),
        # types and units
        ("gap: length = 15m", "gap: length = 15s", "OSC302"),
        ("gap: length = 15m", "gap: length = 15", "OSC303"),
        ("speed(v_other + 5mps)", "speed(v_other + 5m)", "OSC302"),
        (" < 2 * gap)", ")", "OSC301"),
        # meaning
        ("ego.change_lane(num_of_lanes: 1, side: left)", "ego.walk()", "OSC211"),
        ("keep(it in [10mps..20mps])", "keep(it > 30mps and it < 20mps)", "OSC421"),
    ],
)
def test_c35_mistakes_are_refused_where_they_stand(
    tmp_path: Path, old: str, new: str, code: str
) -> None:
    text = VALID.read_text(encoding="utf-8")
    assert text.count(old) == 1
    path = tmp_path / "broken.osc"
    path.write_text(text.replace(old, new), encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert not compilation.check()
    line = text[: text.index(old)].count("\n") + 1
    errors = [d for d in compilation.diagnostics if d.severity is Severity.ERROR]
    found = [(d.code, d.primary.line if d.primary else None) for d in errors]
    assert found == [(code, line)]


def test_c34_override_ends_one_and_skips_another(perform: Perform) -> None:
    run = perform("C34_override")
    assert run.status == "success"
    found = [(line["t"], line["name"], line["what"]) for line in run.of_kind("override")]
    assert found == [(2.0, "cruise", "ended"), (3.0, "hurry", "skipped")]
    assert run.span("ego drive").end == 2.0
    brake = run.span("ego change_speed")  # the only one: `hurry` never starts
    assert (brake.start, brake.length) == (2.0, 2.5)
    assert run.last("ego")["v"] == 10.0


def test_c33_values_follow_from_constraints_of_own_types(perform: Perform) -> None:
    run = perform("C33_own_types")
    assert run.status == "success"
    gain = run.span("ego change_speed")
    cruise = 20.0 * 0.514444  # knots
    assert run.last("ego")["v"] == pytest.approx(cruise, abs=ROUNDED)
    # `calm` implies 1 m/s^2.
    assert gain.length == next_step((cruise - 5.0) / 1.0)
    assert max(line["a"] for line in run.during("ego", gain)) == pytest.approx(1.0, abs=1e-4)
