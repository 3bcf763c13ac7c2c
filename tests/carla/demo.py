"""Plays the case study over CARLA's client library, against the stand-in for the server.

`make demo-carla`. With the folder of CARLA's towns (`--maps`, or `maps/carla-2020` of the test
data) it is `hello_world` itself, else its story on a map of our own.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from osc2tx_shared.text import say

from .stand_in.process import ROOT, StandInProcess

OWN_MAPS = ROOT / "runtime_lib" / "osc2tx_runtime" / "maps"
TOWN = "Town06.xodr"
MODES = ("exact", "driven")
GIVEN = {
    "hello_world": [
        *("--signal", "go_signal@1s", "--spawn", "hero=16,-3,5"),
        *("--destination", "hero=obstacle", "--destination", "npc=obstacle"),
    ],
    "cut_in_and_evade": [],
}
"""What a user supplies to each at run time."""


def main() -> int:
    """Play it in both modes of control; return the exit code of the first run that fails."""
    parser = argparse.ArgumentParser(prog="python -m tests.carla.demo")
    data = Path(os.environ.get("OSC2TX_TEST_DATA", "."), "maps", "carla-2020")
    parser.add_argument("--maps", type=Path, default=data, help="folder with Town06.xodr")
    maps: Path = parser.parse_args().maps
    name = "hello_world" if (maps / TOWN).is_file() else "cut_in_and_evade"
    folders = [OWN_MAPS, *([maps] if name == "hello_world" else [])]
    with StandInProcess(folders, "highway") as server:
        checked = [sys.executable, "-m", "osc2tx", "world", "check", "carla", "--drive"]
        subprocess.run([*checked, "--carla", f"127.0.0.1:{server.port}"], cwd=ROOT, check=True)
        for mode in MODES:
            out = Path("out", f"{name}_carla_{mode}")
            say(f"{name} in CARLA, {mode}: {out}.html")
            options = {
                "--world": "carla",
                "--carla": f"127.0.0.1:{server.port}",
                "--control": mode,
                "--map-path": str(folders[-1]),
                "--trace": f"{out}.jsonl",
                "--report": f"{out}.html",
            }
            given = [part for option in options.items() for part in option]
            run = [sys.executable, f"generated/{name}.py", "--carla-load", *GIVEN[name], *given]
            code = subprocess.run(run, cwd=ROOT).returncode
            if code:
                return code
    return 0


if __name__ == "__main__":
    sys.exit(main())
