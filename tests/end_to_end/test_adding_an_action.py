"""An action and a modifier are added in three places, as CONTRIBUTING tells it; all know them."""

import ast
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Collection
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

REPOSITORY = Path(__file__).parents[2]
COPIED = ("grammar", "osc2tx", "runtime_lib", "templates", "tools")
LINKED = ("generated", "pyproject.toml", "scenarios", "tests")
HANGING = 600  # s

BLOCK = re.compile(r"<!-- (append to|create) (\S+) -->\n```\w*\n(.*?)```\n", re.DOTALL)
BLOCKS = BLOCK.findall((REPOSITORY / "CONTRIBUTING.md").read_text(encoding="utf-8"))
LIBRARY, CLASSES, FORMS = "osc2tx/stdlib/", "runtime_lib/", "osc2tx/backends/xosc/"

# What is known of them, asked in the copy.
QUESTIONS = """
import json, sys
from pathlib import Path
from osc2tx.api import compile_file
from osc2tx.catalogue import catalogue
from osc2tx.testing import run_scenario
from tests.coverage.library import declared_items
from tests.coverage.page import library_tables

found = {"codes": {}}
for path in sorted(Path(".").glob("*.osc")):
    reports = compile_file(path).diagnostics
    found["codes"][path.stem] = sorted({report.code for report in reports})
right = compile_file("right.osc")
found["module"], found["xml"], found["outputs"] = right.python, right.xml, dict(right.outputs)
run = run_scenario(Path("right.osc"))
last = [line for line in run.lines if line["kind"] == "state"][-1]
found["offset"] = last["offset"]
entry = catalogue().actions["vehicle.swerve"]
found["entry"] = [entry.section, entry.ends, list(entry.slots), list(entry.needs)]
found["page"] = library_tables(declared_items())
print(json.dumps(found))
"""

SCENARIO = """\
import osc.standard.all

namespace null use std, stdtypes, osc2tx

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(20mps, at: start)
"""
USES = {
    "right": "ego.swerve(offset: 1m, duration: 8s) with:\n            wobble(25cm)",
    "both": "ego.swerve(offset: 1m, side: left, duration: 1s)",
    "neither": "ego.swerve(duration: 1s)",
    "negative": "ego.swerve(offset: 1m, duration: 1s) with:\n            wobble(-1m)",
    "same_thing": "ego.swerve(offset: 1m, duration: 1s) with:\n"
    "            wobble(25cm)\n            yaw(3deg)",
    "endless": "ego.swerve(offset: 1m)\n        ego.drive(duration: 1s)",
}


def run(folder: Path, *command: str | Path) -> subprocess.CompletedProcess[str]:
    """Run Python in a copy of the repository, which hides the one that is installed."""
    environment = {"PYTHONPATH": f"{folder}:{folder / 'runtime_lib'}", "OSC2TX_NO_CACHE": "1"}
    return subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=HANGING,
        check=False,
    )


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a copy of what the tools read and write."""
    folder = tmp_path_factory.mktemp("repository")
    for name in COPIED:
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(REPOSITORY / name, folder / name, ignore=ignored)
    for name in LINKED:
        (folder / name).symlink_to(REPOSITORY / name)
    return folder


def edit(folder: Path, places: Collection[str]) -> None:
    """Carry out the blocks of some places, and undo those of all others."""
    for how, name, text in BLOCKS:
        path, is_wanted = folder / name, any(name.startswith(place) for place in places)
        if how == "append to":
            before = (REPOSITORY / name).read_text(encoding="utf-8")
            path.write_text(f"{before}\n{text}" if is_wanted else before, encoding="utf-8")
        elif is_wanted:
            path.write_text(text, encoding="utf-8")
        else:
            path.unlink(missing_ok=True)


def make_tables(folder: Path) -> subprocess.CompletedProcess[str]:
    return run(folder, "tools/make_catalogue.py")


@pytest.fixture(scope="module")
def answers(copy: Path) -> dict[str, object]:
    """Return what the copy knows of the action and the modifier once they are added."""
    edit(copy, (LIBRARY, CLASSES, FORMS))
    for made in (make_tables(copy), run(copy, "tools/make_actor_methods.py")):
        assert made.returncode == 0, made.stderr
    for name, use in USES.items():
        (copy / f"{name}.osc").write_text(f"{SCENARIO}        {use}\n", encoding="utf-8")
    asked = run(copy, "-c", QUESTIONS)
    assert asked.returncode == 0, asked.stderr
    found: dict[str, object] = json.loads(asked.stdout)
    return found


def test_contributing_tells_of_three_places() -> None:
    names = [name for _, name, _ in BLOCKS]
    for place in (LIBRARY, CLASSES, FORMS):
        assert any(name.startswith(place) for name in names)


def test_checks_and_liveness_know_them(answers: dict[str, object]) -> None:
    assert answers["codes"] == {
        "both": ["OSC408"],
        "endless": ["OSC432"],
        "negative": ["OSC513"],
        "neither": ["OSC513"],
        "right": [],
        "same_thing": ["OSC508"],
    }


def test_the_module_knows_them_and_the_world_carries_them_out(answers: dict[str, object]) -> None:
    module = str(answers["module"])
    assert "self.ego.swerve(" in module
    assert "wobble(" in module
    assert answers["offset"] == pytest.approx(1.25, abs=0.01)
    assert answers["entry"] == ["", "open", ["lateral"], ["lanes"]]


def test_actors_have_a_typed_method(copy: Path, answers: dict[str, object]) -> None:
    path = copy / "runtime_lib/osc2tx_runtime/domain/methods/vehicle.py"
    (method,) = [
        node
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef) and node.name == "swerve"
    ]
    written = ast.unparse(method.args)
    assert "side: SideLeftRight | None" in written
    assert "offset: Value | None" in written


def test_the_coverage_page_knows_them(answers: dict[str, object]) -> None:
    page = str(answers["page"])
    assert re.search(r"`vehicle.swerve` .*runs.*no action of XML leaves the lane centre", page)
    assert re.search(r"`wobble` .*runs.*no action of XML sways", page)


def test_xml_is_refused_with_the_reason(answers: dict[str, object]) -> None:
    assert answers["xml"] is None
    report = str(answers["outputs"])
    assert "no action of XML leaves the lane centre for an open time" in report


@pytest.mark.slow
@pytest.mark.parametrize(
    ("places", "said"),
    [
        (
            (CLASSES, FORMS),
            "{}: the runtime registers a class for it, but the library does not declare it",
        ),
        ((LIBRARY, FORMS), "{}: the library declares it, but the runtime registers no class"),
        (
            (LIBRARY, CLASSES),
            "{}: OpenSCENARIO XML has neither a form of it nor a reason why not",
        ),
        ((LIBRARY,), "{}: the library declares it, but the runtime registers no class"),
        ((CLASSES,), "{}: OpenSCENARIO XML has neither a form of it nor a reason why not"),
        (
            (FORMS,),
            "{}: OpenSCENARIO XML knows it, but the library and the runtime do not",
        ),
    ],
    ids=lambda value: "+".join(value) if isinstance(value, tuple) else "",
)
def test_a_place_that_is_left_out(copy: Path, places: tuple[str, ...], said: str) -> None:
    edit(copy, places)
    tables = copy / "osc2tx" / "catalogue" / "library.json"
    before = tables.read_bytes()
    made = make_tables(copy)
    assert made.returncode == 1
    lines = made.stderr.splitlines()
    for names in (("vehicle.swerve", "swerve"), ("wobble",)):
        starts = [
            f"{what} {said.format(name)}" for name in names for what in ("action", "modifier")
        ]
        assert any(line.startswith(tuple(starts)) for line in lines), made.stderr
    assert tables.read_bytes() == before
