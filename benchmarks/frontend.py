"""How fast the front end is: lines per second of each stage, and whether time grows linearly.

    python benchmarks/frontend.py [lines ...]

Times are CPU seconds, best of a few runs. Ratios count, not seconds: the last column compares the
whole front end with a trivial loop over the characters of the same text.
"""

import gc
import math
import sys
import time
from collections.abc import Callable

from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.syntax import parse
from osc2tx.syntax.ast_transformer import ASTTransformer
from osc2tx.syntax.parser import parse_tokens, room_for_trees
from osc2tx.syntax.token_source import TokenSource

SCENARIO = """\
# Approach number {n}
scenario vehicle.approach_{n} inherits vehicle.base_approach:
    lead_{n}: vehicle with:
        keep(it.vehicle_category == car)
        keep(it.model == "vehicle.tesla.model3")
    gap: length with:
        keep(it in [10m..30m])
    v_max: speed = 60kph
    var closest: length = sample(actor.object_distance(lead_{n}, longitudinal), @gap.end)
    event near is rise(actor.object_distance(lead_{n}, longitudinal) < 12m)
    event far(distance: length = 5m)
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
    return "".join(SCENARIO.format(n=n) for n in range(math.ceil(lines / block)))


def best(work: Callable[[], object], runs: int) -> float:
    times = []
    for _ in range(runs):
        gc.collect()
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def trivial(text: str) -> int:
    count = 0
    for char in text:
        if char == "\n":
            count += 1
    return count


def measure(lines: int) -> float:
    """Print one row; return the seconds of the whole front end."""
    source = SourceFile("bench.osc", scenario_text(lines))
    lines = source.text.count("\n")
    runs = 5 if lines <= 10_000 else 1
    sink = DiagnosticSink()
    with room_for_trees():
        table = TokenSource(source, sink).scan()
        lexing = best(lambda: TokenSource(source, sink).scan(), runs)
        parsing = best(lambda: parse_tokens(table, sink), runs)
        tree = parse_tokens(table, sink)
        building = best(lambda: ASTTransformer(table, sink, ()).transform(tree), runs)
    whole = best(lambda: parse(source, sink), runs)
    loop = best(lambda: trivial(source.text), runs)
    assert not sink.sorted(), sink.sorted()[0]
    rates = [f"{lines / seconds:>12,.0f}" for seconds in (lexing, parsing, building, whole)]
    print(f"{lines:>8,}", *rates, f"{whole / loop:>14.0f}")
    return whole


def main() -> None:
    sizes = [int(argument) for argument in sys.argv[1:]] or [1_000, 10_000, 100_000]
    print("   lines   lexing l/s  parsing l/s      AST l/s      all l/s   x trivial loop")
    times = [measure(size) for size in sizes]
    for (small, fast), (large, slow) in zip(
        zip(sizes, times, strict=True), list(zip(sizes, times, strict=True))[1:], strict=False
    ):
        exponent = math.log(slow / fast) / math.log(large / small)
        print(f"growth from {small:,} to {large:,} lines: exponent {exponent:.2f}")


if __name__ == "__main__":
    main()
