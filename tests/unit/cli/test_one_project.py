"""One project: whatever path is named, every command has the answer of the project."""

import io
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest

from osc2tx_shared.map_files import SHIPPED
from tests.end_to_end.test_imported_modules import imports_in
from tests.unit.building.projects import contents, listing
from tests.unit.cli.shell import Shell

HEAD = "import osc.standard.all\n"
USE = "\nnamespace null use std, stdtypes\n\n"
SPEEDS = HEAD + USE + "struct speeds:\n    town: speed = 30kph\n"
LIMITS = HEAD + USE + "struct limits:\n    top: speed = 50kph\n"
CUT_IN = f"""{HEAD}import lib.speeds
import oem.limits
{USE}scenario {{name}}:
    ego: vehicle
    mine: speeds
    law: limits
    do serial:
        ego.drive(duration: 1s) with:
            speed(mine.town)
        ego.drive(duration: 1s) with:
            speed(law.top)
"""


@pytest.fixture
def project(shell: Shell) -> Shell:
    """Two folders of sources, whose files import each other, in folders of their own."""
    shell.write(
        "osc2tx.toml", 'sources = ["scenarios", "shared"]\nout = "generated"\ntarget = "py"\n'
    )
    shell.write("scenarios/lib/speeds.osc", SPEEDS)
    shell.write("shared/oem/limits.osc", LIMITS)
    shell.write("scenarios/urban/cut_in.osc", CUT_IN.format(name="cut_in"))
    shell.write("scenarios/rural/follow.osc", CUT_IN.format(name="follow"))
    return shell


FILE = "scenarios/urban/cut_in.osc"


@pytest.mark.parametrize(
    "command", ["check", "run --max-time 5", "tree", "build --emit py", "fmt --check", "build"]
)
@pytest.mark.parametrize("folder", [".", "scenarios/urban"])
def test_a_file_has_the_roots_of_its_project(
    project: Shell, monkeypatch: pytest.MonkeyPatch, command: str, folder: str
) -> None:
    name, *options = command.split()
    monkeypatch.chdir(project.folder / folder)
    path = Path(FILE).name if folder != "." else FILE
    ended = project(name, path, *options)
    assert (ended.code, "OSC" in ended.err) == (0, False), ended.err


def test_the_text_of_an_editor_has_them_too(
    project: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (project.folder / FILE).read_bytes()
    monkeypatch.setattr(sys, "stdin", SimpleNamespace(buffer=io.BytesIO(text)))
    assert project("check", "-", "--stdin-filename", FILE).code == 0


def test_all_sources_make_one_tree_of_modules(project: Shell) -> None:
    assert project("build").code == 0
    out = project.folder / "generated"
    modules = [name for name in listing(out) if name.endswith(".py")]
    assert modules == ["lib/speeds.py", "oem/limits.py", "rural/follow.py", "urban/cut_in.py"]
    text = (out / "urban/cut_in.py").read_text(encoding="utf-8")
    assert imports_in(text) == {"lib.speeds": ["Speeds"], "oem.limits": ["Limits"]}
    assert "A copy" not in text


def outputs(project: Shell) -> dict[str, bytes]:
    return contents(project.folder / "generated")


def test_the_name_of_a_part_makes_the_same_files(project: Shell) -> None:
    assert project("build").code == 0
    before = outputs(project)
    for path in ("scenarios/urban", FILE, "scenarios", "."):
        ended = project("build", path, "--prune")
        assert (ended.code, ended.err) == (0, ""), path
        assert outputs(project) == before, path
        assert project("build", "--check").code == 0


def test_importing_modules_leaves_the_path_of_the_search_alone(
    project: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert project("build").code == 0
    monkeypatch.syspath_prepend(project.folder / "generated")
    path = list(sys.path)
    for name in ("urban.cut_in", "rural.follow"):
        module = import_module(name)
        assert module.Speeds is import_module("lib.speeds").Speeds
    assert sys.path == path
    for name in [
        each for each in sys.modules if each.partition(".")[0] in ("urban", "rural", "lib", "oem")
    ]:
        del sys.modules[name]


def test_a_module_in_a_folder_is_a_script(project: Shell) -> None:
    assert project("build").code == 0
    script = project.folder / "generated/urban/cut_in.py"
    ended = subprocess.run(
        [sys.executable, script, "--max-time", "5"], capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, ended.stderr
    assert project("run", script).code == 0


def test_a_library_of_the_import_paths_has_a_module_of_its_own(project: Shell) -> None:
    settings = (
        'sources = ["scenarios"]\nimport_paths = ["shared"]\nout = "generated"\ntarget = "py"\n'
    )
    project.write("osc2tx.toml", settings)
    assert project("build").code == 0
    out = project.folder / "generated"
    assert (out / "oem/limits.py").is_file()
    assert imports_in((out / "rural/follow.py").read_text(encoding="utf-8")) == {
        "lib.speeds": ["Speeds"],
        "oem.limits": ["Limits"],
    }


def test_a_library_that_another_hides_is_copied(project: Shell) -> None:
    settings = (
        'sources = ["scenarios"]\nimport_paths = ["shared"]\nout = "generated"\ntarget = "py"\n'
    )
    project.write("osc2tx.toml", settings)
    project.write("scenarios/oem/limits.osc", LIMITS.replace("limits", "others"))
    text = CUT_IN.format(name="cut_in").replace(
        "import oem.limits", 'import "../../shared/oem/limits.osc"'
    )
    project.write(FILE, text)
    project.write("scenarios/rural/follow.osc", text.replace("cut_in", "follow"))
    assert project("build").code == 0
    made = (project.folder / "generated/urban/cut_in.py").read_text(encoding="utf-8")
    assert "# A copy from ../shared/oem/limits.osc" in made
    assert imports_in(made) == {"lib.speeds": ["Speeds"]}


# --- Links --------------------------------------------------------------------------------------


def test_a_link_to_a_source_is_that_source(project: Shell) -> None:
    (project.folder / "scenarios/a_first.osc").symlink_to("urban/cut_in.osc")
    (project.folder / "scenarios/rural/other.osc").symlink_to("../../shared/oem/limits.osc")
    assert project("build").code == 0
    made = [n for n in listing(project.folder / "generated") if n.endswith(".py")]
    assert made == ["lib/speeds.py", "oem/limits.py", "rural/follow.py", "urban/cut_in.py"]
    (project.folder / FILE).write_text(CUT_IN.format(name="changed"), encoding="utf-8")
    assert project("build", "--check").code == 1
    assert project("build", "scenarios/a_first.osc").code == 0
    assert project("build", "--check").code == 0


def test_no_link_leads_out_of_a_project(
    project: Shell, tmp_path_factory: pytest.TempPathFactory
) -> None:
    other = tmp_path_factory.mktemp("other")
    (other / "osc2tx.toml").write_text("", encoding="utf-8")
    (other / "secret.osc").write_text("password\n", encoding="utf-8")
    (project.folder / "scenarios/link.osc").symlink_to(other / "secret.osc")
    ended = project("check", "scenarios")
    assert (ended.code, "password" in ended.err) == (4, False)
    assert "is a link to a file outside of the folder" in ended.err


# --- Settings for many files ----------------------------------------------------------------------


def test_warnings_are_ignored_by_pattern(project: Shell) -> None:
    for name in ("urban/unused", "rural/unused"):
        text = CUT_IN.format(name="unused").replace("    mine:", "    spare: speeds\n    mine:")
        project.write(f"scenarios/{name}.osc", text)
    assert project("check").err.count("OSC437") == 3  # with the line that explains it
    settings = (project.folder / "osc2tx.toml").read_text(encoding="utf-8")
    project.write("osc2tx.toml", settings + '[files."urban/**"]\nignore = ["OSC437"]\n')
    for command in ("check", "build"):
        err = project(command).err
        assert ("rural/unused" in err, "urban/unused" in err) == (True, False)
    project.write("osc2tx.toml", settings + '[files."town/*"]\nstd = "2.2"\n')
    assert 'osc2tx.toml: [files."town/*"] matches no file' in project("check").err


def test_maps_of_the_project(project: Shell) -> None:
    text = CUT_IN.format(name="cut_in").replace(
        "    ego:", '    road: map with:\n        keep(it.map_file == "town.xodr")\n    ego:', 1
    )
    project.write(FILE, text)
    assert "OSC443" in project("check", FILE).err
    shipped = (SHIPPED / "highway.xodr").read_text(encoding="utf-8")
    project.write("maps/town.xodr", shipped)
    settings = (project.folder / "osc2tx.toml").read_text(encoding="utf-8")
    project.write("osc2tx.toml", 'map_paths = ["maps"]\n' + settings)
    assert project("check", FILE).err == ""
    assert project("run", FILE, "--max-time", "5").code == 0
