"""The long fuzzing run: one command, any time, the same programs from the same seed.

    python tests/fuzz/run.py --seconds 600 --seed 1

It makes texts by

- `programs`: random programs that follow grammar and types (tests/fuzz/programs.py);
- `mutations` of scenarios, goldens and the library (tests/fuzz/mutations.py);
- `grammar`: from grammar/OpenSCENARIO2.g4, every rule but no types (tests/fuzz/grammar.py);
- `tokens`: words and signs of the language in any order;
- `extremes`: a number of a scenario of the repository, or of `$OSC2TX_TEST_DATA/corpus`, replaced
  by one that nobody would write (tests/fuzz/extremes.py);

and compiles each through all stages, imports the module if there is one, and runs its scenarios
for a moment. What must not happen is in tests/fuzz/oracle.py: an exception, a module that Python
does not take or that differs the second time, a diagnostic that points nowhere, slowness. Other
inputs (maps, traces, settings, stores, ...: tests/fuzz/inputs.py) are read by what reads them.

Each gets its share of a round (`SHARES`). With `--look quick` only one text of fifty gets the whole
look, so that a million inputs are some hours of a processor. With `--look check` nine of ten of the
others are only checked, which takes half of that time.

Findings go to `--out`, one folder for each kind of failure and place: `input.osc`, the smallest
text of that kind, cut down line by line, and `report.txt` with options, seed and traceback. The
process ends with 1 if there are any. What is fixed becomes a test: a golden case for the
diagnostic or module that should come out, else a case of tests/unit/test_bad_input.py.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from random import Random

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "runtime_lib")]

from osc2tx.options import DIALECTS, STANDARDS, CompileOptions  # noqa: E402
from osc2tx.start import collect_rarely  # noqa: E402
from tests.fuzz.extremes import SECONDS, write_extreme  # noqa: E402
from tests.fuzz.grammar import write_text  # noqa: E402
from tests.fuzz.inputs import INPUTS  # noqa: E402
from tests.fuzz.mutations import any_tokens, mutate, seed_texts  # noqa: E402
from tests.fuzz.oracle import (  # noqa: E402
    LOOKS,
    SIMULATED_SECONDS,
    Finding,
    Look,
    try_input,
    try_text,
)
from tests.fuzz.programs import write_program  # noqa: E402

ATTEMPTS = 400  # compilations to cut one finding down
WHOLE = 50  # of so many texts one gets the whole look
BUILT = 10  # of so many one is built and run, if most are only checked

SHARES = {
    **{"programs": 1, "grammar": 2, "mutations": 8, "tokens": 40, "extremes": 3},
    **{"maps": 15, "traces": 5, "source_maps": 5, "reports": 5, "digests": 4},
    **{"settings": 10, "options": 25, "stores": 5},
}
"""How many texts of each kind a round has: of those that take longer there are fewer."""


@dataclass(frozen=True, slots=True)
class Case:
    """One text to try."""

    maker: str
    seed: str
    text: str
    options: CompileOptions
    look: Look = "whole"
    place: Path | None = None

    def attempt(self, text: str, execute: bool) -> Finding | None:
        """Try a text as this one is tried."""
        if self.maker in INPUTS:
            return try_input(INPUTS[self.maker], text)
        simulated = SECONDS if self.place else SIMULATED_SECONDS
        return try_text(
            text,
            self.options,
            execute=execute,
            look=self.look,
            place=self.place,
            simulated=simulated,
        )


def cases(seed: int, makers: list[str], most: Look = "whole") -> Iterator[Case]:
    """Yield cases without end."""
    seeds = seed_texts(ROOT)
    for turn in count():
        for maker in makers:
            for number in range(turn * SHARES[maker], (turn + 1) * SHARES[maker]):
                name = f"{seed}/{maker}/{number}"
                random = Random(name)
                options = CompileOptions(random.choice(STANDARDS), random.choice(DIALECTS))
                place = None
                if maker == "extremes":
                    scenario, text = write_extreme(random, random.choice(folders()))
                    options, place = scenario.options, scenario.path
                elif maker in INPUTS:
                    text = INPUTS[maker].write(random)
                elif maker == "programs":
                    text = write_program(random, options.standard, options.dialect)
                elif maker == "mutations":
                    text = mutate(random, seeds)
                elif maker == "tokens":
                    text = any_tokens(random)
                else:
                    text = write_text(random)
                yield Case(maker, name, text, options, look_at(number, most), place)


def look_at(number: int, most: Look) -> Look:
    """Return how the text of a number is tried, where most get the given look."""
    if number % WHOLE == 0:
        return "whole"
    return "quick" if most == "check" and number % BUILT == 0 else most


def folders() -> list[Path]:
    """Return the folders of scenarios whose numbers are replaced."""
    data = os.environ.get("OSC2TX_TEST_DATA")
    return [ROOT / "scenarios", *([Path(data, "corpus")] if data else ())]


def cut_down(text: str, still_fails: Callable[[str], bool]) -> str:
    """Return a smaller text that fails in the same way: blocks of lines go, the largest first."""
    lines = text.splitlines(keepends=True)
    size, attempts = max(1, len(lines) // 2), 0
    while attempts < ATTEMPTS:
        at = 0
        shorter = False
        while at < len(lines) and attempts < ATTEMPTS:
            rest = lines[:at] + lines[at + size :]
            attempts += 1
            if still_fails("".join(rest)):
                lines, shorter = rest, True
            else:
                at += size
        if size == 1 and not shorter:
            break
        size = max(1, size // 2)
    return "".join(lines)


def save(folder: Path, case: Case, finding: Finding, times: int, execute: bool) -> None:
    """Write the smallest text with the same failure."""

    def still_fails(text: str) -> bool:
        found = case.attempt(text, execute)
        return found is not None and found.key == finding.key

    is_slow = finding.key.startswith(("slow", "Hangs"))
    text = case.text if is_slow else cut_down(case.text, still_fails)
    final = finding if is_slow else case.attempt(text, execute) or finding
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "input.osc").write_bytes(text.encode("utf-8", "surrogateescape"))
    report = f"{final.key}\n{case.options}\nseed {case.seed}\nseen {times} times\n\n{final.report}"
    (folder / "report.txt").write_text(report, encoding="utf-8", errors="backslashreplace")


def main() -> int:
    """Run for a while and say what was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "fuzz")
    parser.add_argument("--only", choices=SHARES, action="append")
    parser.add_argument("--compile-only", action="store_true", help="do not run the modules")
    parser.add_argument("--look", choices=LOOKS, default="whole", help="what most texts get")
    parser.add_argument("--count", type=int, help="how many texts to try at most")
    options = parser.parse_args()
    makers = options.only or list(SHARES)
    execute = not options.compile_only
    smallest: dict[str, tuple[Case, Finding]] = {}
    times: dict[str, int] = {}
    end = time.monotonic() + options.seconds
    tried: Counter[str] = Counter()
    gc.freeze()
    collect_rarely()  # as the command does
    for case in cases(options.seed, makers, options.look):
        if time.monotonic() > end or tried.total() == options.count:
            break
        tried[case.maker] += 1
        if tried.total() % 10_000 == 0:
            print(f"{tried.total()} texts", flush=True)
        finding = case.attempt(case.text, execute)
        if finding is None:
            continue
        times[finding.key] = times.get(finding.key, 0) + 1
        known = smallest.get(finding.key)
        if known is None:
            print(f"{case.seed}: {finding.key}", flush=True)
        if known is None or len(case.text) < len(known[0].text):
            smallest[finding.key] = case, finding
    for number, (key, (case, finding)) in enumerate(sorted(smallest.items()), start=1):
        name = "".join(letter if letter.isalnum() else "_" for letter in key)[:70]
        save(options.out / f"{number:02}_{name}", case, finding, times[key], execute)
    parts = ", ".join(f"{maker} {number}" for maker, number in tried.items())
    print(f"{tried.total()} texts ({parts})")
    print(f"{len(smallest)} kinds of failure", f"in {options.out}" if smallest else "")
    return 1 if smallest else 0


if __name__ == "__main__":
    sys.exit(main())
