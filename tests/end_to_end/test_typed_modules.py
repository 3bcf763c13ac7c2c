"""A mistake in a module is an error of types: misspelt actions, parameters, members of enums."""

from __future__ import annotations

import os
import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from osc2tx_runtime import Environment, Map, Person, TrafficLightController, Trailer, Vehicle
from osc2tx_runtime.language.actions.registry import methods
from tests.end_to_end.harness import REPOSITORY
from tests.processes import HANGING

GENERATED = REPOSITORY / "generated"
EVADE = "cut_in_and_evade.py"
OWN_TYPES = "capabilities/C33_own_types.py"
OWN_ACTIONS = "capabilities/C33_custom_action.py"
COLORS = "hello_world.py"

# Module, what is written there, what is written instead, and what mypy calls that.
MISTAKES = {
    "action": (EVADE, r"\.change_lane\(", ".chnage_lane(", "attr-defined"),
    "parameter": (EVADE, "num_of_lanes=", "number_of_lanes=", "call-arg"),
    "missing parameter": (EVADE, r"target=25 \* kph, ", "", "call-arg"),
    "member of an enum": (EVADE, 'rate_profile="smooth"', 'rate_profile="smoth"', "arg-type"),
    "member of another enum": (EVADE, 'side="right"', 'side="ahead"', "arg-type"),
    "text for a speed": (EVADE, r"target=25 \* kph", 'target="25kph"', "arg-type"),
    "actor for a speed": (EVADE, r"target=25 \* kph", "target=self.npc", "arg-type"),
    "modifier": (EVADE, r"speed\(25 \* kph\)", "sped(25 * kph)", "name-defined"),
    "value of a modifier": (EVADE, r"speed\(25 \* kph\)", 'speed("25kph")', "arg-type"),
    "modifier that is not taken": (
        *(EVADE, r"\.hero\.change_lane\(", ".hero.change_lane(location(self.obstacle_pose), "),
        "arg-type",
    ),
    "modifier where none is taken": (
        *(EVADE, r"assign_celestial_position\(", "assign_celestial_position(lane(1), "),
        "(misc|call-arg|arg-type)",
    ),
    "action of another actor": (EVADE, r"self\.env\.assign", "self.hero.assign", "attr-defined"),
    "field": (EVADE, "self.hero.speed <", "self.hero.sped <", "attr-defined"),
    "parameter of a measure": (EVADE, "reference=self.npc", "refrence=self.npc", "call-arg"),
    "enum of a measure": (EVADE, '"euclidean"', '"euclidian"', "arg-type"),
    "field of an actor": (EVADE, "vehicle_category=", "vehicle_categry=", "call-arg"),
    "enum of a field": (EVADE, '="truck"', '="trukc"', "arg-type"),
    "color": (COLORS, r'Rgb\("0,128,0"\)', '"gren"', "arg-type"),
    "enum of the scenario": (OWN_TYPES, 'mood="calm"', 'mood="clam"', "arg-type"),
    "own action": (OWN_ACTIONS, r" creep\(self\.ego", " crep(self.ego", "name-defined"),
    "parameter of an own action": (OWN_ACTIONS, r"v=2 \* mps", "w=2 * mps", "call-arg"),
    "value of an own action": (OWN_ACTIONS, r"v=2 \* mps", 'v="2mps"', "arg-type"),
    "actor of an own action": (OWN_ACTIONS, r" creep\(self\.ego", " creep(self.road", "arg-type"),
}


@pytest.mark.slow
def test_mypy_finds_each_mistake(tmp_path: Path) -> None:
    for number, (module, written, instead, _) in enumerate(MISTAKES.values()):
        text = (GENERATED / module).read_text(encoding="utf-8")
        wrong, count = re.subn(written, instead, text, count=1)
        assert count == 1, f"{module} has no {written}"
        (tmp_path / f"mistake_{number}.py").write_text(wrong, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(tmp_path)],
        capture_output=True,
        text=True,
        timeout=HANGING,
        cwd=REPOSITORY,
        env={**os.environ, "MYPYPATH": str(REPOSITORY / "runtime_lib")},
    )
    for number, (what, (_, _, _, code)) in enumerate(MISTAKES.items()):
        found = re.findall(rf"mistake_{number}\.py:\d+: error: .*  \[(.*)\]", done.stdout)
        assert any(re.fullmatch(code, each) for each in found), f"{what}: {found}"


def test_actors_have_the_actions_of_the_library_and_no_others() -> None:
    actors = (Vehicle(), Trailer(), Person(), Environment(), Map(), TrafficLightController())
    for actor in actors:
        for method in methods.all():
            if method.factory.__module__.startswith("osc2tx_runtime"):
                assert hasattr(actor, method.name) or method.kind not in actor.kinds
    assert not hasattr(Vehicle(), "drvie")
    assert not hasattr(Map(), "drive")


def test_the_methods_are_those_of_the_registry() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools" / "make_actor_methods.py"))
    files = tool["render"]()
    known = {path.name for path in tool["FOLDER"].glob("*.py")} - {"__init__.py"}
    assert known == {path.name for path in files}
    for path, text in files.items():
        assert path.read_text(encoding="utf-8") == text
