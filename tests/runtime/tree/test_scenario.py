"""Scenario classes: names, parameters, labels, the sidecar map."""

from __future__ import annotations

import importlib.util
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime.domain.actors import Environment, Map, Vehicle
from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import ScenarioError, SettingsError, UnsupportedError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.registry import MethodRegistry
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.tree import Behaviour, Event, Parallel, Serial, Until, Wait, elapsed
from osc2tx_runtime.language.values.parameters import within
from tests.runtime.tree.kit import Run, Task

MODULE = """
from osc2tx_runtime.domain.actors import Vehicle
from osc2tx_runtime.language.tree import Behaviour, Event, Parallel, Serial, Until, Wait, elapsed
from osc2tx_runtime.domain.scenario import Scenario


class Mapped(Scenario):
    name = "mapped"
    source = "mapped.osc"

    def declare(self) -> None:
        self.hero = Vehicle()
        self.go = Event()

    def placement(self) -> None:
        self.place(self.hero)

    def behavior(self) -> Behaviour:
        return Serial(
            "mapped",
            Until(Wait(self.go), elapsed(1.0)),
            Parallel("both", Wait(elapsed(0.2)), Serial("rest", duration=0.1)),
        )
"""
NODES = [[line, 13] for line in (9, 11, 10, 12, 13, 14)]
ENTRY = {"fields": {"hero": [4, 9]}, "constraints": [], "placements": [[6, 9]], "nodes": NODES}


@pytest.fixture
def load(tmp_path: Path) -> Iterator[Any]:
    def load_with(content: object) -> type[Scenario]:
        path = tmp_path / "mapped_module.py"
        path.write_text(MODULE)
        if content is not None:
            text = content if isinstance(content, str) else json.dumps(content)
            path.with_suffix(".map.json").write_text(text)
        spec = importlib.util.spec_from_file_location("mapped_module", path)
        assert spec and spec.loader
        module = importlib.util.module_from_spec(spec)
        sys.modules["mapped_module"] = module
        spec.loader.exec_module(module)
        found: type[Scenario] = module.Mapped
        return found

    yield load_with
    sys.modules.pop("mapped_module", None)


def nodes_of(root: Any) -> list[tuple[str, str]]:
    own = [(root.name, root.source)]
    return own + [pair for child in root.children for pair in nodes_of(child)]


def test_the_map_gives_places(load: Any) -> None:
    scenario = load({"version": 3, "scenarios": {"mapped": ENTRY}})()
    assert nodes_of(scenario.create_tree()) == [
        ("mapped", "mapped.osc:9"),
        ("until elapsed 1 s", "mapped.osc:11"),
        ("wait @go", "mapped.osc:10"),
        ("both", "mapped.osc:12"),
        ("wait elapsed 0.2 s", "mapped.osc:13"),
        ("rest", "mapped.osc:14"),
    ]
    assert scenario.hero.source == "mapped.osc:4"
    assert scenario.placements[0].source == "mapped.osc:6"


@pytest.mark.parametrize(
    "content",
    [
        None,
        "{broken",
        "[]",
        "[" * 100_000,
        {"version": 2, "scenarios": {"mapped": ENTRY}},
        {"version": 3, "scenarios": {}},
        {"version": 3, "scenarios": {"mapped": [[9, 1], [11, 1]]}},
        {"version": 3, "scenarios": {"mapped": {**ENTRY, "nodes": NODES[:-1]}}},
        {"version": 3, "scenarios": {"mapped": {**ENTRY, "nodes": 5}}},
        {"version": 3, "scenarios": {"mapped": {**ENTRY, "nodes": [[9, "1"]] * 6}}},
    ],
)
def test_without_a_fitting_map_the_nodes_speak_for_themselves(load: Any, content: object) -> None:
    nodes = nodes_of(load(content)().create_tree())
    assert {source for _, source in nodes} == {"mapped.osc"}
    assert [name for name, _ in nodes] == [
        "mapped",
        "until elapsed 1 s",
        "wait @go",
        "both",
        "wait elapsed 0.2 s",
        "rest",
    ]


class Small(Scenario):
    name = "small"
    source = "small.osc"

    def declare(self) -> None:
        self.road = Map(map_file="curve.xodr")
        self.env = Environment()
        self.hero = Vehicle(name="ego")
        self.speed = self.parameter("speed", within(5.0, 10.0))
        self.gap = self.parameter("gap", 15.0)
        self.count = self.parameter("count", 3)
        self.wet = self.parameter("wet", False)
        self.side = self.parameter("side", "left")
        self.delay = self.parameter("delay", within(0.0, 1.0))
        self.limit = self.parameter("limit", 2.0, within(1.0, 3.0))
        self.go = Event()

    def behavior(self) -> Behaviour:
        return Parallel(
            "small",
            Wait("pause", elapsed(0.1)),
            Serial("after", Wait(self.ended("pause"))),
        )


def test_names_and_cast() -> None:
    small = Small()
    assert list(small.actors) == ["road", "env", "hero"]
    assert (small.hero.id, small.hero.name, small.hero.source) == ("hero", "ego", "small.osc")
    assert (small.go.name, list(small.events)) == ("go", ["go"])
    assert small.map_file() == "curve.xodr"


def test_parameters() -> None:
    small = Small()
    assert (small.gap, small.count, small.wet, small.side) == (15.0, 3, False, "left")
    assert 5.0 <= small.speed <= 10.0
    assert Small().speed == small.speed
    assert Small(RunSettings(seed=1)).speed != small.speed
    changed = Small(RunSettings(set={"gap": 2.0, "count": 4.0, "wet": "true", "side": "right"}))
    assert (changed.gap, changed.count, changed.wet, changed.side) == (2.0, 4, True, "right")
    assert changed.parameters["gap"] == 2.0
    assert Small(RunSettings(set={"gap": 2.0}), gap=1.0).gap == 1.0


def test_setting_one_parameter_does_not_change_another() -> None:
    assert Small(RunSettings(set={"speed": 7.0})).delay == Small().delay


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"set": {"gpa": 1.0}}, "--set gpa: the scenario has no such parameter; did you mean gap?"),
        ({"set": {"gap": "wide"}}, "--set gap=wide: write a number without unit"),
        ({"set": {"speed": 12.0}}, "--set speed=12: the scenario allows 5 to 10 (SI units)"),
        ({"set": {"limit": 0.5}}, "--set limit=0.5: the scenario allows 1 to 3 (SI units)"),
        ({"set": {"count": 2.5}}, "--set count=2.5: write a whole number"),
        ({"set": {"wet": 1.0}}, "--set wet=1.0: write true or false"),
        (
            {"signal": {"goo": 1.0}},
            "--signal goo: the scenario has no such event; did you mean go?",
        ),
        ({"spawn": {"x": ("1", 1, 0.0)}}, "has no such actor (it has road, env, hero)"),
        ({"destination": {"her": "x"}}, "--destination her: the scenario has no such actor"),
    ],
)
def test_settings_that_name_nothing(settings: Any, message: str) -> None:
    with pytest.raises(SettingsError) as caught:
        Small(RunSettings(**settings)).create_tree()
    assert message in caught.value.message


def test_unknown_argument() -> None:
    with pytest.raises(TypeError, match="no parameter 'gpa'"):
        Small(gpa=1.0)


def test_labels() -> None:
    small = Small()
    run = Run(small.create_tree(), label_events=small.label_events).go()
    assert (run.outcome.status, run.outcome.steps) == ("success", 2)
    assert '{"t":0.1,"kind":"event","name":"pause.end"}' in run.lines


def test_unknown_label() -> None:
    class Wrong(Small):
        def behavior(self) -> Behaviour:
            return Serial("wrong", Wait(self.started("cat")), Wait("cut", elapsed(1.0)))

    with pytest.raises(ScenarioError, match=r"@cat.start: no node has this label; .* cut\?"):
        Wrong().create_tree()


def test_registry() -> None:
    registry = MethodRegistry()

    @registry.action("physical_object", "jump", ends="instant")
    class Jump(Task):
        pass

    with pytest.raises(ValueError, match=r"physical_object.jump is registered already, by .*Jump"):
        registry.action("physical_object", "jump")(Task)
    registry.action("vehicle", "jump", slots=("lateral",), replace=True)(Task)
    hero = Small().hero
    node = registry.bind(hero, "jump")("high", 3)
    assert isinstance(node, Action)
    assert (type(node), node.name, node.slots, node.label) == (
        Task,
        "high",
        ("lateral",),
        "high",
    )
    assert registry.signature("physical_object", "jump").startswith("jump(steps: ")
    assert registry.names(hero.kinds) == ("jump",)
    assert [method.kind for method in registry.all()] == ["physical_object", "vehicle"]
    refused = registry.bind(hero, "jmp")("high", 3)
    assert refused.label == "high"
    with pytest.raises(UnsupportedError, match=r"vehicle has no action `jmp`.*; did you mean jump"):
        refused.setup()
    assert Jump.method.ends == "instant"


def test_a_modifier_that_the_action_does_not_take_is_refused_before_the_run() -> None:
    class Note:
        pass

    class Fussy(Task):
        def __init__(self, actor: Any, *modifiers: Any) -> None:
            Action.__init__(self, actor, *modifiers)

    node = Fussy(Small().hero, Note())
    node.source = "x.osc:8"
    with pytest.raises(
        UnsupportedError, match=r"x.osc:8: hero task does not take the modifier Note"
    ):
        Run(Until(node, elapsed(1.0))).go()


def test_a_value_that_cannot_be_computed_is_an_error_of_the_scenario() -> None:
    class Halves(Scenario):
        source = "halves.osc"

        def declare(self) -> None:
            self.none = 0.0
            self.half = 1.0 / self.none

    with pytest.raises(ScenarioError, match="cannot be computed") as caught:
        Halves()
    assert caught.value.source == "halves.osc"


def test_bounds_of_a_range_come_in_either_order() -> None:
    assert within(3.0, 1.0) == within(1.0, 3.0)
