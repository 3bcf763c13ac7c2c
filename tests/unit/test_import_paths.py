"""The search path of modules: `-I`, `import_paths`, and what must not be read (§7.7.5.1.2)."""

import os
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigError, ConfigFiles, GivenOptions
from osc2tx.options import CompileOptions
from tests.unit.building.projects import write
from tests.unit.building.test_libraries import DRIVE, TYPES
from tests.unit.cli.shell import Shell

COLORS = "enum paint: [{}]\n"
USE = "global shade: paint = paint!{}\n"


def compiled(source: Path, *folders: Path) -> Compilation:
    paths = tuple(map(str, folders))
    compilation = Compilation(source, source.name, CompileOptions(import_paths=paths))
    compilation.check()
    return compilation


def reports(compilation: Compilation) -> list[tuple[str, str, str | None]]:
    return [(found.code, found.message, found.help) for found in compilation.diagnostics]


def main(folder: Path, module: str = "company.colors", use: str = "") -> Path:
    return write(folder / "in/a.osc", f"import {module}\n{use}")


# --- Order --------------------------------------------------------------------------------------


def test_folders_count_in_their_order(tmp_path: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    write(one / "company/colors.osc", COLORS.format("red"))
    write(two / "company/colors.osc", COLORS.format("green"))
    source = main(tmp_path, use=USE.format("red"))
    assert reports(compiled(source, one, two)) == []
    assert [code for code, _, _ in reports(compiled(source, two, one))] == ["OSC208"]


def test_the_project_goes_before_libraries(tmp_path: Path) -> None:
    write(tmp_path / "lib/company/colors.osc", COLORS.format("green"))
    write(tmp_path / "in/company/colors.osc", COLORS.format("red"))
    source = main(tmp_path, use=USE.format("red"))
    assert reports(compiled(source, tmp_path / "lib")) == []


def test_a_library_imports_its_own_files_and_other_libraries(tmp_path: Path) -> None:
    head = 'import base.names\nimport "sizes.osc"\n'
    write(tmp_path / "one/company/colors.osc", head + COLORS.format("red"))
    write(tmp_path / "one/company/sizes.osc", "enum size: [small]\n")
    write(tmp_path / "two/base/names.osc", "enum title: [sir]\n")
    use = "global a: size = size!small\nglobal b: title = title!sir\n"
    assert reports(compiled(main(tmp_path, use=use), tmp_path / "one", tmp_path / "two")) == []


# --- Not found ----------------------------------------------------------------------------------


def test_what_is_nowhere_lists_the_folders_and_a_similar_module(tmp_path: Path) -> None:
    lib, gone = tmp_path / "lib", tmp_path / "gone"
    write(lib / "company/colors.osc", COLORS.format("red"))
    source = main(tmp_path, "compny.colours")
    looked = f"looked for `compny/colours.osc` beside this file, `{lib}`, `{gone}` (no folder)"
    assert reports(compiled(source, lib, gone)) == [
        ("OSC205", "no module `compny.colours`", f"did you mean `company.colors`? {looked}")
    ]
    source = main(tmp_path, "something.else_")
    ((_, _, found),) = reports(compiled(source, lib))
    assert found == f"looked for `something/else_.osc` beside this file, `{lib}`"


def test_links_are_no_similar_modules(tmp_path: Path) -> None:
    write(tmp_path / "secret/colors.osc", COLORS.format("red"))
    lib = tmp_path / "lib"
    lib.mkdir()
    (lib / "company").symlink_to(tmp_path / "secret")
    ((_, _, found),) = reports(compiled(main(tmp_path, "compny.colors"), lib))
    assert "did you mean" not in (found or "")


# --- Hostile ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "module",
    ["|..|.secret", "company.|../../secret|", "|{root}/secret|", "|.|.secret", "|.hidden|",
     "|c:|.secret", r"|..\\secret|", "|a\tb|"],
)  # fmt: skip
def test_names_that_are_no_names_of_files(tmp_path: Path, module: str) -> None:
    secret = write(tmp_path / "secret.osc", "enum secret: [a]\n")
    write(tmp_path / "lib/.hidden.osc", "enum secret: [a]\n")
    compilation = compiled(main(tmp_path, module.format(root=tmp_path)), tmp_path / "lib")
    ((code, message, _),) = reports(compilation)
    assert (code, message.endswith("is not a name of a module")) == ("OSC205", True)
    assert str(secret) not in map(str, compilation.lookups)


@pytest.mark.parametrize("link", ["lib/company", "lib/company/colors.osc"])
def test_links_out_of_the_folders_are_refused(tmp_path: Path, link: str) -> None:
    secret = write(tmp_path / "secret/colors.osc", COLORS.format("red"))
    place = tmp_path / link
    place.parent.mkdir(parents=True)
    place.symlink_to(secret if place.suffix else secret.parent)
    ((code, message, _),) = reports(compiled(main(tmp_path), tmp_path / "lib"))
    assert (code, "is outside" in message) == ("OSC205", True)


def test_a_library_reaches_nothing_outside(tmp_path: Path) -> None:
    write(tmp_path / "secret.osc", "enum secret: [a]\n")
    write(tmp_path / "lib/company/colors.osc", 'import "../../secret.osc"\n')
    ((code, message, _),) = reports(compiled(main(tmp_path), tmp_path / "lib"))
    assert (code, "is outside" in message) == ("OSC205", True)


def test_the_folder_itself_may_be_a_link(tmp_path: Path) -> None:
    write(tmp_path / "real/company/colors.osc", COLORS.format("red"))
    (tmp_path / "lib").symlink_to(tmp_path / "real")
    source = main(tmp_path, use=USE.format("red"))
    assert reports(compiled(source, tmp_path / "lib")) == []


def test_names_with_dots_and_blanks_are_names_of_files(tmp_path: Path) -> None:
    write(tmp_path / "lib/my parts/v1.2.osc", COLORS.format("red"))
    source = main(tmp_path, "|my parts|.|v1.2|", use=USE.format("red"))
    assert reports(compiled(source, tmp_path / "lib")) == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no such files")
def test_a_pipe_is_no_library(tmp_path: Path) -> None:
    (tmp_path / "lib/company").mkdir(parents=True)
    os.mkfifo(tmp_path / "lib/company/colors.osc")
    assert len(reports(compiled(main(tmp_path), tmp_path / "lib"))) == 1


# --- Settings -----------------------------------------------------------------------------------


def test_settings_count_from_their_file_and_the_command_line_goes_before(tmp_path: Path) -> None:
    write(tmp_path / "p/osc2tx.toml", 'import_paths = ["../lib", "more"]\n')
    source = tmp_path / "p/in/a.osc"
    config = ConfigFiles().for_source(source)
    found = config.options_for(source, GivenOptions()).import_paths
    assert [os.path.normpath(each) for each in found] == [f"{tmp_path}/lib", f"{tmp_path}/p/more"]
    given = GivenOptions(import_paths=("/x",))
    assert config.options_for(source, given).import_paths == ("/x",)


@pytest.mark.parametrize("value", ["3", "[1]", '["a\\u0000b"]', "true"])
def test_settings_of_the_wrong_form(tmp_path: Path, value: str) -> None:
    write(tmp_path / "osc2tx.toml", f"import_paths = {value}\n")
    with pytest.raises(ConfigError, match="import_paths"):
        ConfigFiles().for_folder(tmp_path)


# --- Commands -----------------------------------------------------------------------------------


@pytest.mark.parametrize("command", ["check", "build --emit py", "run --max-time 5", "tree"])
def test_commands_look_in_the_folders(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    command: str,
) -> None:
    osc2tx = Shell(capsys, tmp_path)
    name, *options = command.split()
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "in/a.osc", DRIVE)
    write(tmp_path / "lib/company/limits.osc", TYPES.format(30))
    arguments = (name, "in/a.osc", *options)
    assert "OSC205" in osc2tx(*arguments).err
    assert osc2tx(*arguments, "-I", "more", "-I", "lib").code == 2  # there is no `more`
    (tmp_path / "more").mkdir()
    assert osc2tx(*arguments, "-I", "more", "-I", "lib").code == 0
    write(tmp_path / "osc2tx.toml", 'import_paths = ["lib"]\n')
    assert osc2tx(*arguments).code == 0
