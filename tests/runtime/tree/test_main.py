"""The command line: exit codes, verdict, messages, files."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import osc2tx_runtime
from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree import Behaviour, Event, OneOf, Serial, Status, Wait, elapsed
from osc2tx_runtime.language.tree.base import Leaf
from osc2tx_runtime.opendrive import read_map
from osc2tx_runtime.running import preparation, runner
from osc2tx_runtime.running.main import main
from tests.runtime.tree.kit import FakeWorld

ROADS = read_map(Path(osc2tx_runtime.__file__).parent / "maps" / "highway.xodr")


class GiveUp(Leaf):
    def update(self) -> Status:
        return self.fail("no lane to the right")


class Waits(Scenario):
    name = "waits"
    source = "waits.osc"

    def declare(self) -> None:
        self.go = Event()
        self.time = self.parameter("time", 0.5)
        self.bad = self.parameter("bad", False)

    def behavior(self) -> Behaviour:
        last: Behaviour = GiveUp("hero change_lane") if self.bad else Wait(elapsed(self.time))
        return Serial("waits", OneOf("first", Wait(self.go), Wait(elapsed(2.0))), last)


@pytest.fixture(autouse=True)
def fake(monkeypatch: pytest.MonkeyPatch) -> None:
    def world(scenario: Scenario, read: object) -> Any:
        made = FakeWorld((), scenario.settings.dt)
        made.map = ROADS
        made.contacts[3] = [("hero", "npc")]
        return made

    monkeypatch.setattr(preparation, "make_world", world)
    monkeypatch.setattr(preparation, "place_actors", lambda scenario, context: None)


def test_success(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    trace = tmp_path / "new" / "t.jsonl"
    assert main(Waits, argv=["--signal", "go@1s", "--trace", str(trace), "--set", "time=1"]) == 0
    out = capsys.readouterr()
    assert (
        out.out
        == "waits: success after 2.00 s, with 1 collision\n  collision at 0.15 s: hero, npc\n"
    )
    assert out.err == ""
    lines = [json.loads(line) for line in trace.read_text().splitlines()]
    assert lines[0] == {
        **{"kind": "header", "version": 1, "scenario": "waits", "source": "waits.osc"},
        **{"map": "highway", "dt": 0.05, "seed": 0, "parameters": {"time": 1.0, "bad": False}},
        **{"actors": {}, "one_of": "race"},
    }
    assert {"t": 1.0, "kind": "choice", "name": "first", "policy": "race"}.items() <= next(
        line for line in lines if line["kind"] == "choice"
    ).items()
    assert lines[-1] == {"kind": "result", "status": "success", "reason": "", "steps": 40}
    assert trace.read_bytes().endswith(b"}\n")


def test_two_runs_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        main(Waits, argv=["--trace", str(tmp_path / name)])
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_failure(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(Waits, argv=["--set", "bad=true"]) == 5
    assert capsys.readouterr().out.startswith(
        "waits.osc: error[OSC809]: waits: failure after 2.00 s: hero change_lane failed at 2.000 s:"
        " no lane to the right\n"
    )


def test_timeout(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(Waits, argv=["--max-time", "1"]) == 5
    assert capsys.readouterr().out.startswith(
        "waits.osc: error[OSC809]: waits: timeout after 1.00 s: not finished at 1 s; still running:"
        " wait @go, wait elapsed 2 s (waits.osc)\n"
    )


@pytest.mark.parametrize(
    ("argv", "code", "message"),
    [
        (
            ["--signal", "og@1"],
            2,
            "waits.osc: error[OSC806]: --signal og: the scenario has no",
        ),
        (["--dt", "x"], 2, "waits.osc: error[OSC806]: `x` is not a time"),
        (["--trace", "/proc/none/x"], 4, "waits.osc: error[OSC807]: the trace cannot be written"),
    ],
)
def test_errors(
    argv: list[str], code: int, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(Waits, argv=argv) == code
    err = capsys.readouterr().err
    assert message in err
    assert "Traceback" not in err


def test_missing_map(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    class NoMap(Waits):
        def map_file(self) -> str:
            return "Town77"

    monkeypatch.undo()
    assert main(NoMap, argv=[]) == 4
    assert "waits.osc: error[OSC807]: map `Town77` not found" in capsys.readouterr().err


def test_error_of_the_scenario_keeps_its_place(capsys: pytest.CaptureFixture[str]) -> None:
    class Broken(Waits):
        def behavior(self) -> Behaviour:
            raise ScenarioError("nothing to do", "waits.osc:9")

    assert main(Broken, argv=[]) == 5
    assert capsys.readouterr().err == "waits.osc:9: error[OSC801]: nothing to do\n"


def test_usage_is_for_argparse(capsys: pytest.CaptureFixture[str]) -> None:
    for argv, code in ((["--help"], 0), (["--nope"], 2)):
        with pytest.raises(SystemExit) as caught:
            main(Waits, argv=argv)
        assert caught.value.code == code
    assert "--max-time SECONDS" in capsys.readouterr().out


def test_progress_is_reported() -> None:
    seen: list[tuple[float, float]] = []
    runner.run_scenario(Waits, on_progress=lambda time, most: seen.append((time, most)))
    assert seen == [(0.0, 300.0), (1.0, 300.0), (2.0, 300.0)]


def test_an_error_still_writes_the_trace(tmp_path: Path) -> None:
    class Broken(Waits):
        def behavior(self) -> Behaviour:
            return Serial("s", Wait(elapsed(0.1)), Wait(lambda: 1 / 0 > 0))

    trace = tmp_path / "t.jsonl"
    assert main(Broken, argv=["--trace", str(trace)]) == 5
    assert '"status":"error"' in trace.read_text().splitlines()[-1]


def test_an_interrupt_is_no_traceback(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def interrupted(world: FakeWorld) -> None:
        world.k += 1
        if world.k == 7:
            raise KeyboardInterrupt

    monkeypatch.setattr(FakeWorld, "step", interrupted)
    trace = tmp_path / "t.jsonl"
    assert main(Waits, argv=["--trace", str(trace)]) == 130
    out = capsys.readouterr()
    assert (out.out, out.err) == ("", "waits: interrupted\n")
    last = json.loads(trace.read_text().splitlines()[-1])
    assert (last["status"], last["reason"]) == ("error", "interrupted at 0.3 s")


def test_require_api() -> None:
    osc2tx_runtime.require_api(osc2tx_runtime.API_LEVEL)
    with pytest.raises(ImportError, match="upgrade osc2tx-runtime"):
        osc2tx_runtime.require_api(99)
    with pytest.raises(ImportError, match="build the module again"):
        osc2tx_runtime.require_api(0)


def test_public_names_exist() -> None:
    for name in osc2tx_runtime.__all__:
        assert hasattr(osc2tx_runtime, name)


def test_the_compiler_is_not_imported() -> None:
    code = (
        "import osc2tx_runtime, sys; bad = {'osc2tx', 'antlr4', 'jinja2', 'black', 'pint',"
        " 'click', 'rich'} & set(sys.modules); sys.exit(', '.join(sorted(bad)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
