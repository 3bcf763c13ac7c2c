"""How the cost of a check grows with programs of some shapes, as exponents: 1.00 is linear.

    python benchmarks/growth.py [--build] [shape ...]

Each shape is a program of n parts. Printed are the CPU seconds at n, 2n, 4n and 8n, the least of a
few runs, and the exponent of each step. `tests/unit/test_growth.py` counts the work of the same
shapes. With `--build` modules and XML documents are made as well.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions

HEAD = """\
import osc.standard.all
namespace null use std, stdtypes

"""
CAST = """\
scenario main:
    road: map
    keep(road.map_file == "highway.xodr")
    car: vehicle
"""
DRIVE = "    do car.drive(duration: 2s)\n"


def sequence(n: int) -> str:
    """Actions one after the other."""
    return CAST + "    do serial:\n" + "        car.drive(duration: 2s)\n" * n


def choices(n: int) -> str:
    """Choices between two durations, side by side."""
    options = [f"            car.drive(duration: {each}s)\n" for each in (2, 3)]
    return CAST + "    do parallel:\n" + ("        one_of:\n" + "".join(options)) * n


def tower(n: int) -> str:
    """Compositions within each other."""
    lines = (f"{'    ' * (depth + 2)}serial:\n" for depth in range(n))
    return (
        CAST + "    do serial:\n" + "".join(lines) + "    " * (n + 2) + "car.drive(duration: 2s)\n"
    )


def signals(n: int) -> str:
    """Events, each emitted by one member of a parallel and awaited by another."""
    declared = "".join(f"    event signal_{k}\n" for k in range(n))
    awaited = "".join(f"        wait @signal_{k}\n" for k in range(n))
    emitted = "".join(
        f"        serial:\n            wait elapsed(1s)\n            emit signal_{k}\n"
        for k in range(n)
    )
    return CAST + declared + "    do parallel:\n" + awaited + emitted


def convoy(n: int) -> str:
    """Cars, each placed behind the one before."""
    cars = "".join(f"    car_{k}: vehicle\n" for k in range(n))
    drives = "".join(
        f"        car_{k}.drive(duration: 2s) with:\n"
        f"            position(10m, behind: {f'car_{k - 1}' if k else 'car'}, at: start)\n"
        for k in range(n)
    )
    return CAST + cars + "    do parallel:\n        car.drive(duration: 2s)\n" + drives


def pairs_in_structs(n: int) -> str:
    """Structs, each with two fields of the type before: 2^n values in the last one."""
    levels = (f"struct level_{k}:\n    left, right: level_{k - 1}\n" for k in range(1, n + 1))
    start = f"scenario main:\n    top: level_{n}\n    do wait elapsed(1s)\n"
    return "struct level_0:\n    value: int = 3\n" + "".join(levels) + start


def generations(n: int) -> str:
    """Scenarios that inherit from each other, each with one more constant."""
    first = "scenario base_0:\n    car: vehicle\n    const_0: int = 0\n" + DRIVE
    derived = (
        f"scenario base_{k} inherits base_{k - 1}:\n    const_{k}: int = {k}\n"
        for k in range(1, n + 1)
    )
    return first + "".join(derived)


def twice_invoked(n: int) -> str:
    """Scenarios, each of which invokes the one before twice."""
    first = "scenario step_0:\n    car: vehicle\n" + DRIVE
    others = (
        f"scenario step_{k}:\n    car: vehicle\n    do serial:\n"
        + f"        step_{k - 1}(car: car)\n" * 2
        for k in range(1, n + 1)
    )
    return first + "".join(others)


def rising(n: int) -> str:
    """Parameters that are each less than the next."""
    declared = "".join(
        f"    limit_{k}: speed\n    keep(limit_{k} in [2mps..50mps])\n" for k in range(n)
    )
    order = "".join(f"    keep(limit_{k} < limit_{k + 1})\n" for k in range(n - 1))
    return CAST + declared + order + DRIVE


def total(n: int) -> str:
    """Numbers with a given sum."""
    declared = "".join(f"    part_{k}: int\n    keep(part_{k} in [0..5])\n" for k in range(n))
    return (
        CAST
        + declared
        + f"    keep({' + '.join(f'part_{k}' for k in range(n))} == {2 * n})\n"
        + DRIVE
    )


def one_of_two(n: int) -> str:
    """Pairs of numbers of which one is known."""
    declared = "".join(f"    one_{k}, two_{k}: int\n" for k in range(n))
    rules = "".join(f"    keep(one_{k} == 3 or two_{k} == 4)\n" for k in range(n))
    return CAST + declared + rules + DRIVE


def logic(n: int) -> str:
    """Clauses of three truth values, each of which stands in three of them."""
    declared = "".join(f"    flag_{k}: bool\n" for k in range(n))
    rules = "".join(
        f"    keep(not flag_{k} or flag_{(k + 1) % n} or flag_{(5 * k + 3) % n})\n"
        for k in range(n)
    )
    return CAST + declared + rules + DRIVE


def misspelt(n: int) -> str:
    """Names that are not defined, each like one that is."""
    declared = "".join(f"    distance_{k}: int = {k}\n" for k in range(n))
    used = "".join(f"    copy_{k}: int = distnace_{k}\n" for k in range(n))
    return CAST + declared + used + DRIVE


def wide(n: int) -> str:
    """Cars that all drive at once."""
    cars = "".join(f"    car_{k}: vehicle\n" for k in range(n))
    drives = "".join(
        f"        car_{k}.drive(duration: 2s) with:\n            speed({k % 20 + 1}mps)\n"
        for k in range(n)
    )
    return CAST + cars + "    do parallel:\n" + drives


def enumerations(n: int) -> str:
    """Enumerations of eight members, each with a parameter."""
    kinds = (
        f"enum kind_{k}: [{', '.join(f'member_{k}_{m}' for m in range(8))}]\n\n" for k in range(n)
    )
    used = "".join(f"    value_{k}: kind_{k} = kind_{k}!member_{k}_3\n" for k in range(n))
    return "".join(kinds) + CAST + used + DRIVE


def members_of_an_enumeration(n: int) -> str:
    """One enumeration with many members."""
    kind = f"enum kind: [{', '.join(f'member_{k}' for k in range(n))}]\n\n"
    return kind + CAST + f"    value: kind\n    keep(value != kind!member_{n - 1})\n" + DRIVE


def list_of_numbers(n: int) -> str:
    """A list with many elements."""
    values = ", ".join(f"{k}m" for k in range(n))
    return CAST + f"    values: list of length = [{values}]\n" + DRIVE


def long_sum(n: int) -> str:
    """An expression of many terms."""
    return CAST + f"    value: int = {' + '.join(str(k) for k in range(n))}\n" + DRIVE


def deep_expression(n: int) -> str:
    """An expression within many parentheses."""
    return CAST + f"    value: int = {'(1 + ' * n}1{')' * n}\n" + DRIVE


def rules(n: int) -> str:
    """Parameters, each with a constraint of its own."""
    declared = "".join(
        f"    limit_{k}: speed\n    keep(limit_{k} in [{k + 1}mps..{k + 2}mps])\n" for k in range(n)
    )
    return CAST + declared + DRIVE


def reactions(n: int) -> str:
    """Handlers of conditions."""
    handlers = "".join(
        f"    event signal_{k}\n    on rise(car.speed > {k + 1}mps):\n        emit signal_{k}\n"
        for k in range(n)
    )
    return CAST + handlers + DRIVE


def scenarios(n: int) -> str:
    """Scenarios that are each invoked once."""
    parts = (f"scenario part_{k}:\n    car: vehicle\n{DRIVE}\n" for k in range(n))
    invoked = "".join(f"        part_{k}(car: car)\n" for k in range(n))
    return "".join(parts) + CAST + "    do serial:\n" + invoked


def chain_of_invocations(n: int) -> str:
    """Scenarios, each of which invokes the one before."""
    first = "scenario step_0:\n    car: vehicle\n" + DRIVE
    others = (
        f"scenario step_{k}:\n    car: vehicle\n    do step_{k - 1}(car: car)\n"
        for k in range(1, n + 1)
    )
    return first + "".join(others)


def modifiers(n: int) -> str:
    """Actions with several modifiers each."""
    drives = "".join(
        f"        car.drive(duration: 2s) with:\n            speed({k % 20 + 1}mps, at: end)\n"
        "            lane(1, at: start)\n            keep_lane()\n"
        for k in range(n)
    )
    return CAST + "    do serial:\n" + drives


def extensions(n: int) -> str:
    """Extensions of one type."""
    parts = (f"extend vehicle:\n    field_{k}: int = {k}\n\n" for k in range(n))
    return "".join(parts) + CAST + DRIVE


def methods(n: int) -> str:
    """Methods, each of which calls the one before."""
    first = "struct sums:\n    def sum_0() -> int is expression 0\n"
    others = (f"    def sum_{k}() -> int is expression sum_{k - 1}() + 1\n" for k in range(1, n))
    return first + "".join(others) + CAST + DRIVE


def covers(n: int) -> str:
    """Coverage items."""
    items = "".join(
        f"    value_{k}: int\n    keep(value_{k} in [0..9])\n    cover(value_{k})\n"
        for k in range(n)
    )
    return CAST + items + DRIVE


def comments(n: int) -> str:
    """Comments and blank lines."""
    return CAST + "    # a remark that nobody needs\n\n" * n + DRIVE


def broken_lines(n: int) -> str:
    """Errors of syntax, one in each line."""
    return CAST + "    car car: = vehicle\n" * n + DRIVE


def wrong_types(n: int) -> str:
    """Values that have other types than their parameters."""
    return CAST + "".join(f"    value_{k}: speed = {k}m\n" for k in range(n)) + DRIVE


def same_names(n: int) -> str:
    """A name that is declared again and again."""
    return CAST + "    value: int = 3\n" * n + DRIVE


SHAPES: Mapping[str, tuple[Callable[[int], str], int]] = {
    shape.__name__: (shape, size)
    for shape, size in (
        (sequence, 50),
        (choices, 5),
        (tower, 10),
        (signals, 10),
        (convoy, 5),
        (pairs_in_structs, 8),
        (generations, 25),
        (twice_invoked, 5),
        (rising, 10),
        (total, 6),
        (one_of_two, 8),
        (logic, 16),
        (misspelt, 50),
        (wide, 10),
        (enumerations, 20),
        (members_of_an_enumeration, 50),
        (list_of_numbers, 50),
        (long_sum, 50),
        (deep_expression, 10),
        (rules, 20),
        (reactions, 10),
        (scenarios, 20),
        (chain_of_invocations, 10),
        (modifiers, 20),
        (extensions, 20),
        (methods, 20),
        (covers, 20),
        (comments, 200),
        (broken_lines, 20),
        (wrong_types, 50),
        (same_names, 50),
    )
}
"""Each shape with its smallest size."""


def compile_shape(name: str, size: int, *, build: bool = False) -> Compilation:
    """Return the compilation of a shape, all products made that are asked for."""
    options = CompileOptions(target="all" if build else "py")
    text = HEAD + SHAPES[name][0](size)
    compilation = Compilation(Path("shape.osc"), "shape.osc", options, text=text)
    compilation.check()
    if build:
        compilation.outputs()
    return compilation


def main() -> None:
    from costs import best, growth

    parser = argparse.ArgumentParser(description="Growth of a check with the size of programs.")
    parser.add_argument("shapes", nargs="*", choices=[[], *SHAPES], help="all, if left out")
    parser.add_argument("--build", action="store_true", help="make modules and XML documents too")
    arguments = parser.parse_args()
    for name in arguments.shapes or SHAPES:
        sizes = tuple(SHAPES[name][1] * factor for factor in (1, 2, 4, 8))
        costs = [best(partial(compile_shape, name, n, build=arguments.build), 2) for n in sizes]
        seconds = " ".join(f"{cost:8.3f}" for cost in costs)
        print(f"{name:<18} {sizes!s:<22} {seconds}   {growth(sizes, costs)}", flush=True)


if __name__ == "__main__":
    main()
