"""What a start loads: most of the time of a small check is that of importing modules."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FULL = (ROOT / "scenarios/cut_in_and_evade.osc").read_text(encoding="utf-8")

PROGRAM = """\
import atexit, sys
atexit.register(lambda: print(*sorted(name for name in sys.modules if name.startswith("osc2tx"))))
sys.argv = ["osc2tx", "check", "a.osc"]
from osc2tx.start import main
main()
"""


def loaded(folder: Path) -> set[str]:
    """Check `a.osc` in a new process; return the modules of ours that it has loaded at its end."""
    os.utime(folder / "a.osc", (0, 0))
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), "HOME": str(folder)}
    environment.pop("OSC2TX_NO_CACHE", None)
    environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode in (0, 3), ended.stderr
    return set(ended.stdout.splitlines()[-1].split())


@pytest.mark.parametrize(
    ("text", "most"),
    [
        pytest.param("scenario top:\n    do nothing()\n", 170, id="with an error"),
        pytest.param(FULL, 663, id="up to the first step in the world"),
    ],
)
def test_modules_of_a_first_check(text: str, most: int, tmp_path: Path) -> None:
    (tmp_path / "a.osc").write_text(text, encoding="utf-8")
    found = loaded(tmp_path)
    assert len(found) <= most, (
        f"{len(found)} modules, each a quarter of a millisecond: import what is rarely needed "
        "where it is needed, or raise the bound and say why"
    )
