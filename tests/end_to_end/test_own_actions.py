"""Own actions from declaration to run: the files of docs/extending.md, as a user has them."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.own_actions import DOCUMENT, install, run_module
from tests.processes import HANGING, Ended

ROOT = Path(__file__).parents[2]
Golden = Callable[[str, Path], None]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder with the scenario files of the document."""
    text = DOCUMENT.read_text(encoding="utf-8")
    for name, content in re.findall(r"^```\n# (\w+\.osc)\n(.*?)^```$", text, re.M | re.S):
        (tmp_path / name).write_text(content, encoding="utf-8")
    return tmp_path


def build(project: Path, name: str = "slow") -> Path:
    """Build a scenario of the document; return its module."""
    compilation = Compilation(project / f"{name}.osc", f"{name}.osc", CompileOptions())
    generated = compilation.module
    assert generated is not None, compilation.diagnostics
    module = project / f"{name}.py"
    module.write_text(generated.python, encoding="utf-8")
    module.with_suffix(".map.json").write_text(generated.source_map, encoding="utf-8")
    return module


def run(project: Path, *packages: Path) -> Ended:
    """Build slow.osc and run its module, with folders of packages on the path."""
    return run_module(build(project), project / "t.jsonl", *packages)


def change(project: Path, old: str, new: str, file: str = "slow.osc") -> None:
    """Edit a scenario file."""
    scenario = project / file
    text = scenario.read_text(encoding="utf-8")
    assert old in text
    scenario.write_text(text.replace(old, new), encoding="utf-8")


def test_the_example_of_the_document_runs(
    project: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    packages = tmp_path_factory.mktemp("site")
    install(packages)
    module = build(project)
    path = os.pathsep.join(map(str, (ROOT / "runtime_lib", packages)))
    done = subprocess.run(
        [sys.executable, str(module), "--trace", str(project / "t.jsonl")],
        capture_output=True,
        text=True,
        timeout=HANGING,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    text = module.read_text(encoding="utf-8")
    assert "creep(self.ego, duration=2 * s)," in text
    assert "import my_actions" not in text and "my_actions import" not in text
    lines = [json.loads(line) for line in (project / "t.jsonl").read_text().splitlines()]
    ends = [(e["t"], e["source"]) for e in lines if e["kind"] == "action" and e["status"] == "end"]
    # From 2 m/s the car is at 1.5 m/s within 2 s, then rolls out at 0.5 m/s2: 1.5 / 0.5 = 3 s.
    assert ends == [(2.0, "slow.osc:16"), (5.0, "slow.osc:17")]
    speeds = {line["t"]: line["v"] for line in lines if line["kind"] == "state"}
    assert (speeds[2.0], speeds[4.0], speeds[5.0]) == pytest.approx((1.5, 0.5, 0.0), abs=1e-6)


def test_an_action_without_an_actor(
    project: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    packages = tmp_path_factory.mktemp("site")
    install(packages)
    module = build(project, "captured")
    assert 'capture(channel="can0"),' in module.read_text(encoding="utf-8")
    done = run_module(module, project / "t.jsonl", packages)
    assert done.code == 0, done.err
    lines = [json.loads(line) for line in (project / "t.jsonl").read_text().splitlines()]
    found = [line for line in lines if line.get("name") == "capture"]
    assert [(line["t"], line["status"]) for line in found] == [(0.0, "start"), (2.0, "end")]
    assert not any("actor" in line for line in found)


def test_an_action_without_an_actor_is_refused_where_nobody_brings_it(project: Path) -> None:
    done = run_module(build(project, "captured"), project / "t.jsonl")
    assert done.code == 5
    assert done.err == (
        "captured.osc:14:9: error[OSC804]: there is no global action `capture`, and no installed"
        " package brings one by the entry point group osc2tx.methods\n"
    )


def test_without_the_package_the_run_is_refused_at_its_line(project: Path) -> None:
    done = run(project)
    assert done.code == 5
    assert done.err == (
        "slow.osc:16:9: error[OSC804]: vehicle has no action `creep`, and no installed package"
        " brings one by the entry point group osc2tx.methods\n"
    )
    assert not (project / "t.jsonl").exists()


def test_a_class_that_does_not_fit_its_declaration_is_named(
    project: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    packages = tmp_path_factory.mktemp("site")
    install(packages)
    change(project, "    v: speed = 1.5mps", "    w: speed = 1.5mps", "my_actions.osc")
    done = run(project, packages)
    assert done.code == 5
    assert done.err == (
        "slow.osc:16:9: error[OSC801]: ego creep: unknown argument 'w'; it is creep(v: float = 1.5,"
        " **options: Any)\n"
    )


def test_wrong_arguments_are_found_without_the_package(project: Path) -> None:
    change(project, "ego.creep(duration: 2s)", "ego.creep(w: 2mps, v: 3m)")
    compilation = Compilation(project / "slow.osc", "slow.osc", CompileOptions())
    assert not compilation.check()
    found = [(d.code, d.primary.text) for d in compilation.diagnostics if d.primary is not None]
    assert found == [("OSC402", "w"), ("OSC302", "3m")]


def test_two_actions_on_one_slot_are_reported(
    project: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    packages = tmp_path_factory.mktemp("site")
    install(packages)
    change(
        project,
        "        ego.creep(duration: 2s)\n        ego.roll_out()\n",
        "        parallel:\n            ego.creep()\n            ego.change_speed(5mps)\n",
    )
    done = run(project, packages)
    assert done.code == 5
    assert done.err == (
        "slow.osc:17:13: error[OSC803]: ego.change_speed(target=5 * mps) (slow.osc:18) and"
        " ego.creep() (slow.osc:17)"
        " control the longitudinal slot of ego at the same time; let them run one after the"
        " other (at 0.000 s)\n"
    )


def test_an_action_of_an_own_actor(project: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    packages = tmp_path_factory.mktemp("site")
    install(packages)
    package = packages / "my_actions.py"
    text = package.read_text(encoding="utf-8")
    package.write_text(text.replace('@action("vehicle", "creep"', '@action("slow_car", "creep"'))
    change(
        project,
        "action vehicle.creep:",
        "actor slow_car inherits vehicle:\n    pace: speed = 1mps\n\naction slow_car.creep:",
        "my_actions.osc",
    )
    change(project, "ego: vehicle", "ego: slow_car with:\n        keep(it.pace == 1.25mps)")
    change(project, "ego.creep(duration", "ego.creep(v: ego.pace, duration")
    done = run(project, packages)
    assert done.code == 0, done.err
    module = (project / "slow.py").read_text(encoding="utf-8")
    assert 'self.ego = self.cast("ego", SlowCar(pace=1.25 * mps))' in module
    assert "creep(self.ego, v=self.ego.pace, duration=2 * s)," in module
    lines = [json.loads(line) for line in (project / "t.jsonl").read_text().splitlines()]
    assert lines[0]["actors"]["ego"]["length"] == 4.6  # a car, as any vehicle without a category
    speeds = {line["t"]: line["v"] for line in lines if line["kind"] == "state"}
    assert speeds[2.0] == pytest.approx(1.25)
    assert max(speeds) == pytest.approx(2.0 + 1.25 / 0.5)  # rolls out at 0.5 m/s2
