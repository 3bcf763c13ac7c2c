"""Every number of every scenario of a folder, replaced by each extreme: check, build, 4 s of a run.

    python tests/fuzz/every_extreme.py scenarios
    python tests/fuzz/every_extreme.py $OSC2TX_TEST_DATA/corpus --parts 3 --part 0

Nothing may end with an exception, or take longer than `LONGEST`. With `--parts 3` one of
three texts is tried. Printed are findings and counts; the command ends with 1 if there are any.
"""

from __future__ import annotations

import argparse
import gc
import sys
import time
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "runtime_lib")]

from osc2tx.start import collect_rarely  # noqa: E402
from tests.fuzz.extremes import SECONDS, Scenario, every, scenarios  # noqa: E402
from tests.fuzz.oracle import Finding, try_text  # noqa: E402

LONGEST = 20.0  # seconds of the processor
PROGRESS = 1000  # texts between two lines of progress


def texts(folder: Path) -> Iterator[tuple[Scenario, int, str]]:
    """Yield each scenario with each of its texts and the number of that text."""
    for scenario in scenarios(folder):
        for number, text in enumerate(every(scenario)):
            yield scenario, number, text


def tried(scenario: Scenario, text: str) -> Finding | None:
    """Check, build and run a text as its scenario."""
    return try_text(
        text,
        scenario.options,
        execute=True,
        look="quick",
        place=scenario.path,
        simulated=SECONDS,
    )


def main() -> int:
    """Try all texts of a part and say what was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--parts", type=int, default=1)
    parser.add_argument("--part", type=int, default=0)
    options = parser.parse_args()
    gc.freeze()
    collect_rarely()  # as the command does
    findings: set[str] = set()
    count, longest, slowest = 0, 0.0, ""
    part = islice(texts(options.folder), options.part, None, options.parts)
    for count, (scenario, number, text) in enumerate(part, start=1):
        start = time.process_time()
        finding = tried(scenario, text)
        seconds = time.process_time() - start
        name = f"{scenario.path}, text {number}"
        if seconds > longest:
            longest, slowest = seconds, name
        key = finding.key if finding else f"over {LONGEST} s" if seconds > LONGEST else None
        if key is not None and key not in findings:
            findings.add(key)
            print(f"{name}: {key}\n{finding.report if finding else ''}", flush=True)
        if count % PROGRESS == 0:
            print(f"{count} texts", flush=True)
    print(f"{count} texts, {len(findings)} kinds of failure; {longest:.1f} s for {slowest}")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
