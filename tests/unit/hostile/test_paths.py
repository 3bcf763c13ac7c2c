"""Names of files and folders never become code, never leave the output folder, never collide."""

import sys
from collections.abc import Mapping
from importlib.metadata import requires
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from osc2tx import cli
from osc2tx.backends.py_trees.naming import module_name
from osc2tx.building.build import BuildOptions, BuildResult, build
from osc2tx.config import GivenOptions
from osc2tx.support.paths import is_portable
from osc2tx.support.python_modules import is_taken
from tests.processes import forked
from tests.unit.building.projects import DRIVE, contents, drive, listing, write
from tests.unit.hostile.texts import MULTILINE, TEXTS, skeleton, strings

LONG = 200
STEMS = [text for text in [*TEXTS, *MULTILINE] if not set(text) & set("/\0") and text != ".."]
STEMS += ["a.py", "a.map", "x" * LONG, "-j", "__main__", "osc2tx", "aux", "COM1", "lpt9.x"]
FOLDERS = [stem for stem in STEMS if stem.strip()]


@pytest.fixture(autouse=True)
def no_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")


@pytest.fixture(scope="module")
def harmless(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("harmless")
    drive(folder / "in/harmless.osc")
    made(folder)
    return (folder / "out/harmless.py").read_text(encoding="utf-8")


def made(folder: Path, **options: bool) -> BuildResult:
    """Build `in` to `out`; nothing else may come into being."""
    before = contents(folder)
    result = build(
        [folder / "in"], folder / "out", GivenOptions(target="py"), BuildOptions(**options)
    )
    after = contents(folder)
    assert {name for name in after if after[name] != before.get(name)} <= {
        name for name in after if name.startswith("out/")
    }
    assert set(before) <= set(after)
    return result


def written(path: Path) -> Path:
    try:
        return drive(path)
    except OSError as error:
        pytest.skip(f"this file system has no such names: {error}")


def written_each(folder: Path, places: Mapping[str, str]) -> list[tuple[Path, str]]:
    """Write a source for each text, in a folder of its own; return where the outputs of it go."""
    found = []
    for number, (text, place) in enumerate(places.items()):
        try:
            drive(folder / "in" / f"d{number}" / place)
        except OSError:
            continue  # this file system has no such names
        found.append((folder / "out" / f"d{number}", text))
    assert found
    return found


@pytest.mark.slow
def test_file_names(tmp_path: Path, harmless: str) -> None:
    stems = written_each(tmp_path, {stem: f"{stem}.osc" for stem in STEMS})
    result = made(tmp_path)
    assert (result.collisions, result.failures, result.bugs) == ((), (), ())
    for folder, stem in stems:
        (module,) = folder.glob("*.py")
        assert module.stem.isidentifier(), stem
        assert is_portable(module.name), stem
        text = module.read_text(encoding="utf-8")
        assert skeleton(text) == skeleton(harmless), stem
        known = [s.replace("harmless.osc", f"{folder.name}/{stem}.osc") for s in strings(harmless)]
        assert strings(text) == known


@pytest.mark.slow
def test_folder_names(tmp_path: Path, harmless: str) -> None:
    names = written_each(tmp_path, {name: f"{name}/harmless.osc" for name in FOLDERS})
    result = made(tmp_path)
    assert result.failures == ()
    problems = list(result.collisions)
    for folder, name in names:
        modules = [path for path in folder.rglob("*.py") if path.is_file()]
        if is_portable(name):
            (module,) = modules
            assert module.parent.name == name
            assert skeleton(module.read_text(encoding="utf-8")) == skeleton(harmless), name
        else:
            assert modules == [], name
            said = f"not every system can have a folder {name!r}"
            (problem,) = (each for each in problems if said in each and f"/{folder.name}/" in each)
            problems.remove(problem)
    assert problems == []


@pytest.mark.parametrize(
    "names",
    [
        ("a.osc", "A.osc"),
        ("Sub/a.osc", "sub/a.osc"),
        ("a-b.osc", "a_b.osc"),
        ("a b.osc", "a_b.osc"),
        ("class.osc", "class_.osc"),
        ("con.osc", "con_.osc"),
        ("1.osc", "x_1.osc"),
        ("_x.osc", "x_x.osc"),
        ("\ufb01x.osc", "fix.osc"),
        ("\u00e9.osc", "e\u0301.osc"),
        ("d\u00e9/x.osc", "de\u0301/x.osc"),
        ("stra\u00dfe.osc", "strasse.osc"),
        ("\u212aelvin.osc", "kelvin.osc"),
        ("{{x}}.osc", "__x__.osc", "'}x}'.osc"),
        ("a.py/b.osc", "a.osc"),
        ("A.PY/b.osc", "a.osc"),
    ],
    ids=ascii,
)
def test_collisions(tmp_path: Path, names: tuple[str, ...]) -> None:
    for name in names:
        written(tmp_path / "in" / name)
    if len(list((tmp_path / "in").rglob("*.osc"))) < len(names):
        pytest.skip("this file system takes these names for one")
    drive(tmp_path / "in/other.osc")
    result = made(tmp_path)
    (problem,) = result.collisions
    for name in names:
        assert str(tmp_path / "in" / name) in problem or ".py" in names[0].lower()
    assert "other.py" in listing(tmp_path / "out")
    assert result.modules == (2 if ".py" in names[0].lower() else 1)


# --- names of other modules ---


@pytest.mark.parametrize("stem", ["json", "typing", "lxml", "osc2tx_runtime", "conftest"])
def test_a_module_hides_no_other(tmp_path: Path, stem: str) -> None:
    drive(tmp_path / f"in/{stem}.osc")
    result = made(tmp_path)
    (report,) = [report for each in result.results for report in each.reports]
    assert (report.code, f"the module has the name `{stem}_`" in report.message) == ("OSC517", True)
    assert listing(tmp_path / "out") == [f"{stem}_.map.json", f"{stem}_.py"]


def test_all_modules_of_this_python_are_known() -> None:
    public = {name for name in sys.stdlib_module_names if not name.startswith("_")}
    assert {name for name in public if not is_taken(name)} == set()
    assert all(module_name(f"a/{name}.osc") not in sys.stdlib_module_names for name in public)
    hidden = {name for name in sys.stdlib_module_names if name.startswith("_")}
    assert hidden.isdisjoint(map(module_name, hidden))


def test_what_the_runtime_requires_is_known() -> None:
    required = [Requirement(text).name for text in requires("osc2tx-runtime") or ()]
    assert required
    assert all(is_taken(name.replace("-", "_")) for name in required)


# --- links ---


def test_a_folder_of_outputs_that_is_a_link(tmp_path: Path) -> None:
    drive(tmp_path / "in/sub/a.osc")
    drive(tmp_path / "in/b.osc")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out/sub").symlink_to(tmp_path / "elsewhere")
    result = made(tmp_path, force=True)
    assert contents(tmp_path / "elsewhere") == {}
    assert all("a folder on the way is a link" in failure for failure in result.failures)
    assert len(result.failures) == 2
    assert (tmp_path / "out/b.py").exists()


@pytest.mark.parametrize("force", [False, True])
def test_an_output_that_is_a_link(tmp_path: Path, force: bool) -> None:
    drive(tmp_path / "in/a.osc")
    target = write(tmp_path / "elsewhere/target", "precious")
    (tmp_path / "out").mkdir()
    (tmp_path / "out/a.py").symlink_to(target)
    result = made(tmp_path, force=force)
    assert target.read_text() == "precious"
    assert (tmp_path / "out/a.py").is_symlink() is not force
    assert bool(result.remaining()) is not force


def test_a_source_that_is_a_link_out_of_the_folder_is_not_read(tmp_path: Path) -> None:
    secret = write(tmp_path / "elsewhere/secret", "password = hunter2\n")
    drive(tmp_path / "in/a.osc")
    (tmp_path / "in/b.osc").symlink_to(secret)
    result = made(tmp_path)
    (report,) = [report for r in result.results for report in r.reports]
    assert (report.code, "hunter2" in repr(report)) == ("OSC101", False)
    assert listing(tmp_path / "out") == ["a.map.json", "a.py"]


def test_a_link_within_the_folder_is_one_file_of_two_names(tmp_path: Path) -> None:
    drive(tmp_path / "in/sub/a.osc")
    (tmp_path / "in/b.osc").symlink_to("sub/a.osc")
    assert made(tmp_path).modules == 1


def test_a_folder_of_sources_that_is_a_link_is_not_followed(tmp_path: Path) -> None:
    drive(tmp_path / "elsewhere/b.osc")
    drive(tmp_path / "in/a.osc")
    (tmp_path / "in/link").symlink_to(tmp_path / "elsewhere")
    (tmp_path / "in/loop").symlink_to(tmp_path / "in")
    made(tmp_path)
    assert listing(tmp_path / "out") == ["a.map.json", "a.py"]


def test_a_file_somebody_names_may_be_a_link(tmp_path: Path) -> None:
    drive(tmp_path / "elsewhere/b.osc")
    (tmp_path / "a.osc").symlink_to(tmp_path / "elsewhere/b.osc")
    assert build([tmp_path / "a.osc"], tmp_path / "out", GivenOptions()).modules == 1


@pytest.mark.parametrize("name", ["-o.osc", "--help.osc", "@x.osc", "$HOME.osc", "*.osc"])
def test_names_on_the_command_line(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text(DRIVE.format(name="top", speed=30))
    ended = forked(lambda: cli.main(["build", "-o", "out", "--", name]), folder=tmp_path)
    assert ended.code == 0, ended.err
    assert len(list((tmp_path / "out").glob("*.py"))) == 1
