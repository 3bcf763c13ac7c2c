"""What a module imports of those of imported files, and builds of such files."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.building.build import BuildOptions, build
from osc2tx.building.jobs import compile_all
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import GivenOptions
from osc2tx.module_loading import scenarios_of_file, scenarios_of_module
from osc2tx_runtime import RunSettings, run_scenario
from tests.end_to_end.harness import REPOSITORY
from tests.end_to_end.importing_files import (
    LIBRARY,
    MAIN,
    classes_in,
    compiled,
    imports_in,
    module_of,
    trace_of,
    write,
)
from tests.processes import HANGING

# --- what is imported ---


def test_the_module_of_the_imported_file_is_the_one_place(tmp_path: Path) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), b=LIBRARY)
    text = module_of(tmp_path / "a.osc")
    assert imports_in(text) == {"b": ["Approach", "Limits"]}
    assert classes_in(text) == ["Top"]
    assert classes_in(module_of(tmp_path / "b.osc")) == ["Limits", "Approach"]


def test_imports_change_nothing_in_a_run(tmp_path: Path) -> None:
    """The same trace as with copies: values drawn, names, and lines of both files."""
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), b=LIBRARY)
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    with scenarios_of_module(emit(compilation.ir)) as copies:
        expected = trace_of(copies["top"])
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert list(scenarios) == ["top"]
        found = trace_of(scenarios["top"])
    assert found == expected
    line = 1 + LIBRARY.splitlines().index("        car.drive(duration: 1s) with:")
    assert any(f'"source":"b.osc:{line}"' in each for each in found)


def test_loading_leaves_nothing_behind(tmp_path: Path) -> None:
    """Two folders have modules of the same names, which are not the same."""
    ends = []
    modules, path = set(sys.modules), list(sys.path)
    for folder, pause in (tmp_path / "one", "it == 1s"), (tmp_path / "two", "it == 2s"):
        folder.mkdir()
        library = LIBRARY.replace("it in [1s..3s]", pause)
        write(folder, a=MAIN.replace("LIBRARY", "b.osc"), b=library)
        build([folder], folder / "out", GivenOptions())
        with scenarios_of_file(folder / "out" / "a.py", "module_under_test") as scenarios:
            ends.append(run_scenario(scenarios["top"], RunSettings()).time)
        assert not (folder / "out" / "__pycache__").exists()
    assert ends == [3.0, 4.0]
    new = set(sys.modules) - modules
    assert not {"a", "b", "module_under_test"} & new
    assert sys.path == path


def test_folders(tmp_path: Path) -> None:
    """Two modules of one name, each a script of its folder, run from somewhere else."""
    main = MAIN.replace("LIBRARY", "../lib/b.osc")
    write(tmp_path, urban__a=main, rural__a=main.replace("1s)", "2s)"), lib__b=LIBRARY)
    build([tmp_path], tmp_path / "out", GivenOptions())
    text = (tmp_path / "out/urban/a.py").read_text(encoding="utf-8")
    assert imports_in(text) == {"lib.b": ["Approach", "Limits"]}
    traces = {}
    for name in ("urban", "rural"):
        with scenarios_of_file(tmp_path / f"out/{name}/a.py", f"{name}_a") as scenarios:
            traces[name] = trace_of(scenarios["top"])
    assert traces["urban"] != traces["rural"]
    ran = subprocess.run(
        [sys.executable, str(tmp_path / "out/urban/a.py"), "--seed", "3", "--trace", "t.jsonl"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(REPOSITORY / "runtime_lib")},
        timeout=HANGING,
        capture_output=True,
        text=True,
    )
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "t.jsonl").read_text(encoding="utf-8").splitlines() == traces["urban"]


@pytest.mark.slow
def test_type_checkers_follow_imports(tmp_path: Path) -> None:
    main = MAIN.replace("LIBRARY", "../lib/b.osc")
    write(tmp_path, urban__a=main, rural__a=main, lib__b=LIBRARY)
    build([tmp_path], tmp_path / "out", GivenOptions())

    def check() -> str:
        command = [sys.executable, "-m", "mypy", "--strict", "--explicit-package-bases", "."]
        cache = f"--cache-dir={tmp_path / 'cache'}"
        environment = {**os.environ, "MYPYPATH": str(REPOSITORY / "runtime_lib")}
        folder = tmp_path / "out"
        options = {"capture_output": True, "text": True, "timeout": HANGING}
        return subprocess.run(
            [*command, cache], cwd=folder, env=environment, **options  # type: ignore[call-overload]
        ).stdout

    assert check() == "Success: no issues found in 3 source files\n"
    module = tmp_path / "out/urban/a.py"
    text = module.read_text(encoding="utf-8")
    module.write_text(text.replace("Limits(low=", "Limits(lo="), encoding="utf-8")
    assert 'Unexpected keyword argument "lo" for "Limits"' in check()


def test_names_of_their_own_go_first(tmp_path: Path) -> None:
    """An own class of the same name keeps it, and the imported one gets another here."""
    main = MAIN.replace("LIBRARY", "b.osc").replace("scenario top", "scenario Approach")
    write(tmp_path, a=main, b=LIBRARY)
    text = module_of(tmp_path / "a.osc")
    assert classes_in(text) == ["Approach"]
    assert "from b import (\n    Approach as Approach_,\n    Limits,\n)\n" in text
    assert ast.unparse(ast.parse(text)).count("self.invoke(Approach_, car=self.hero, ") == 1


TYPES = """\
# Kinds of vehicles.
import osc.standard

struct limits:
    low: speed
    high: speed
    margin: length
    rest: inner
    def middle() -> speed is expression (it.low + it.high) / 2
    def is_wide() -> bool is expression it.high > 2 * it.low

struct inner:
    m: length

actor truck inherits vehicle:
    load: mass
    def is_full() -> bool is expression it.load > 1000kg
"""

USER = """\
import osc.standard
import "kinds.osc"

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    hero: truck with:
        keep(it.load == 2000kg)
    mine: limits with:
        keep(it.low == 30kph)
        keep(it.high == 50kph)
        keep(it.margin == 3m)
    do serial:
        wait hero.is_full() and mine.margin > 2m and mine.is_wide() == false
        hero.drive(duration: 1s) with:
            speed(mine.middle())
"""


def test_a_file_of_types_makes_a_module(tmp_path: Path) -> None:
    """It has all fields and methods, also those that only its users speak of."""
    write(tmp_path, a=USER, kinds=TYPES)
    text = module_of(tmp_path / "kinds.osc")
    assert classes_in(text) == ["Limits", "Inner", "Truck"]
    assert "    low: Speed\n" in text and "    margin: Length = not_given\n" in text
    assert "create_root" not in text and "main" not in text
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    assert imports_in(compilation.module.python) == {"kinds": ["Limits", "Truck"]}
    assert "Limits(low=30 * kph, high=50 * kph, margin=3 * m)" in compilation.module.python
    with scenarios_of_module(emit(compilation.ir)) as copies:
        expected = trace_of(copies["top"])
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert trace_of(scenarios["top"]) == expected
    assert '"status":"success"' in expected[-1]


MOODS = """\
import osc.standard

enum mood: [calm, hasty]

actor person_car inherits vehicle:
    temper: mood = calm
"""


@pytest.mark.parametrize("extended", [False, True])
def test_enums(tmp_path: Path, extended: bool) -> None:
    """An enum with more members is another one, and so is all that has one as a field."""
    main = USER.replace("kinds", "moods").replace("truck with", "person_car with")
    main = main[: main.index("    mine: limits")].replace("it.load == 2000kg", "it.temper == hasty")
    main += "    now: mood = calm\n    do wait hero.temper != now\n"
    if extended:
        main = main.replace("\nscenario", "\nextend mood: [sad]\n\nscenario", 1)
    write(tmp_path, a=main, moods=MOODS)
    assert 'Mood: TypeAlias = Literal["calm", "hasty"]' in module_of(tmp_path / "moods.osc")
    text = module_of(tmp_path / "a.osc")
    if not extended:
        assert imports_in(text) == {"moods": ["Mood", "PersonCar"]}
        assert "Literal" not in text
        return
    assert imports_in(text) == {}
    assert 'Mood: TypeAlias = Literal["calm", "hasty", "sad"]' in text
    assert text.count("# A copy from moods.osc: here it is not as in that file alone\n") == 2


def test_subtypes_of_imported_types(tmp_path: Path) -> None:
    """A method that an importing file overrides for its own type is the one of the object."""
    special = """
actor tanker inherits truck:
    keep(load == 500kg)
    def is_full() -> bool is only expression it.load > 400kg
"""
    user = USER.replace("hero: truck with:\n        keep(it.load == 2000kg)", "hero: tanker")
    write(tmp_path, a=user.replace("\nscenario top", f"{special}\nscenario top"), kinds=TYPES)
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    with scenarios_of_module(emit(compilation.ir)) as copies:
        expected = trace_of(copies["top"])
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert trace_of(scenarios["top"]) == expected
    assert imports_in(compilation.module.python) == {"kinds": ["Limits", "Truck"]}
    assert classes_in(compilation.module.python) == ["Tanker", "Top"]


ACTIONS = """\
import osc.standard

# Accelerates, and goes on for a while.
action vehicle.gain_speed:
    target: speed
    hold: time = 1s
    do serial:
        change_speed(target: target, rate_profile: smooth)
        drive(duration: hold) with:
            speed(target)

action vehicle.stop_and_go:
    pause: time with:
        keep(it in [1s..3s])
    do serial:
        gain_speed(target: 10kph)
        wait elapsed(pause)
"""
INVOKING = """\
import osc.standard
import actions

scenario top:
    hero: vehicle
    do serial:
        hero.drive(duration: 1s) with:
            speed(20kph)
        hero.stop_and_go()
"""


def test_actions_with_behavior_are_classes_of_their_file(tmp_path: Path) -> None:
    """Also those that nothing in it invokes, so no user has a copy. None begins a run."""
    write(tmp_path, a=INVOKING, actions=ACTIONS)
    text = module_of(tmp_path / "actions.osc")
    assert classes_in(text) == ["GainSpeed", "StopAndGo"]
    assert text.startswith('"""Actions `vehicle.gain_speed`, `vehicle.stop_and_go`.\n')
    assert "create_root" not in text and "main" not in text
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    assert imports_in(compilation.module.python) == {"actions": ["StopAndGo"]}
    assert classes_in(compilation.module.python) == ["Top"]
    with scenarios_of_module(emit(compilation.ir)) as copies:
        expected = trace_of(copies["top"])
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert trace_of(scenarios["top"]) == expected
    assert '"status":"success"' in expected[-1]


def test_actions_make_no_xml(tmp_path: Path) -> None:
    write(tmp_path, actions=ACTIONS)
    (compilation,) = compile_all([tmp_path / "actions.osc"], GivenOptions())
    assert [each.suffix for each in compilation.outputs()] == [".py", ".map.json"]
    assert compilation.diagnostics == ()


def test_a_package_keeps_its_name(tmp_path: Path) -> None:
    """A module would hide the package that carries out actions, which often is called as it."""
    write(tmp_path, a=USER, kinds=f"{TYPES}\naction truck.tip\n")
    assert compile_all([tmp_path / "kinds.osc"], GivenOptions())[0].module is None
    reason = "that file makes no module by itself"
    assert f"# A copy from kinds.osc: {reason}\n" in module_of(tmp_path / "a.osc")
    write(tmp_path, actions=f"{ACTIONS}\naction vehicle.honk\n")
    assert compile_all([tmp_path / "actions.osc"], GivenOptions())[0].module is None


# --- builds ---


def test_an_edit_changes_one_module(tmp_path: Path) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), c=MAIN.replace("LIBRARY", "b.osc"))
    write(tmp_path, b=LIBRARY)
    out = tmp_path / "out"
    given = GivenOptions(target="py")
    build([tmp_path], out, given)
    write(tmp_path, b=LIBRARY.replace("50kph", "60kph"))
    written = build([tmp_path], out, given).written
    assert [path.name for path in written if path.suffix == ".py"] == ["b.py"]


def test_a_file_built_alone_brings_what_it_needs(tmp_path: Path) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), b=LIBRARY)
    out, whole = tmp_path / "out", tmp_path / "whole"
    build([tmp_path / "a.osc"], out, GivenOptions())
    build([tmp_path], whole, GivenOptions())
    for name in ("a.py", "b.py"):
        assert (out / name).read_bytes() == (whole / name).read_bytes()
    assert not (out / "b.xosc.report.json").exists()
    checked = build([tmp_path / "a.osc"], out, GivenOptions(), BuildOptions(check_only=True))
    assert not checked.changes
    (out / "b.py").unlink()
    checked = build([tmp_path / "a.osc"], out, GivenOptions(), BuildOptions(check_only=True))
    assert [change.path.name for change in checked.changes] == ["b.py"]
    assert len(checked.results) == 1


def test_new_settings_of_the_imported_file_reach_the_importing_one(tmp_path: Path) -> None:
    write(tmp_path, a=MAIN.replace("LIBRARY", "b.osc"), b=LIBRARY)
    out = tmp_path / "out"
    build([tmp_path / "a.osc"], out, GivenOptions())
    (tmp_path / "osc2tx.toml").write_text('[scenarios.b]\none_of = "first"\n', encoding="utf-8")
    build([tmp_path / "a.osc"], out, GivenOptions())
    assert imports_in((out / "a.py").read_text(encoding="utf-8")) == {}
