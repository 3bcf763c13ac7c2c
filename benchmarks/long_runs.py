"""What long runs cost: seconds, and memory, which does not grow with their length.

    python benchmarks/long_runs.py [--largest]

Two cars drive on a road of 1,000 km. Run (with trace and report), verify, report and replay of a
campaign are processes of their own. Printed are CPU seconds and the peak of memory (MB) at 10^3,
10^4 and 10^5 steps, and with `--largest` at 10^6.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from maps import straight

DT = 0.05  # s
SCENARIO = """\
import osc.standard.all
namespace null use std, stdtypes

scenario long_run:
    road: map
    keep(road.map_file == "straight.xodr")
    first, second: vehicle
    gap: length
    keep(gap in [20m..40m])
    do parallel:
        first.drive(duration: {seconds}s) with:
            speed(15mps)
            position(100m, at: start)
        second.drive(duration: {seconds}s) with:
            speed(15mps)
            position(gap, behind: first, at: start)
"""
PEAK = """\
import re, sys
from osc2tx.cli import main
sys.argv = ["osc2tx", *sys.argv[1:]]
try:
    main()
finally:
    import resource
    from pathlib import Path
    peak = re.search(r"VmHWM:\\s+(\\d+)", Path("/proc/self/status").read_text())[1]
    used = resource.getrusage(resource.RUSAGE_SELF)
    print(f"{used.ru_utime + used.ru_stime:8.2f} s {int(peak) / 1024:6.0f} MB")
"""


def cost(folder: Path, command: Sequence[str]) -> str:
    """Seconds and memory of a command."""
    done = subprocess.run(
        [sys.executable, "-c", PEAK, *command],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        sys.exit(f"osc2tx {' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout.splitlines()[-1]


def main() -> None:
    parser = argparse.ArgumentParser(description="Costs of long runs.")
    parser.add_argument("--largest", action="store_true", help="10^6 steps as well")
    arguments = parser.parse_args()
    for exponent in range(3, 7 if arguments.largest else 6):
        seconds = 10**exponent * DT
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "straight.xodr").write_text(straight(1000))
            (folder / "long_run.osc").write_text(SCENARIO.format(seconds=seconds))
            length = ["--dt", f"{DT}", "--max-time", f"{2 * seconds}"]
            outputs = ["--trace", "run.jsonl", "--report", "run.html"]
            commands = {
                "run": ["run", "long_run.osc", *length, *outputs],
                "verify": ["verify", "run.jsonl", "long_run.osc"],
                "report": ["report", "run.jsonl", "-o", "page.html"],
                "campaign": [
                    *("campaign", "run", "long_run.osc", "--samples", "2", *length),
                    *("--store", "store", "--workers", "1", "--digests"),
                ],
                "replay": ["campaign", "replay", "store", "1", "--trace", "again.jsonl"],
            }
            for what, command in commands.items():
                print(f"10^{exponent} {what:<9}", cost(folder, command), flush=True)


if __name__ == "__main__":
    main()
