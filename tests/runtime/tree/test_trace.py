"""Lines of the trace: numbers, order, kinds."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.domain.objects.parts import HitchReceiver
from osc2tx_runtime.language.trace import TraceWriter, number, to_json
from osc2tx_runtime.language.tree import Emit, Parallel, Serial, Until, Wait, elapsed
from osc2tx_runtime.world.measuring.velocities import OrientationRate, Velocity
from tests.runtime.tree.kit import FakeActor, FakeWorld, Run, Switch, Task, event
from tests.work import calls

HERO: Any = FakeActor("hero")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.0, "1.0"),
        (0.1 + 0.2, "0.3"),
        (-0.0, "0.0"),
        (-1e-9, "0.0"),
        (1e-6, "1e-06"),
        (1234567.1234567, "1234567.123457"),
        (None, "null"),
        (float("inf"), "null"),
        (float("nan"), "null"),
    ],
)
def test_number(value: float | None, text: str) -> None:
    assert number(value) == text
    json.loads(text)


def test_order_within_an_instant() -> None:
    world = FakeWorld(("npc", "hero"))
    world.contacts[1] = [("hero", "npc")]
    early, late = Task(HERO, 1), Task(HERO, 1)
    early.source, late.source = "x.osc:9", "x.osc:10"
    early.position, late.position = 9, 10
    tree = Parallel("p", Emit(event("b")), late, Switch(HERO, "on"), early, Emit(event("a")))
    lines = [json.loads(line) for line in Run(tree, world=world).go().lines]
    first = [line for line in lines if line.get("t") == 0.0]
    assert [line["actor"] for line in first if line["kind"] == "state"] == ["npc", "hero"]
    rest = [(line["kind"], line.get("name"), line.get("source")) for line in first[2:]]
    assert rest == [
        ("event", "a", None),
        ("event", "b", None),
        ("action", "hero switch", ""),
        ("action", "hero switch", ""),
        ("action", "hero task", "x.osc:9"),
        ("action", "hero task", "x.osc:10"),
        ("lights", None, None),
    ]
    assert [line["kind"] for line in lines if line.get("t") == 0.05][-1] == "collision"


def test_state_line_and_result_line() -> None:
    run = Run(Task(HERO, 0), ids=("hero",)).go()
    assert run.lines[0] == (
        '{"t":0.0,"kind":"state","actor":"hero","x":0.0,"y":0.0,"z":0.0,"h":0.0,"v":0.0,"a":0.0,'
        '"road":null,"lane":null,"s":null,"offset":null}'
    )
    assert run.lines[-1] == '{"kind":"result","status":"success","reason":"","steps":0}'


def test_labels_in_the_tree_are_those_of_the_scenario() -> None:
    """Not the names of compositions, nor words of a text that look like a label."""
    plain = Task(HERO, 0)
    plain.action_name = plain.name = "hero: task"
    labelled = Task(HERO, 0, label="evade")
    tree = Serial("whole", plain, labelled, Wait("pause", elapsed(0.1)), Wait(elapsed(0.1)))
    lines = [json.loads(line) for line in Run(tree).go().lines]
    (nodes,) = (line["nodes"] for line in lines if line["kind"] == "tree")
    assert [(node["text"], node.get("label")) for node in nodes] == [
        ("whole", None),
        ("hero: task", None),
        ("evade: hero task", "evade"),
        ("pause: elapsed 0.1 s", "pause"),
        ("elapsed 0.1 s", None),
    ]


def test_what_is_done_until_something_has_the_label_that_until_takes_over() -> None:
    done = Until(Until(Task(HERO, 3, label="go"), elapsed(9.0)), elapsed(0.1))
    lines = [json.loads(line) for line in Run(Serial("whole", done)).go().lines]
    (nodes,) = (line["nodes"] for line in lines if line["kind"] == "tree")
    assert [(node["text"], node.get("label")) for node in nodes] == [
        ("whole", None),
        ("elapsed 0.1 s", None),
        ("elapsed 9 s", None),
        ("go: hero task", "go"),
    ]


def test_names_are_escaped() -> None:
    lines: list[str] = []
    trace = TraceWriter(lines.extend)
    trace.event('a"\n')
    trace.environment(b=1.0, a=None)
    trace.end_instant(0.05)
    assert [json.loads(line) for line in lines] == [
        {"t": 0.05, "kind": "event", "name": 'a"\n'},
        {"t": 0.05, "kind": "environment", "a": None, "b": 1.0},
    ]


def test_values_of_structs_are_objects() -> None:
    rate = OrientationRate(yaw=0.5)
    assert json.loads(to_json(Velocity(angular=rate))) == {
        "translational": {"x": 0.0, "y": 0.0, "z": 0.0},
        "angular": {"roll": 0.0, "pitch": 0.0, "yaw": 0.5},
    }
    # What is not known is no number; whether something is coupled is no member of the value.
    assert json.loads(to_json(HitchReceiver("ball", position_x=-0.9))) == {
        **{"hitch_type": "ball", "position_x": -0.9, "position_z": None},
        **{"max_rotation": None, "max_tilt": None},
    }


def test_a_trace_that_nothing_takes_makes_no_lines() -> None:
    trace = TraceWriter()
    trace.event("a")
    trace.lights("hero", "on")
    assert calls(lambda: trace.end_instant(0.0)) == 2  # the lambda, and the call itself


def test_the_document_names_every_kind() -> None:
    text = (Path(__file__).parents[3] / "docs/trace.md").read_text(encoding="utf-8")
    for kind in ("header", "state", "event", "action", "lights", "environment", "signal"):
        assert f'"kind":"{kind}"' in text
    assert '"kind":"collision"' in text
    assert '"kind":"result"' in text


def test_sources_use_no_py_trees_clock_and_no_blackboard() -> None:
    """Simulators are other processes: waiting for them takes a clock, and errors cross over."""
    root = Path(__file__).parents[3] / "runtime_lib/osc2tx_runtime"
    words = ("timers", "blackboard", "Timeout", "import time\n", "from time ", "except Exception")
    for path in sorted(root.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        edge = ("except Exception",) if path.name == "main.py" else ()  # of the process
        if path.is_relative_to(root / "simulators"):
            edge = ("import time\n", "Timeout", "except Exception")
        if path.is_relative_to(root / "campaigns"):  # seconds of a row; none ends the others
            edge = ("import time\n", "except Exception")
        assert not [word for word in words if word in text and word not in edge], path
        assert not re.search(r"\bosc2tx\.(?!(kpis|methods|worlds)\b)", text), path
