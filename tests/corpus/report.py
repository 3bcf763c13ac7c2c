"""What becomes of the public scenarios: how many parse, check and build, and why others do not.

    python tests/corpus/report.py              the table, and the codes that stand in the way
    python tests/corpus/report.py --verbose    with examples of every code
    python tests/corpus/report.py --files      with what stands in the way of each file
    python tests/corpus/report.py --update     pin the numbers in expected.json; they may only rise

The files lie in `$OSC2TX_TEST_DATA/corpus`; its MANIFEST.csv says of each whose language it is
(dialect) and what it is for (kind). A file

- parses, if there is no error of the text or its syntax (OSC1xx);
- checks, if there is no error of the language (OSC1xx - OSC4xx);
- builds, if a module is emitted; what checks and declares no scenario has nothing to build.

Of the kind `test-invalid`, whose authors expect a refusal, it counts how many are refused, by a
file that does not check or a construct that no backend can express.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import sys
import time
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from traceback import extract_tb
from types import MappingProxyType

from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.roots import Roots
from osc2tx.diagnostics import Diagnostic, Severity
from osc2tx.options import CompileOptions

EXPECTED = Path(__file__).with_name("expected.json")
ACCEPTED = Path(__file__).with_name("accepted.toml")
INVALID = "test-invalid"
SLOW = 5.0  # seconds for one file
EXAMPLES = 3

OPTIONS: Mapping[str, CompileOptions] = MappingProxyType(
    {
        "asam-2.0": CompileOptions("2.1"),
        "asam-2.1": CompileOptions("2.1"),
        "asam-2.2": CompileOptions("2.2"),
        "carla-sr": CompileOptions("2.1", "carla"),
        "intel": CompileOptions("2.1"),
    }
)
# Where imports of a dialect are looked for, besides the file's own repository.
ROOTS: Mapping[str, Sequence[str]] = MappingProxyType(
    {"carla-sr": ("carla-simulator__scenario_runner/srunner/examples",)}
)

Numbers = dict[str, dict[str, int]]  # "dialect kind" to stage to number of files


@dataclass(frozen=True, slots=True)
class Result:
    """What became of one file.

    Attributes:
        file: Its path in the corpus.
        dialect: Whose language it is.
        kind: What it is for.
        stages: The stages it passed, of `parse`, `check`, `build` and `no scenario`.
        errors: What stands in the way.
        bug: How the compiler itself failed, if it did.
        seconds: How long it took.
    """

    file: str
    dialect: str
    kind: str
    stages: tuple[str, ...]
    errors: tuple[Diagnostic, ...]
    bug: str | None
    seconds: float

    @property
    def is_refused(self) -> bool:
        return bool(self.errors)


def compile_corpus(corpus: Path) -> list[Result]:
    """Compile every file of the manifest."""
    return [_compile(corpus, row) for row in manifest(corpus)]


def manifest(corpus: Path) -> list[dict[str, str]]:
    """Return the rows of the manifest: file, dialect, kind and more of each."""
    with (corpus / "MANIFEST.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def compilation_of(corpus: Path, row: Mapping[str, str]) -> Compilation:
    """Return the compilation of a file of the manifest; no stage has run yet."""
    file = row["file"]
    return Compilation(
        corpus / file, file, OPTIONS[row["dialect"]], roots=Roots(tuple(roots_of(corpus, row)))
    )


def roots_of(corpus: Path, row: Mapping[str, str]) -> list[Path]:
    """Return where a file looks for what it imports."""
    folders = (row["file"].partition("/")[0], *ROOTS.get(row["dialect"], ()))
    return [corpus / folder for folder in folders]


def _compile(corpus: Path, row: Mapping[str, str]) -> Result:
    compilation = compilation_of(corpus, row)
    file, dialect = row["file"], row["dialect"]
    start = time.perf_counter()
    bug = None
    try:
        built = compilation.module is not None
    except Exception as error:  # any exception is a finding
        built = False
        frame = extract_tb(error.__traceback__)[-1]
        bug = f"{type(error).__name__}: {error} ({Path(frame.filename).name}:{frame.lineno})"
    seconds = time.perf_counter() - start
    errors = [d for d in compilation.diagnostics if d.severity is Severity.ERROR]
    return Result(
        file=file,
        dialect=dialect,
        kind=row["kind"],
        stages=() if bug else _stages(errors, built),
        errors=tuple(errors),
        bug=bug,
        seconds=seconds,
    )


def _stages(errors: Iterable[Diagnostic], built: bool) -> tuple[str, ...]:
    families = {error.code[:4] for error in errors}
    if "OSC1" in families:
        return ()
    if families - {"OSC5"}:
        return ("parse",)
    if built:
        return ("parse", "check", "build")
    return ("parse", "check") if families else ("parse", "check", "no scenario")


def count(results: Iterable[Result]) -> Numbers:
    """Return how many files passed each stage, or were refused if they should be."""
    numbers: Numbers = {}
    for result in results:
        row = numbers.setdefault(f"{result.dialect} {result.kind}", {"files": 0})
        row["files"] += 1
        if result.kind == INVALID:
            row["refused"] = row.get("refused", 0) + result.is_refused
            continue
        for stage in ("parse", "check", "build", "no scenario"):
            row[stage] = row.get(stage, 0) + (stage in result.stages)
    return dict(sorted(numbers.items()))


def compare(numbers: Numbers, expected: Numbers) -> tuple[list[str], list[str]]:
    """Return what fell and what rose against the pinned numbers.

    Files that check may also turn from `no scenario` to `build`, so the two count together.
    """
    fell: list[str] = []
    rose: list[str] = []
    for group, pinned in expected.items():
        found = numbers.get(group, {})
        for stage, (now, then) in {
            "parse": (found.get("parse", 0), pinned.get("parse", 0)),
            "check": (found.get("check", 0), pinned.get("check", 0)),
            "build": (_done(found), _done(pinned)),
            "refused": (found.get("refused", 0), pinned.get("refused", 0)),
        }.items():
            if now != then:
                (fell if now < then else rose).append(f"{group}: {stage} {then} -> {now}")
    return fell, rose


def _done(row: Mapping[str, int]) -> int:
    return row.get("build", 0) + row.get("no scenario", 0)


def bugs(results: Iterable[Result]) -> list[str]:
    """Return the files that make the compiler fail or take too long, with the reason."""
    failed = [f"{r.file}: {r.bug}" for r in results if r.bug]
    return failed + [f"{r.file}: {r.seconds:.1f} s" for r in results if r.seconds > SLOW]


def accepted(results: Iterable[Result]) -> list[str]:
    """Return the files that should be refused and are not."""
    return [r.file for r in results if r.kind == INVALID and not r.is_refused]


def read_reasons() -> dict[str, str]:
    """Return why some of them are right to be accepted, by the ends of their paths."""
    return tomllib.loads(ACCEPTED.read_text(encoding="utf-8"))


def reason_of(file: str, reasons: Mapping[str, str]) -> str | None:
    """Return why a file is accepted against the expectation of its authors."""
    return next((reasons[end] for end in reasons if file.endswith(end)), None)


def render(results: Sequence[Result], *, verbose: bool) -> str:
    """Return the report as text."""
    columns = ("files", "parse", "check", "build", "no scenario", "refused")
    rows: list[tuple[str, ...]] = [("dialect", "kind", *columns)]
    for group, numbers in count(results).items():
        rows.append((*group.split(" ", 1), *(str(numbers.get(name, "")) for name in columns)))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(
            cell.ljust(width) if i < 2 else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    valid = [result for result in results if result.kind != INVALID]
    reasons = read_reasons()
    lines += ["", "why files are refused, by files:", *_reasons(valid, verbose)]
    lines += ["", "accepted although their authors expect a refusal:"]
    for file in accepted(results):
        lines += [f"  {file}", f"      {reason_of(file, reasons) or 'not explained'}"]
    lines += ["", "bugs of the compiler:", *(f"  {bug}" for bug in bugs(results) or ["none"])]
    return "\n".join(lines) + "\n"


def _reasons(results: Iterable[Result], verbose: bool) -> list[str]:
    examples: dict[tuple[str, str], dict[str, Diagnostic]] = defaultdict(dict)
    for result in results:
        for error in result.errors:
            examples[result.dialect, error.code].setdefault(result.file, error)
    lines = []
    order = sorted(examples.items(), key=lambda item: (item[0][0], -len(item[1]), item[0][1]))
    for (dialect, code), files in order:
        lines.append(f"  {dialect:9} {code} {len(files):4}")
        if verbose:
            messages = Counter(error.message for error in files.values())
            for message, number in messages.most_common(EXAMPLES):
                error = next(e for e in files.values() if e.message == message)
                lines.append(f"      {number:4} x {message}  ({error.primary})")
    return lines


def _refused(results: Iterable[Result]) -> list[str]:
    lines = []
    for result in results:
        if result.kind != INVALID and result.errors:
            codes = " ".join(sorted({error.code for error in result.errors}))
            first = min(result.errors, key=lambda e: e.primary.start if e.primary else 0)
            lines += [f"  {result.file}: {codes}", f"      {first.primary}: {first.message}"]
    return lines


def read_expected() -> Numbers:
    """Return the pinned numbers."""
    numbers: Numbers = json.loads(EXPECTED.read_text(encoding="utf-8"))
    return numbers


def main() -> int:
    """Print the report; with `--update` pin the numbers."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--verbose", action="store_true", help="show examples of every code")
    parser.add_argument("--files", action="store_true", help="show each file that is refused")
    parser.add_argument("--update", action="store_true", help="pin the numbers if none fell")
    parser.add_argument("--lower", action="store_true", help="with --update: even if some fell")
    options = parser.parse_args()
    data = os.environ.get("OSC2TX_TEST_DATA")
    if data is None:
        parser.error("set OSC2TX_TEST_DATA to the folder that holds `corpus`")
    results = compile_corpus(Path(data) / "corpus")
    print(render(results, verbose=options.verbose), end="")
    if options.files:
        print("", "refused:", *_refused(results), sep="\n")
    if not options.update:
        return 0
    numbers = count(results)
    fell, rose = compare(numbers, read_expected() if EXPECTED.exists() else {})
    print("", *(f"rose  {line}" for line in rose), *(f"fell  {line}" for line in fell), sep="\n")
    if fell and not options.lower:
        print("not updated; say --lower if that is intended")
        return 1
    EXPECTED.write_text(json.dumps(numbers, indent=2) + "\n", encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
