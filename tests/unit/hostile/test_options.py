"""Options and inputs that cannot be: one sentence and an exit code that says whose fault it is."""

import json
import math
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx import cli
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.plain_numbers import to_float, to_int
from osc2tx_runtime.report.trace_reader import read_run
from osc2tx_runtime.running.options import read_options
from osc2tx_runtime.running.output_files import check_outputs, write_output
from osc2tx_shared.text import READER_HAS_GONE
from tests.processes import Ended, forked
from tests.unit.building.projects import drive, write

DEEP = "[" * 100_000
PRINTERS = [
    ("--help",),
    ("--version",),
    ("check", "a.osc"),
    ("check", "a.osc", "--output-format", "json"),
    ("build", "a.osc", "--emit", "ast"),
    ("run", "a.osc"),
    ("tree", "a.osc"),
    ("config",),
    ("explain", "OSC302"),
    ("reference", "vehicle.drive"),
]


@pytest.mark.parametrize(
    "given",
    [
        {"set": "v=1e999"},
        {"set": "v=-1e999"},
        {"dt": "1e-12"},
        {"dt": "1e-320"},
        {"dt": "0"},
        {"dt": "-1"},
        {"dt": "nan"},
        {"dt": "1e999"},
        {"dt": "\u0660.\u0665"},
        {"max-time": "1e300"},
        {"max-time": "inf"},
        {"signal": "go@1e999"},
        {"signal": "go@-1"},
        {"seed": "1_0"},
        {"seed": "\uff11"},
        {"seed": "9" * 5000},
        {"spawn": "ego=1,-1,nan"},
        {"spawn": "ego=1,-1_0,3"},
        {"spawn": "ego=1,-1,1e999"},
        {"no-such": "1"},
    ],
    ids=str,
)
def test_values_that_no_run_can_have(given: dict[str, str]) -> None:
    with pytest.raises(SettingsError) as caught:
        read_options({name: [text] for name, text in given.items()})
    assert caught.value.exit_code == 2


def test_as_many_steps_as_a_run_may_take() -> None:
    assert RunSettings(dt=1e-6, max_time=99.0).dt == 1e-6
    with pytest.raises(SettingsError, match="100,000,000 steps"):
        RunSettings(dt=1e-6, max_time=101.0)


@pytest.mark.parametrize(
    "text", ["1_0", "\uff11", "nan", "INF", "infinity", "1e999", "0x1", "", "1\xa0"]
)
def test_no_numbers(text: str) -> None:
    for read in (to_float, to_int):
        with pytest.raises(ValueError):
            read(text)


def test_numbers() -> None:
    assert [to_float(text) for text in ("+1.", ".5", "-1E-3", " 2\n")] == [1.0, 0.5, -0.001, 2.0]
    assert [to_int(text) for text in ("+1", "-07", " 12 ")] == [1, -7, 12]
    assert math.isfinite(to_float("9" * 300))


# --- outputs of a run ---


def test_a_run_overwrites_only_what_a_run_wrote(tmp_path: Path) -> None:
    scenario = write(tmp_path / "cut_in.osc", "scenario cut_in:\n")
    link = tmp_path / "t.jsonl"
    link.symlink_to(scenario)
    report = write(tmp_path / "r.html", "<!DOCTYPE html>\n<p>")
    trace = write(tmp_path / "old.jsonl", '{"kind":"header","version":1}\n')
    for refused in (
        RunSettings(trace=scenario),
        RunSettings(trace=link),
        RunSettings(report=trace),
        RunSettings(trace=report),
        RunSettings(trace=trace, report=tmp_path / "." / "old.jsonl"),
        RunSettings(trace=tmp_path / "new", report=tmp_path / "new"),
        RunSettings(trace=tmp_path / "\0"),
    ):
        with pytest.raises(SettingsError):
            check_outputs(refused)
    empty = write(tmp_path / "empty", "")
    check_outputs(RunSettings(trace=trace, report=report))
    check_outputs(RunSettings(trace=Path("/dev/null"), report=empty))


def test_outputs_are_replaced_at_once(tmp_path: Path) -> None:
    kept = write(tmp_path / "kept", "old")
    os.link(kept, tmp_path / "t.jsonl")
    write_output("trace", tmp_path / "t.jsonl", "new")
    assert (kept.read_text(), (tmp_path / "t.jsonl").read_text()) == ("old", "new")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["kept", "t.jsonl"]


@pytest.mark.parametrize("place", ["x" * 3000, "a/" + "x" * 300, "file/below", "folder"])
def test_outputs_that_cannot_be_written(tmp_path: Path, place: str) -> None:
    write(tmp_path / "file", "")
    (tmp_path / "folder").mkdir()
    check_outputs(RunSettings(trace=tmp_path / place))
    with pytest.raises(InputError):
        write_output("trace", tmp_path / place, "text")


@pytest.mark.parametrize("name", ["x" * 3000, "\0", "a/" * 2000, "../" * 3000 + "x", "\ud800"])
def test_maps_that_no_file_system_has(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError) as caught:
        find_map(name, (tmp_path,))
    assert len(caught.value.message) < 600 + len(str(tmp_path))


def test_traces_that_are_nested_too_deep() -> None:
    assert read_run([DEEP, '{"a":' * 100_000]).skipped == 2
    for depth in (60, 100, 500, 900, 980):
        inner = "[" * depth + "1" + "]" * depth
        lines = [f'{{"kind":"header","scenario":{inner}}}', f'{{"kind":"result","reason":{inner}}}']
        lines += [f'{{"kind":"event","t":0,"name":{inner}}}']
        run = read_run(lines)
        run.as_json()
        assert run.skipped == (0 if depth < 100 else 3)


def test_traces_with_numbers_that_no_page_can_draw() -> None:
    state = {"kind": "state", "actor": "ego", "y": 0.0}
    lines = [{**state, "t": t, "x": x} for t, x in enumerate((1.0, 1e308, -1e308, 10**400, 1e13))]
    run = read_run([json.dumps(line) for line in lines])
    assert (run.skipped, run.as_json()["duration"]) == (4, 0)


@pytest.mark.parametrize("line", ["x = 0x{}", "[scenarios.a.run]\nseed = 0x{}", "out = {}"])
def test_numbers_of_thousands_of_digits_in_settings(tmp_path: Path, line: str) -> None:
    drive(tmp_path / "a.osc")
    write(tmp_path / "osc2tx.toml", line.format("9" * 5000))
    found = ended(tmp_path, "run", "a.osc")
    assert (found.code, len(found.err) < 500) == (2, True)


# --- the command line ---


def ended(folder: Path, *arguments: object, before: Callable[[], object] = bool) -> Ended:
    def main() -> None:
        before()
        cli.main([str(each) for each in arguments])

    found = forked(main, folder=folder)
    assert "Traceback" not in found.err
    return found


def test_inputs_that_cannot_be_read(tmp_path: Path) -> None:
    drive(tmp_path / "in/a.osc")
    (tmp_path / "in/loop.osc").symlink_to("loop.osc")
    assert ended(tmp_path, "check", "in/loop.osc").code == 4
    assert ended(tmp_path, "build", "in", "-o", "out").code == 4
    assert (tmp_path / "out/a.py").exists()
    for name in ("b.xosc.report.json", ".osc2tx/written.json"):
        write(tmp_path / "deep" / name, DEEP)
    assert ended(tmp_path, "build", "in/a.osc", "-o", "deep").code == 0
    write(tmp_path / "in/osc2tx.toml", f"x = {DEEP}")
    assert ended(tmp_path, "check", "in/a.osc").code == 2


def test_a_name_that_is_not_utf_8_does_not_stop_the_others(tmp_path: Path) -> None:
    drive(tmp_path / "in/a.osc")
    with open(os.fsencode(tmp_path / "in") + b"/\xff.osc", "wb") as file:
        file.write(b"")
    found = ended(tmp_path, "build", "in", "-o", "out")
    assert (found.code, (tmp_path / "out/a.py").exists()) == (4, True)
    assert "\\udcff.osc`: the name of the file or a folder is not UTF-8" in found.err
    for form in ("json", "sarif", "github", "rdjson"):
        assert ended(tmp_path, "check", "in", "--output-format", form).code == 4


def test_a_working_folder_that_is_gone(tmp_path: Path) -> None:
    (tmp_path / "gone").mkdir()
    (tmp_path / "again").mkdir()
    found = ended(tmp_path / "gone", "check", ".", before=lambda: os.rmdir(tmp_path / "gone"))
    assert (found.code, found.err.count("\n")) == (2, 1)
    found = ended(tmp_path / "again", "run", "a.osc", before=lambda: os.rmdir(tmp_path / "again"))
    assert (found.code, found.err.count("\n")) == (4, 1)


@pytest.mark.parametrize("arguments", [("check", "a.osc"), ("run", "a.osc"), ("tree", "a.osc")])
def test_outputs_that_take_nothing(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    drive(tmp_path / "a.osc")
    full = ended(tmp_path, *arguments, before=lambda: os.dup2(os.open("/dev/full", os.O_RDWR), 1))
    assert full.code == 4
    assert full.err.endswith("error: standard output cannot be written: No space left on device\n")


@pytest.mark.parametrize("arguments", PRINTERS, ids=" ".join)
def test_readers_that_have_gone(tmp_path: Path, arguments: tuple[str, ...]) -> None:
    drive(tmp_path / "a.osc")
    left = ended(tmp_path, *arguments, before=leave_output)
    assert (left.code, left.err) == (READER_HAS_GONE, "")


def leave_output() -> None:
    """As after `| true`."""
    reader, writer = os.pipe()
    os.close(reader)
    os.dup2(writer, 1)


@pytest.mark.parametrize("raised", ["SystemExit(0)", "RuntimeError('x')", "BaseException()"])
def test_a_module_that_ends_the_process_when_it_is_imported(tmp_path: Path, raised: str) -> None:
    write(tmp_path / "own.py", f"raise {raised}\n")
    found = ended(tmp_path, "run", "own.py")
    assert (found.code, found.err.count("\n")) == (4, 1)
    assert f"own.py: cannot be imported: {raised.partition('(')[0]}" in found.err
