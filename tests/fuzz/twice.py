"""Random scenarios, compiled and run in two processes: the same modules, documents and traces.

    python tests/fuzz/twice.py --count 500 --seed 1

The processes hash differently (`PYTHONHASHSEED`): an order of a set or of addresses would show.
Printed are how many scenarios gave modules and traces; the command ends with 1 at a difference.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from random import Random

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "runtime_lib")]

from osc2tx.compilation.driver import Compilation  # noqa: E402
from osc2tx.module_loading import scenarios_of_module  # noqa: E402
from osc2tx.options import DIALECTS, STANDARDS, CompileOptions  # noqa: E402
from osc2tx_runtime import RunSettings, ScenarioError, run_scenario  # noqa: E402
from tests.fuzz.programs import write_program  # noqa: E402

SECONDS = 4.0  # of simulated time


def results(seed: str, folder: Path) -> Iterator[str]:
    """Yield a digest of each product of a random scenario, with its kind."""
    random = Random(seed)
    options = CompileOptions(random.choice(STANDARDS), random.choice(DIALECTS))
    path = folder / "random.osc"
    path.write_text(write_program(random, options.standard, options.dialect), encoding="utf-8")
    compilation = Compilation(path, path.name, options)
    compilation.check()
    found = "\n".join(f"{each.code} {each.message}" for each in compilation.diagnostics)
    yield _line("diagnostics", found)
    for output in compilation.outputs():
        yield _line("output", f"{output}")
    if compilation.module is None:
        return
    with scenarios_of_module(compilation.module) as scenarios:
        for name, scenario in scenarios.items():
            try:
                result = run_scenario(scenario, RunSettings(max_time=SECONDS))
                yield _line("trace", f"{name} {result.status} {result.trace_lines}")
            except ScenarioError as error:
                yield _line("refusal", f"{name} {error.message}")


def _line(kind: str, text: str) -> str:
    return f"{kind} {hashlib.sha256(text.encode('utf-8', 'backslashreplace')).hexdigest()}"


def child(seed: int, count: int) -> None:
    """Print a line for each product of all scenarios."""
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            for line in results(f"{seed}/twice/{number}", Path(folder)):
                print(number, line)


def main() -> int:
    """Compare the lines of two processes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        child(options.seed, options.count)
        return 0
    words = ["--child", "--count", str(options.count), "--seed", str(options.seed)]
    printed = [
        subprocess.run(
            [sys.executable, __file__, *words],
            env={**os.environ, "PYTHONHASHSEED": hash_seed},
            check=True,
            capture_output=True,
            text=True,
        ).stdout.splitlines()
        for hash_seed in ("1", "2")
    ]
    kinds = [line.split()[1] for line in printed[0]]
    counts = ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds))
    print(f"{options.count} scenarios: {counts}")
    differing = {one.split()[0] for one, other in zip(*printed, strict=False) if one != other}
    for number in sorted(differing):
        print(f"{options.seed}/twice/{number}: another result the second time")
    return 1 if differing or len(printed[0]) != len(printed[1]) else 0


if __name__ == "__main__":
    sys.exit(main())
