"""How fast the front end is, and whether time and memory grow linearly.

    python benchmarks/frontend.py [--no-start] [lines ...]

Prints, for generated files of 6,000, 30,000 and 150,000 lines:

- lines per second of lexing, parsing, AST and model, of all from text to AST, of the stages of a
  check behind the model, and of the whole check;
- the time of a check as a multiple of the time from text to model;
- the growth exponent of each stage, 1.00 being linear;
- the highest memory of a process that checks the text, in KB a line.

Then the costs of starting: the library against parsing it, and `osc2tx check` of
one scenario in a new process, for the first time and again, against `python -c "import antlr4"`.

Times are CPU seconds, the least of a few runs. Ratios count, not seconds: the column `x loop`
compares the whole check with a loop over the characters of the same text.
"""

import argparse
import gc
import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import TypeVar

from osc2tx import stdlib
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.options import CompileOptions
from osc2tx.semantics import ASAM, ModelBuilder
from osc2tx.stdlib.parsed import load_parsed
from osc2tx.support.recursion import allowing_deep_trees
from osc2tx.syntax import parse
from osc2tx.syntax.ast_transformer import ASTTransformer
from osc2tx.syntax.parser import parse_tokens
from osc2tx.syntax.token_source import TokenSource

T = TypeVar("T")
ROOT = Path(__file__).resolve().parents[1]
STANDARD = "2.2"
OPTIONS = CompileOptions()
STAGES = (
    *("lexing", "parsing", "AST", "text to AST"),
    *("model", "analysis", "lowering", "support", "check"),
)
CHECKED = {"analysis": "analysis", "lowering": "ir", "support": "is_supported"}
"""The products of a compilation that a check asks for, by the names of the stages here."""

HEADER = """\
import osc.standard

actor approach_base:
    ready: bool

"""
SCENARIO = """\
# Approach number {n}
scenario vehicle.approach_{n}:
    lead_{n}: vehicle with:
        keep(it.vehicle_category == car)
        keep(default it.rear_overhang <= 1.2m)
    gap: length with:
        keep(it in [10m..30m])
    v_max: speed = 60kph
    var closest: length = sample(actor.object_distance(lead_{n}, longitudinal), @near)
    event near is rise(actor.object_distance(lead_{n}, longitudinal) < 12m)
    event far(distance: length)
    def half(x: float, y: float) -> float is expression (x + y) / 2.0 - 3 * x
    keep(default v_max <= 120kph and gap > 5m or not gap == 8m)

    do serial(duration: [5s..40s]):
        close_in: drive() with:
            position(gap, behind: lead_{n}, at: start)
            speed(v_max, at: end)
            lane(same_as: lead_{n})
            until @near
        parallel(overlap: start):
            p{n}: actor.change_lane(num_of_lanes: 1, side: right)
            lead_{n}.drive() with:
                speed([30kph..50kph])
                until elapsed(30s)
            serial:
                wait @p{n}.end if gap < 20m and v_max > 3.5mps
                settle: wait elapsed(1s)
                emit far(distance: gap * 2)
        hold_gap: keep_space_gap(lead_{n}, longitudinal, duration: 5s)
        actor.change_speed(target: 0kph, rate_profile: asap)
"""


def scenario_text(lines: int) -> str:
    block = SCENARIO.count("\n")
    return HEADER + "".join(SCENARIO.format(n=n) for n in range(math.ceil(lines / block)))


def best(work: Callable[[], object], runs: int) -> float:
    return min(timed(work)[0] for _ in range(runs))


def timed(work: Callable[[], T]) -> tuple[float, T]:
    gc.collect()
    start = time.process_time()
    result = work()
    return time.process_time() - start, result


def trivial(text: str) -> int:
    count = 0
    for char in text:
        if char == "\n":
            count += 1
    return count


# --- Stages ---------------------------------------------------------------------------------------


def stages_to_ast(source: SourceFile, sink: DiagnosticSink, runs: int) -> dict[str, float]:
    times = {}
    with allowing_deep_trees():
        table = TokenSource(source, sink).scan()
        times["lexing"] = best(lambda: TokenSource(source, sink).scan(), runs)
        times["parsing"] = times["AST"] = math.inf
        for _ in range(runs):
            seconds, tree = timed(partial(parse_tokens, table, sink))
            times["parsing"] = min(times["parsing"], seconds)
            seconds, _file = timed(partial(ASTTransformer(table, sink, ()).transform, tree))
            times["AST"] = min(times["AST"], seconds)
    return times


def stages_of_check(source: SourceFile, runs: int) -> dict[str, float]:
    """Return the seconds of a whole check, and of its stages behind the model."""
    times = dict.fromkeys((*CHECKED, "check"), math.inf)
    for _ in range(runs):
        compilation = Compilation(Path(source.name), source.name, OPTIONS, text=source.text)
        before, _ = timed(partial(getattr, compilation, "model"))
        after = {
            stage: timed(partial(getattr, compilation, product))[0]
            for stage, product in CHECKED.items()
        }
        assert not compilation.sink.has_errors, compilation.reports[0]
        after["check"] = before + sum(after.values())
        times = {stage: min(times[stage], spent) for stage, spent in after.items()}
    return times


def measure(wanted: int) -> tuple[int, dict[str, float]]:
    """Print one row; return the number of lines and the seconds of each stage."""
    source = SourceFile("bench.osc", scenario_text(wanted))
    lines = source.text.count("\n")
    runs = 5 if lines <= 11_000 else 2
    sink = DiagnosticSink()
    times = stages_to_ast(source, sink, runs)
    times["text to AST"] = best(lambda: parse(source, sink), runs)
    file = parse(source, sink)
    assert not sink.has_errors, sink.sorted()[0]

    def model() -> None:
        reports = DiagnosticSink()
        builder = ModelBuilder(
            reports, standard=STANDARD, dialect=ASAM, load=lambda statement, source: None
        )
        builder.build(file)
        assert not reports.has_errors, reports.sorted()[0]

    times["model"] = best(model, runs)
    times |= stages_of_check(source, runs)
    loop = best(lambda: trivial(source.text), runs)
    rates = [f"{lines / times[stage]:>12,.0f}" for stage in STAGES]
    multiple = times["check"] / (times["text to AST"] + times["model"])
    print(f"{lines:>8,}", *rates, f"{times['check'] / loop:>8.0f} {multiple:>7.2f}", flush=True)
    return lines, times


def print_growth(rows: list[tuple[int, dict[str, float]]]) -> None:
    for (small, before), (large, after) in pairwise(rows):
        exponents = [
            f"{stage} {math.log(after[stage] / before[stage]) / math.log(large / small):.2f}"
            for stage in STAGES
        ]
        print(f"growth exponents from {small:,} to {large:,} lines: {', '.join(exponents)}")


PEAK = """\
import re, sys
sys.path.insert(0, sys.argv[2])
from pathlib import Path
from benchmarks.frontend import OPTIONS, Compilation, scenario_text

def peak():
    status = open("/proc/self/status", encoding="ascii").read()
    return int(re.search(r"VmHWM:\\s*(\\d+) kB", status)[1])

def check(text):
    compilation = Compilation(Path("bench.osc"), "bench.osc", OPTIONS, text=text)
    assert compilation.check()
    return compilation

text = scenario_text(int(sys.argv[1]))
check(scenario_text(100))
before = peak()
kept = check(text)
print((peak() - before) / text.count("\\n"))
"""


def print_memory(sizes: list[int]) -> None:
    """The memory of a new process each, beyond its initial one; on Linux."""
    for size in sizes:
        command = [sys.executable, "-c", PEAK, str(size), str(ROOT)]
        peak = float(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)
        print(f"peak memory of checking {size:,} lines: {peak:.1f} KB a line", flush=True)


# --- Start ----------------------------------------------------------------------------------------


def print_library() -> None:
    """The library as `check` reads it, against parsing it."""
    sources = [stdlib.library_source(name, STANDARD) for name in (stdlib.TYPES, stdlib.DOMAIN)]
    assert all(load_parsed(source, STANDARD) for source in sources)
    load = best(lambda: [load_parsed(source, STANDARD) for source in sources], 20)
    parsing = best(lambda: [stdlib.parse_library_file(source) for source in sources], 5)
    print(f"library: {load * 1000:.1f} ms, parsing it takes {parsing / load:.1f} times as long")


def cpu_of(command: list[str], environment: Mapping[str, str]) -> float:
    import resource

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, env=environment, capture_output=True, check=True, cwd=ROOT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def print_start() -> None:
    """A new process for each; compiled modules are cached, wherever the shell says otherwise."""
    check = ["-m", "osc2tx", "check", "scenarios/cut_in_and_evade.osc"]
    commands = {
        "bare Python": ["-c", "pass"],
        "import antlr4": ["-c", "import antlr4"],
        "import click": ["-c", "import click"],
        "check without cache": check,
        "check": [*check, "--no-cache"],
        "check, remembered": check,
    }
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": folder, "XDG_CACHE_HOME": folder}
        environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        environment.pop("OSC2TX_NO_CACHE", None)
        times: dict[str, list[float]] = {name: [] for name in commands}
        for _ in range(8):
            for name, arguments in commands.items():
                own = {**environment, "OSC2TX_NO_CACHE": "1" if "without" in name else ""}
                times[name].append(cpu_of([sys.executable, *arguments], own))
    least = {name: min(values) for name, values in times.items()}
    for name, seconds in least.items():
        ratio = seconds / least["import antlr4"]
        print(f"{name:<24} {seconds * 1000:>6.0f} ms  {ratio:.2f} x `import antlr4`")


def main() -> None:
    parser = argparse.ArgumentParser(description="Speed of the front end.")
    parser.add_argument("lines", type=int, nargs="*", help="sizes of the generated files")
    parser.add_argument("--no-start", action="store_true", help="leave out the cost of a start")
    arguments = parser.parse_args()
    sizes = arguments.lines or [6_000, 30_000, 150_000]
    heads = " ".join(f"{stage:>12}" for stage in STAGES)
    print(f"   lines {heads}   x loop x model")
    print_growth([measure(size) for size in sizes])
    if sys.platform == "linux":
        print_memory(sizes)
    print_library()
    if sys.platform != "win32" and not arguments.no_start:
        print_start()


if __name__ == "__main__":
    main()
