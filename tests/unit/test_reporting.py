"""How commands report: forms, streams, exit codes."""

import json
from pathlib import Path

import pytest

from osc2tx import cli
from tests.unit.cli.shell import DRIVE, Ended, Shell

EVENT = "import osc.standard\n\nscenario top:\n    do serial:\n        wait @go{}\n"
BAD = "scenario top:\n  hero: vehicel\n"


@pytest.fixture
def shell(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Shell:
    monkeypatch.chdir(tmp_path)
    return Shell(capsys, tmp_path)


def carla(shell: Shell, *arguments: str) -> Ended:
    return shell(*arguments, "--dialect", "carla", "a.osc")


# --- forms ---


def test_json_alone_goes_to_stdout(shell: Shell) -> None:
    shell.write("sub/b.osc", BAD)
    shell.write("sub/a.osc", BAD)
    ended = shell("check", "--output-format", "json", "sub")
    assert ended.code == 3
    document = json.loads(ended.out)
    assert [d["location"]["file"] for d in document["diagnostics"]] == ["sub/a.osc", "sub/b.osc"]
    assert document["summary"] == {"files": 2, "errors": 2, "warnings": 0, "suppressed": 0}
    assert ended.err == "checked 2 files: 2 errors, 0 warnings\n"
    assert shell("check", "--output-format", "json", "sub").out == ended.out


def test_sarif_and_github(shell: Shell) -> None:
    shell.write("a.osc", BAD)
    document = json.loads(shell("check", "--output-format", "sarif", "a.osc").out)
    assert document["runs"][0]["results"][0]["ruleId"] == "OSC202"
    out = shell("check", "--output-format", "github", "a.osc").out
    assert out.startswith("::error file=a.osc,line=2,endLine=2,col=9,endColumn=15,title=OSC202 ")


def test_a_file_that_cannot_be_read_has_a_place(shell: Shell) -> None:
    (shell.folder / "a.osc").write_bytes(b"\0")
    ended = shell("check", "a.osc")
    assert ended.code == 4
    assert ended.err.splitlines()[0].startswith("a.osc:1:1: error[OSC101]: cannot read `a.osc`")
    assert ended.err.splitlines()[1] == "  help: is it a text file in UTF-8?"
    out = shell("check", "a.osc", "--output-format", "github").out
    assert out.startswith("::error file=a.osc,line=1,")


def test_a_document_for_nothing_to_report(shell: Shell) -> None:
    shell.drive("a.osc")
    assert json.loads(shell("check", "--output-format", "json", "a.osc").out)["diagnostics"] == []
    assert shell("check", "--output-format", "github", "a.osc").out == ""


def test_build_and_run_have_the_same_forms(shell: Shell) -> None:
    shell.drive("a.osc")
    ended = shell("build", "a.osc", "-o", "out", "--output-format", "json")
    assert json.loads(ended.out)["summary"]["files"] == 1
    assert ended.err == "1 module in out: 3 files written; 0 errors, 0 warnings\n"
    for file in ("a.osc", "out/a.py"):
        ended = shell("run", file, "--output-format", "json")
        assert ended.code == 0
        assert json.loads(ended.out)["diagnostics"] == []
        assert ended.err.startswith("top: success")


def test_emit_does_not_mix_with_a_form(shell: Shell) -> None:
    shell.drive("a.osc")
    assert shell("build", "a.osc", "--emit", "ast", "--output-format", "json").code == 2


def test_a_bug_of_ours_leaves_a_document(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    from osc2tx.compilation.driver import Compilation

    def broken(self: Compilation) -> bool:
        raise AssertionError("planted")

    monkeypatch.setattr(Compilation, "check", broken)
    shell.drive("a.osc")
    with pytest.raises(SystemExit) as caught:
        cli.main(["check", "--no-cache", "--output-format", "sarif", "a.osc"])
    captured = shell.capsys.readouterr()
    assert caught.value.code == 70
    run = json.loads(captured.out)["runs"][0]
    assert run["invocations"] == [{"executionSuccessful": False}]
    assert "planted" in captured.err


# --- strict ---


@pytest.mark.parametrize(
    "command", [("check",), ("build", "-o", "out"), ("build", "--emit", "ir"), ("run",)]
)
def test_strict_counts_warnings(shell: Shell, command: tuple[str, ...]) -> None:
    shell.write("a.osc", EVENT.format(""))
    assert carla(shell, *command, "--strict").code == 1


def test_strict_is_content_with_suppressed_warnings_and_no_softer_on_errors(shell: Shell) -> None:
    shell.write("a.osc", EVENT.format("  #! allow OSC603"))
    ended = carla(shell, "check", "--strict")
    assert ended.code == 0
    assert ended.out.splitlines()[-1] == "checked 1 file: 0 errors, 0 warnings, 1 suppressed"
    shell.write("a.osc", BAD)
    assert carla(shell, "check", "--strict").code == 3


def test_without_strict_a_scenario_with_warnings_is_run(shell: Shell) -> None:
    text = DRIVE.format(name="top").replace("\n\n", "\nuse std.stdtypes\n")
    shell.write("a.osc", text)
    assert carla(shell, "run").code == 0
    assert carla(shell, "run", "--strict").out == ""


# --- how many ---


def avalanche(shell: Shell) -> None:
    fields = "".join(f"  a{number}: nothing{number}\n" for number in range(60))
    shell.write("a.osc", "scenario top:\n" + fields)


def test_readers_are_spared_an_avalanche_and_programs_are_not(shell: Shell) -> None:
    avalanche(shell)
    ended = shell("check", "a.osc")
    assert ended.err.count("error[OSC202]") == 50
    assert "\na.osc: 10 more not shown\n" in ended.err
    assert ended.out == "checked 1 file: 60 errors, 0 warnings\n"
    assert len(json.loads(shell("check", "--output-format", "json", "a.osc").out)["hidden"]) == 0
    assert shell("check", "--output-format", "github", "a.osc").out.count("::error") == 50


def test_the_number_can_be_chosen(shell: Shell) -> None:
    avalanche(shell)
    ended = shell("check", "a.osc", "--max-diagnostics", "0")
    assert ended.err.count("error[OSC202]") == 60
    assert "not shown" not in ended.err
    out = shell("check", "a.osc", "--output-format", "json", "--max-diagnostics", "7").out
    document = json.loads(out)
    assert len(document["diagnostics"]) == 7
    assert document["hidden"] == [{"file": "a.osc", "count": 53}]
    assert shell("check", "a.osc", "--max-diagnostics", "-1").code == 2


def test_explain_is_mentioned_once(shell: Shell) -> None:
    for name in ("a.osc", "b.osc"):
        shell.write(f"in/{name}", BAD)
    assert shell("check", "in").err.count("osc2tx explain") == 1


# --- suppressions across files ---


def test_a_comment_is_used_if_one_importer_needs_it(shell: Shell) -> None:
    shell.write("in/lib.osc", EVENT.format("  #! allow OSC603"))
    shell.write("in/a.osc", 'import "lib.osc"\n')
    ended = shell("check", "in", "--dialect", "carla")
    assert ended.out.splitlines()[-1] == "checked 2 files: 0 errors, 0 warnings, 1 suppressed"


# --- explain ---


def test_explain_shows_a_faulty_text_and_how_to_mend_it(shell: Shell) -> None:
    text = shell("explain", "unknown-type").out
    assert text == (
        "OSC202 unknown-type (error)\n\n"
        "No type has this name.\nSee OpenSCENARIO DSL 2.2, section 7.3.\n\n"
        "Faulty:\n\n    scenario top:\n        hero: vehicel\n\n"
        "Spell the type as it was declared, and import the file that declares it. The standard "
        "library needs `import osc.standard.all` and `namespace null use std, stdtypes`.\n\n"
        "Fixed:\n\n    scenario top:\n        hero: vehicle\n"
    )
    assert "Faulty (with --dialect carla):" in shell("explain", "OSC601").out
