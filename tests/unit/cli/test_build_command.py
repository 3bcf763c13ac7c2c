"""The command `build`: what it prints and returns in all its ways."""

import json
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from tests.processes import HANGING
from tests.unit.building.test_revision import git
from tests.unit.cli.shell import DRIVE, Shell


@pytest.fixture
def shell(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Shell:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / ".cache"))
    return Shell(capsys, tmp_path)


def build(shell: Shell, *arguments: str):  # type: ignore[no-untyped-def]
    return shell("build", "in", "-o", "out", "--target", "py", *arguments)


# --- edited, orphaned ---


def test_an_edited_output(shell: Shell) -> None:
    shell.drive("in/a.osc")
    build(shell)
    shell.write("out/a.py", "edited")
    ended = build(shell)
    assert ended.code == 1
    assert ended.err == "out/a.py: was edited by hand; --force overwrites it\n"
    assert ended.out == "1 module in out: 0 files written; 0 errors, 0 warnings\n"
    assert build(shell, "--force").code == 0
    assert build(shell, "--check").code == 0


def test_a_foreign_file(shell: Shell) -> None:
    shell.drive("in/a.osc")
    shell.write("out/a.py", "mine")
    assert build(shell, "--check").err == "out/a.py: was not made by osc2tx\n"
    assert build(shell).err == "out/a.py: was not made by osc2tx; --force overwrites it\n"
    assert (shell.folder / "out/a.py").read_text() == "mine"


def test_an_orphan(shell: Shell) -> None:
    shell.drive("in/a.osc")
    shell.drive("in/b.osc")
    build(shell)
    (shell.folder / "in/b.osc").unlink()
    line = "out/b.py: is orphaned: b.osc does not produce this file"
    ended = build(shell, "--check")
    assert (ended.code, ended.err.splitlines()) == (1, [line])
    assert ended.out == "1 module in out: 1 file would change; 0 errors, 0 warnings\n"
    ended = build(shell)
    assert (ended.code, ended.err.splitlines()) == (0, [f"{line}; --prune removes it"])
    ended = build(shell, "--prune")
    assert ended.out == "1 module in out: 0 files written, 2 removed; 0 errors, 0 warnings\n"
    assert build(shell, "--check").code == 0


def test_a_build_of_the_project_removes_what_lost_its_source(shell: Shell) -> None:
    shell.write("osc2tx.toml", 'sources = ["in"]\nout = "out"\n')
    shell.drive("in/a.osc")
    shell.drive("in/b.osc")
    assert shell("build").code == 0
    (shell.folder / "in/b.osc").rename(shell.folder / "in/c.osc")
    (shell.folder / "out/b.py").write_text("edited", encoding="utf-8")
    ended = shell("build")
    line = "out/b.py: is orphaned: b.osc does not produce this file"
    assert ended.err == f"{line}; it was edited; --prune --force removes it\n"
    assert shell("build", "--force").code == 0
    assert shell("build", "--check").code == 0
    assert not (shell.folder / "out/b.py").exists()


def test_check_in_a_workflow_of_github(shell: Shell) -> None:
    shell.drive("in/a.osc")
    ended = build(shell, "--check", "--output-format", "github")
    assert ended.code == 1
    assert ended.out.splitlines() == [
        "::error file=out/a.py,title=osc2tx stale-output::is missing",
    ]


# --- diffs ---


def test_diff(shell: Shell) -> None:
    shell.drive("in/a.osc")
    build(shell)
    text = DRIVE.format(name="top").replace("30kph", "31kph")
    shell.write("in/a.osc", text)
    ended = build(shell, "--diff")
    assert ended.code == 0
    changed = [line for line in ended.out.splitlines() if line[0] in "+-"]
    assert changed[:2] == ["--- a/out/a.py", "+++ b/out/a.py"]
    assert changed[2:] and all("30 * kph" in line or "31 * kph" in line for line in changed[2:])
    assert ended.err.splitlines() == [
        "out/a.py: is stale",
        "1 module in out: 1 file would change; 0 errors, 0 warnings",
    ]
    assert build(shell, "--diff", "--check").code == 1
    assert "30 * kph" in (shell.folder / "out/a.py").read_text()


def test_a_diff_can_be_applied(shell: Shell) -> None:
    shell.drive("in/a.osc")
    build(shell)
    shell.write("in/a.osc", DRIVE.format(name="top").replace("30kph", "31kph"))
    shell.drive("in/new.osc")
    patch = build(shell, "--diff").out
    git(shell.folder, "init", "-q")
    subprocess.run(["git", "apply"], input=patch, text=True, check=True, cwd=shell.folder)
    ended = build(shell, "--check")
    assert (ended.code, ended.err) == (0, "")


def test_a_diff_shows_hand_edits(shell: Shell) -> None:
    shell.drive("in/a.osc")
    build(shell)
    path = shell.folder / "out/a.py"
    path.write_text(path.read_text() + "# mine")
    out = build(shell, "--diff").out
    assert out.endswith("-# mine\n\\ No newline at end of file\n")


def test_diff_against(shell: Shell) -> None:
    shell.drive("in/a.osc")
    git(shell.folder, "init", "-q")
    git(shell.folder, "add", "in")
    git(shell.folder, "commit", "-qm", "one")
    assert build(shell, "--diff-against", "HEAD").out == ""
    shell.write("in/a.osc", DRIVE.format(name="top").replace("30kph", "31kph"))
    ended = build(shell, "--diff-against", "HEAD")
    assert ended.code == 0
    assert "-" in ended.out and "+" in ended.out and "31 * kph" in ended.out
    assert ended.err == "1 file changed since HEAD; 0 errors, 0 warnings\n"
    assert not (shell.folder / "out").exists()
    assert build(shell, "--diff-against", "nothing").code == 2


# --- settings ---


def test_sources_and_output_of_the_settings(shell: Shell) -> None:
    shell.drive("scenarios/a.osc")
    shell.write("pyproject.toml", '[tool.osc2tx]\nsources = ["scenarios"]\nout = "generated"\n')
    ended = shell("build")
    assert (ended.code, ended.out) == (
        0,
        "1 module in generated: 3 files written; 0 errors, 0 warnings\n",
    )
    assert shell("build", "--check").code == 0
    assert "3 files written" in shell("build", "-o", "other").out


@pytest.mark.parametrize("command", [("check", "in"), ("build", "in", "-o", "out")])
def test_a_table_for_no_file(shell: Shell, command: tuple[str, ...]) -> None:
    shell.drive("in/a.osc")
    path = shell.write("osc2tx.toml", "[scenarios.b]\n")
    ended = shell(*command)
    assert ended.code == 0
    assert ended.err == f"warning: {path}: [scenarios.b] matches no file: there is no `b.osc`\n"
    assert shell(*command, "--strict").code == 1


def test_config(shell: Shell) -> None:
    shell.drive("in/a.osc")
    shell.write("osc2tx.toml", 'std = "2.2"\n[scenarios.a]\ndialect = "carla"\n')
    shown = shell("config", "in/a.osc", "--one-of", "first", "--allow-approx").out.splitlines()
    assert [" ".join(line.split()) for line in shown] == [
        'std = "2.2" # osc2tx.toml',
        'dialect = "carla" # osc2tx.toml, [scenarios.a]',
        'one_of = "first" # command line',
        'target = "all" # default',
        'xml_version = "1.3" # default',
        'xml_profile = "generic" # default',
        "allow_approx = true # command line",
        "import_paths = [] # default",
    ]
    assert shell("config").out.splitlines()[1] == 'dialect = "asam"         # default'


def test_config_has_paths_as_one_would_write_them(shell: Shell, tmp_path: Path) -> None:
    shell.write(
        "osc2tx.toml",
        f'sources = ["in"]\nout = "made"\nimport_paths = ["lib", "{tmp_path.parent}/far"]\n'
        '[scenarios.a.run]\nmap-path = ["maps"]\n',
    )
    shell.drive("in/a.osc")
    shown = [
        line.partition("  #")[0].rstrip() for line in shell("config", "in/a.osc").out.splitlines()
    ]
    assert shown[-4:] == [
        f'import_paths = ["lib", "{tmp_path.parent}/far"]',
        'sources = ["in"]',
        'out = "made"',
        'run.map-path = ["maps"]',
    ]


# --- usage ---


@pytest.mark.parametrize(
    "arguments",
    [
        ("in",),
        ("-o", "out"),
        ("in", "-o", "out", "--watch", "--check"),
        ("in", "-o", "out", "--check", "--force"),
        ("in", "-o", "out", "--diff", "--prune"),
        ("in", "-o", "out", "--diff", "--diff-against", "HEAD"),
        ("in", "-o", "out", "--diff", "--output-format", "json"),
        ("in", "-o", "out", "-j", "0"),
        ("in", "--emit", "py", "--check"),
        ("--emit", "py"),
        ("in", "-o", "out", "--nonsense"),
    ],
)
def test_wrong_usage(shell: Shell, arguments: tuple[str, ...]) -> None:
    shell.drive("in/a.osc")
    assert shell("build", *arguments).code == 2


@pytest.mark.parametrize(
    "arguments",
    [
        ("check",),
        ("check", "nowhere"),
        ("check", "in", "--std", "9"),
        ("build", "in", "-o", "out", "--emit", "ast"),
        ("build", "in", "-o", "out"),
        ("nonsense",),
    ],
)
@pytest.mark.parametrize("separate", [True, False])
def test_a_document_for_programs_even_if_nothing_began(
    shell: Shell, arguments: tuple[str, ...], separate: bool
) -> None:
    shell.drive("in/a.osc")
    shell.write("in/osc2tx.toml", "nonsense = 1\n")

    def run(form: str) -> str:
        options = ["--output-format", form] if separate else [f"--output-format={form}"]
        ended = shell(*arguments, *options)
        assert ended.code in (2, 4)
        assert ended.err
        return ended.out

    document = json.loads(run("json"))
    assert (document["diagnostics"], bool(document["failure"])) == ([], True)
    (invocation,) = json.loads(run("sarif"))["runs"][0]["invocations"]
    assert invocation["executionSuccessful"] is False
    assert invocation["toolExecutionNotifications"][0]["level"] == "error"
    assert run("github").startswith("::error title=osc2tx::")
    assert run("text") == ""


def test_one_document_if_a_run_cannot_begin(shell: Shell) -> None:
    shell.write("a.osc", "enum color: [red]\n")
    ended = shell("run", "a.osc", "--output-format", "json")
    assert ended.code == 2
    assert json.loads(ended.out)["failure"] == "a.osc declares no scenario"


# --- watch ---


def test_watch_builds_again(tmp_path: Path) -> None:
    source = tmp_path / "in/a.osc"
    source.parent.mkdir()
    source.write_text(DRIVE.format(name="top"))
    process = subprocess.Popen(
        [sys.executable, "-m", "osc2tx", "build", "in", "-o", "out", "--target", "py", "--watch"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    timer = threading.Timer(HANGING, process.kill)
    timer.start()
    assert process.stdout is not None and process.stderr is not None
    try:
        assert "2 files written" in process.stdout.readline()
        source.write_text(DRIVE.format(name="top").replace("30kph", "31kph"))
        assert "1 file written" in process.stdout.readline()
        (tmp_path / "in/osc2tx.toml").write_text("nonsense = 1\n")
        assert "unknown key `nonsense`" in process.stderr.readline()
        (tmp_path / "in/osc2tx.toml").unlink()
        assert "0 files written" in process.stdout.readline()
        process.send_signal(2)
        assert process.wait() == 130
    finally:
        timer.cancel()
        process.kill()
        process.wait()
    assert "31 * kph" in (tmp_path / "out/a.py").read_text()


# --- completion ---


@pytest.mark.parametrize(
    ("words", "word", "expected"),
    [
        ("osc2tx bu", "bu", "build"),
        ("osc2tx build --ch", "--ch", "--check"),
        ("osc2tx build --std 2", "2", "2.1"),
        ("osc2tx explain OSC10", "OSC10", "OSC104"),
        ("osc2tx check sc", "sc", "file"),
    ],
)
def test_completion(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: str,
    word: str,
    expected: str,
) -> None:
    from osc2tx import cli

    monkeypatch.setenv("_OSC2TX_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(len(words.split()) - 1))
    with pytest.raises(SystemExit):
        cli.main([])
    assert expected in capsys.readouterr().out
