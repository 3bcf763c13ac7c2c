"""The tables of `README.md` name tests, checks and faults that there are, and all of them."""

from __future__ import annotations

import re
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from osc2tx_runtime.simulators.carla.checks.table import LINES as UNSORTED

from .conftest import OWN_MAPS
from .runs import GENERATED
from .stand_in.faults import FAULTS
from .stand_in.process import ROOT, StandInProcess

HERE = Path(__file__).parent
TABLE = (HERE / "README.md").read_text(encoding="utf-8")
FINDINGS = 28
LINES = dict(sorted(UNSORTED.items()))


def test_the_tests_of_the_table_exist() -> None:
    named = re.findall(r"`(test_\w+)\.(test_\w+)`", TABLE)
    assert len(named) > FINDINGS
    for file, test in named:
        assert f"def {test}(" in (HERE / f"{file}.py").read_text(encoding="utf-8"), test


def test_the_tables_have_all_faults_findings_and_checks() -> None:
    assert set(re.findall(r"`--fault ([\w-]+)`", TABLE)) == set(FAULTS)
    assert numbers("Findings") == list(range(1, FINDINGS + 1))
    assert numbers("Checks") == list(LINES)
    names = re.findall(r"^\| \d+ \| ([^|]+) \|", section("Checks"), re.MULTILINE)
    assert names == [line.name for line in LINES.values()]


def test_each_finding_has_a_source_and_a_test() -> None:
    for row in re.findall(r"^\| \d+ .*", section("Findings"), re.MULTILINE):
        _, _, finding, source, tests, _ = row.split("|")
        assert source.strip() and "`test_" in tests, finding


def section(title: str) -> str:
    """Return a section of the page."""
    return TABLE.partition(f"## {title}\n")[2].partition("\n## ")[0]


def numbers(title: str) -> list[int]:
    """Return the numbers of the rows of a section; rows may have parts."""
    found = re.findall(r"^\| (\d+) \|", section(title), re.MULTILINE)
    return [int(each) for each in dict.fromkeys(found)]


def test_frames_are_uneven_until_a_client_fixes_them() -> None:
    script = textwrap.dedent("""
        import carla, sys
        client = carla.Client("127.0.0.1", int(sys.argv[1]))
        client.set_timeout(20.0)
        world = client.get_world()
        def lengths():
            return {round(world.wait_for_tick().timestamp.delta_seconds, 4) for _ in range(8)}
        print(len(lengths()) > 1)
        settings = world.get_settings()
        settings.fixed_delta_seconds = 0.05
        world.apply_settings(settings)
        print(lengths() == {0.05})
        """)
    with StandInProcess([OWN_MAPS], "highway") as server:
        command = [sys.executable, "-c", script, str(server.port)]
        assert subprocess.check_output(command, text=True) == "True\nTrue\n"


DYING = """
import importlib, os, sys
from pathlib import Path

here = str(Path(__file__).parent)
sys.path = [each for each in sys.path if each != here]
del sys.modules["carla"]
carla = importlib.import_module("carla")
tick, count = carla.World.tick, 0

def last(self, *given):
    global count
    count += 1
    if count == 20:
        print("terminate called after throwing an instance of 'rpc::timeout'", file=sys.stderr)
        sys.stderr.flush()
        os.abort()
    return tick(self, *given)

carla.World.tick = last
"""


@pytest.mark.slow
def test_a_library_that_dies_in_a_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What nobody catches in a thread of the library ends its process (carla issue 4072)."""
    (tmp_path / "carla.py").write_text(DYING, encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with StandInProcess([OWN_MAPS], "highway") as server:
        run = [sys.executable, str(GENERATED / "cut_in.py"), "--world", "carla"]
        run += ["--carla", f"127.0.0.1:{server.port}"]
        with monkeypatch.context() as patched:
            patched.setenv("PYTHONPATH", str(tmp_path))
            died = subprocess.run(run, cwd=ROOT, capture_output=True, text=True)
        assert died.returncode == 4, died.stderr
        assert "its last words: terminate called after throwing" in died.stderr
        following = subprocess.run(run, cwd=ROOT, capture_output=True, text=True)
        assert following.returncode == 0, following.stderr
        assert "restored what an interrupted run had changed" in following.stderr
        assert not server.ask("stand_in_synchronous") and server.ask("stand_in_actors") == {}
