"""Cost of one pass over the tree, in units of one `next()` on a trivial generator (U).

Run: python benchmarks/tree.py
"""

from __future__ import annotations

import timeit
from collections.abc import Callable, Iterator
from typing import Any

import py_trees
from py_trees.common import ParallelPolicy, Status

from osc2tx_runtime.behaviour import (
    Behaviour,
    Emit,
    Event,
    On,
    OneOf,
    Parallel,
    Serial,
    Until,
    Wait,
    elapsed,
)
from osc2tx_runtime.context import ExecutionContext
from osc2tx_runtime.runner import settle, setup_tree
from osc2tx_runtime.scenario import Scenario


def best(call: Callable[[], object], repeat: int = 7) -> float:
    """Return seconds per call, the best of several rounds of at least 20 ms."""
    timer = timeit.Timer(call)
    number, _ = timer.autorange()
    return min(timer.repeat(repeat, max(1, number // 10))) / max(1, number // 10)


def unit() -> float:
    """Return the seconds of one `next()`."""

    def forever() -> Iterator[None]:
        while True:
            yield

    generators = [forever() for _ in range(1000)]

    def advance() -> None:
        for generator in generators:
            next(generator)

    return best(advance) / 1000


def ours(tree: Behaviour) -> tuple[ExecutionContext, Behaviour]:
    """Set a tree up in a run without a world, and start it."""
    world: Any = None
    context = ExecutionContext(world)
    setup_tree(tree, context)
    context.begin_step(0)
    context.begin_pass()
    tree.tick_once()
    assert tree.status is Status.RUNNING
    return context, tree


def floor(leaves: int) -> Behaviour:
    """Return py_trees' own parallel with running leaves."""
    members = [py_trees.behaviours.Running(f"leaf {index}") for index in range(leaves)]
    return py_trees.composites.Parallel("p", ParallelPolicy.SuccessOnAll(), members)


def waits(leaves: int) -> Behaviour:
    """Return a parallel of leaves that wait for an event."""
    return Parallel("p", *(Wait(Event()) for _ in range(leaves)))


def chain(depth: int, wrap: Callable[[str, Behaviour], Behaviour], leaf: Behaviour) -> Behaviour:
    """Return nested compositions around a leaf."""
    for level in range(depth):
        leaf = wrap(f"level {level}", leaf)
    return leaf


def foreign_serial(name: str, member: Behaviour) -> Behaviour:
    """Return py_trees' own sequence."""
    return py_trees.composites.Sequence(name, memory=True, children=[member])


def level_waits(leaves: int) -> Behaviour:
    """Return a parallel of leaves with a condition that is sampled once per step."""
    return Parallel("p", *(Wait(lambda: False) for _ in range(leaves)))


def mixed(branches: int) -> Behaviour:
    """Return branches as they stand in scenarios: race, until, duration."""
    return Parallel(
        "p",
        *(
            Serial(
                "s",
                OneOf("r", Wait(Event()), Until(Wait(elapsed(1e6)), Event())),
                duration=(0, 1e6),
            )
            for _ in range(branches)
        ),
    )


class Inner(Scenario):
    """Has a variable and a phase that waits."""

    name, source = "inner", "inner.osc"

    def declare(self) -> None:
        self.go = Event()
        self.gap = self.parameter("gap", 10.0)
        self.x = self.sample(lambda: self.gap, self.go, 0.0)

    def behavior(self) -> Behaviour:
        return Serial("inner", Wait(self.go))


class Invoking(Scenario):
    """Invokes many scenarios at once."""

    name, source = "invoking", "invoking.osc"

    def __init__(self, invoked: int) -> None:
        self.invoked_scenarios = invoked
        super().__init__()

    def behavior(self) -> Behaviour:
        calls = (self.invoke(Inner, label=f"p{i}") for i in range(self.invoked_scenarios))
        return Parallel("invoking", *calls)


def main() -> None:
    """Print the table."""
    u = unit()
    print(f"U = {u * 1e9:.1f} ns (one next() on a trivial generator)")
    print(f"{'tree':48}{'us':>10}{'U':>10}{'U/leaf':>10}")

    def row(name: str, seconds: float, leaves: int) -> None:
        print(f"{name:48}{seconds * 1e6:10.1f}{seconds / u:10.0f}{seconds / u / leaves:10.1f}")

    for leaves in (10, 100, 1000):
        tree = floor(leaves)
        tree.tick_once()
        row(f"py_trees Parallel, {leaves} Running", best(tree.tick_once), leaves)
        _, tree = ours(waits(leaves))
        row(f"Parallel, {leaves} Wait(event), pulse", best(tree.tick_once), leaves)
    _, tree = ours(waits(100))
    row("the same by py_trees' tick()", best(lambda: list(tree.tick())), 100)
    context, tree = ours(level_waits(100))

    def next_step() -> None:
        context.begin_step(context.step + 1)
        settle(tree.tick_once, context, ())  # type: ignore[arg-type]

    row("Parallel, 100 Wait(condition), a new step each", best(next_step), 100)
    context, tree = ours(waits(20))
    row("20 Wait(event), a whole instant of the runner", best(next_step), 20)
    _, tree = ours(mixed(20))
    row("20 branches of serial/one_of/until, 40 leaves", best(tree.tick_once), 40)
    tree = Parallel("p", *(Wait(Event()) for _ in range(100)), overlap="inside")
    _, tree = ours(tree)
    row("parallel(overlap: inside), 100 Wait(event)", best(tree.tick_once), 100)
    _, tree = ours(Parallel("p", *(On(Event(), Emit(Event())) for _ in range(100)), Wait(Event())))
    row("100 on beside a Wait(event)", best(tree.tick_once), 101)
    for invoked in (1, 100):
        tree = Invoking(invoked).create_tree()
        _, tree = ours(tree)
        row(f"{invoked} invoked scenarios, a variable each", best(tree.tick_once), 2 * invoked)
    row("create_tree of 100 invoked scenarios", best(lambda: Invoking(100).create_tree(), 3), 100)
    for depth in (10, 50, 200):
        tree = chain(depth, foreign_serial, py_trees.behaviours.Running("leaf"))
        tree.tick_once()
        row(f"py_trees Sequence, depth {depth}", best(tree.tick_once), 1)
        _, tree = ours(chain(depth, Serial, Wait(Event())))
        row(f"Serial, depth {depth}", best(tree.tick_once), 1)


if __name__ == "__main__":
    main()
