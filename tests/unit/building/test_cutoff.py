"""A result holds as long as what its source uses is the same, in every folder."""

import shutil
from pathlib import Path

import pytest

from osc2tx.building import build as module
from osc2tx.compilation.uses import UsedFile, used_digest
from osc2tx.config import GivenOptions
from tests.unit.building.projects import Project, contents, write

LIBRARY = """# Library
import osc.standard.all

namespace null use std, stdtypes

# How fast
struct limits:
    top: speed = 30kph

enum color: [red, green]

scenario base:
    # The actor
    ego: vehicle
    v: speed with:
        keep(it in [20kph..40kph])
    keep(default ego.bounding_box.length == 4m)
    do ego.drive(duration: 1s) with:
        speed(v)

modifier brisk of vehicle.drive:
    speed(50kph)
"""
USER = """import lib
import osc.standard.all

namespace null use std, stdtypes

scenario {name}{base}:
{members}"""
DRIVING = """    car: vehicle
    mine: limits
    do car.drive(duration: 1s) with:
        {modifier}
"""


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    found: list[str] = []
    compile_jobs = module.compile_jobs

    def watched(jobs, workers, memory, known, *args):  # type: ignore[no-untyped-def]
        found.extend(job.name for job in jobs if job not in known)
        return compile_jobs(jobs, workers, memory, known, *args)

    monkeypatch.setattr(module, "compile_jobs", watched)
    return found


@pytest.fixture
def library(project: Project) -> Path:
    derived = USER.format(name="derived", base=" inherits base", members="    keep(v == 30kph)\n")
    limited = DRIVING.format(modifier="speed(mine.top)")
    write(project.sources / "derived.osc", derived)
    write(project.sources / "limited.osc", USER.format(name="limited", base="", members=limited))
    brisk = DRIVING.format(modifier="brisk()").replace("    mine: limits\n", "")
    write(project.sources / "brisk.osc", USER.format(name="brisk_one", base="", members=brisk))
    project.drive("alone.osc")
    return write(project.sources / "lib.osc", LIBRARY)


def rebuilt(project: Project, compiled: list[str]) -> list[str]:
    """Return what a build compiles, after the check that a build without memory makes the same."""
    compiled.clear()
    result = project.build()
    assert [str(report) for each in result.results for report in each.reports] == []
    found = sorted(compiled)
    fresh = project.copy(project.folder.with_name(f"{project.folder.name}-fresh"))
    shutil.rmtree(fresh.out)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OSC2TX_NO_CACHE", "1")
        fresh.build()
    made, wanted = contents(project.out), contents(fresh.out)
    shutil.rmtree(fresh.folder)
    assert made == wanted
    return found


@pytest.mark.parametrize(
    "old, new",
    [
        ("# Library\n", "# Library\n# of the company\n\n"),
        ("# How fast\n", "# How fast one may be\n# in town\n"),
        ("    # The actor\n", "    # The actor\n    # that is tested\n"),
        ("    top: speed = 30kph\n", "    top: speed = 30kph  # in town\n"),
        ("    speed(50kph)\n", "    # brisk\n    speed(50kph)\n# The end\n"),
        ("enum color: [red, green]\n", "\n\nenum color:   [red,\n    green]\n"),
        ("enum color: [red, green]\n", "enum color: [red, green, blue]\n"),
        ("enum color: [red, green]\n", "struct other:\n    far: length = 3m\n"),
    ],
)
def test_what_nobody_uses_compiles_the_library_alone(
    project: Project, compiled: list[str], library: Path, old: str, new: str
) -> None:
    project.build()
    assert old in LIBRARY
    library.write_text(LIBRARY.replace(old, new), encoding="utf-8")
    assert rebuilt(project, compiled) == ["lib.osc"]
    assert rebuilt(project, compiled) == []


@pytest.mark.parametrize(
    "old, new, users",
    [
        ("top: speed = 30kph", "top: speed = 31kph", ["limited.osc"]),
        ("[20kph..40kph]", "[20kph..41kph]", ["derived.osc"]),
        ("speed(50kph)", "speed(51kph)", ["brisk.osc"]),
        ("enum color: [red", "enum car: [red", ["brisk.osc", "limited.osc"]),
        ("length == 4m", "length == 5m", ["derived.osc"]),
    ],
)
def test_what_is_used_compiles_its_users(
    project: Project, compiled: list[str], library: Path, old: str, new: str, users: list[str]
) -> None:
    project.build()
    assert old in LIBRARY
    library.write_text(LIBRARY.replace(old, new), encoding="utf-8")
    assert rebuilt(project, compiled) == sorted(["lib.osc", *users])
    library.write_text(LIBRARY, encoding="utf-8")
    assert rebuilt(project, compiled) == []  # what another branch had is known as well
    library.write_text(LIBRARY.replace(old, new) + "\n# again\n", encoding="utf-8")
    assert rebuilt(project, compiled) == ["lib.osc"]


def test_a_mistake_in_a_library_compiles_its_users(
    project: Project, compiled: list[str], library: Path
) -> None:
    project.build()
    library.write_text(LIBRARY + "\nstruct wrong:\n    x: nothing\n", encoding="utf-8")
    compiled.clear()
    result = project.build()
    assert sorted(compiled) == ["brisk.osc", "derived.osc", "lib.osc", "limited.osc"]
    assert {each.job.name for each in result.results if not each.is_complete} == set(compiled)


def test_a_clone_elsewhere_knows_all(
    project: Project, compiled: list[str], library: Path, tmp_path: Path, cache: Path
) -> None:
    project.build()
    texts = [path.read_bytes() for path in cache.rglob("*") if path.is_file()]
    assert not any(str(tmp_path).encode() in text for text in texts)
    compiled.clear()
    clone = project.copy(tmp_path / "some/where/else")
    clone.build()
    assert (compiled, contents(clone.out)) == ([], contents(project.out))
    shutil.rmtree(clone.out)
    clone.build()
    assert (compiled, contents(clone.out)) == ([], contents(project.out))


def test_a_folder_of_the_cache_can_be_named(
    project: Project, compiled: list[str], tmp_path: Path
) -> None:
    from osc2tx.building.build import BuildOptions, build

    project.drive("a.osc")
    options = BuildOptions(cache=tmp_path / "shared")
    for _ in range(2):
        build([project.sources], project.out, GivenOptions(), options)
    assert compiled == ["a.osc"]
    assert any((tmp_path / "shared/results").rglob("*"))


@pytest.mark.parametrize(
    "text, is_used",
    [
        ("actor car inherits vehicle:\n    x: int = 1\n", True),
        ("actor other inherits car(kind: 3):\n    x: int = 1\n", True),
        ("extend car:\n    x: int = 1\n", True),
        ("action car.jump:\n    x: int = 1\n", False),
        ("enum kind: [car, bus]\n", True),
        ("scenario another:\n    mine: car\n", False),
        ("struct |my car|:\n    x: int = 1\n", True),
        ("import car\n", True),
    ],
)
def test_names_lead_to_declarations(text: str, is_used: bool) -> None:
    source = "scenario top:\n    it: car\n"
    before = used_digest(source, [UsedFile("lib.osc", "enum other: [a]\n")], "asam")
    after = used_digest(source, [UsedFile("lib.osc", "enum other: [a]\n" + text)], "asam")
    assert (before != after) is is_used
