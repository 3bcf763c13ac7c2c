"""What one pass over a tree costs, beside the floor: what py_trees' own compositions cost."""

from __future__ import annotations

from collections.abc import Callable

import py_trees
from costs import best, growth, upto
from py_trees.common import ParallelPolicy, Status

from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.tree import (
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
from osc2tx_runtime.opendrive import read_map
from osc2tx_runtime.running.loop import settle
from osc2tx_runtime.running.preparation import setup_tree
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_shared.map_files import SHIPPED

LEAVES = (10, 100, 1000)
DEPTHS = (10, 50, 200)


def started(tree: Behaviour) -> tuple[ExecutionContext, Behaviour]:
    """Set a tree up in a run without actors, and start it."""
    context = ExecutionContext(EmbeddedWorld(read_map(SHIPPED / "crossing.xodr"), 0.05))
    setup_tree(tree, context)
    context.begin_step(0)
    context.begin_pass()
    tree.tick_once()
    assert tree.status is Status.RUNNING
    return context, tree


def chain(depth: int, wrap: Callable[[str, Behaviour], Behaviour], leaf: Behaviour) -> Behaviour:
    for level in range(depth):
        leaf = wrap(f"level {level}", leaf)
    return leaf


def their_parallel(leaves: int) -> Behaviour:
    members = [py_trees.behaviours.Running(f"leaf {index}") for index in range(leaves)]
    return py_trees.composites.Parallel("p", ParallelPolicy.SuccessOnAll(), members)


def their_chain(depth: int) -> Behaviour:
    def sequence(name: str, member: Behaviour) -> Behaviour:
        return py_trees.composites.Sequence(name, memory=True, children=[member])

    return chain(depth, sequence, py_trees.behaviours.Running("leaf"))


def waits(leaves: int) -> Behaviour:
    return Parallel("p", *(Wait(Event()) for _ in range(leaves)))


def branches(count: int) -> Behaviour:
    """Branches as in scenarios: race, until, duration; two leaves each."""
    return Parallel(
        "p",
        *(
            Serial(
                "s",
                OneOf("r", Wait(Event()), Until(Wait(elapsed(1e6)), Event())),
                duration=(0, 1e6),
            )
            for _ in range(count)
        ),
    )


def reactions(count: int) -> Behaviour:
    return Parallel("p", *(On(Event(), Emit(Event())) for _ in range(count)), Wait(Event()))


def instant(tree: Behaviour) -> Callable[[], object]:
    """Do the work of the runner at each step: passes until nothing is pending."""
    context, started_tree = started(tree)

    def next_step() -> None:
        context.begin_step(context.step + 1)
        settle(started_tree, started_tree.tick_once, context, ())  # type: ignore[arg-type]

    return next_step


def print_trees(u: float, largest: int) -> None:
    leaf_counts, depths = upto(largest, LEAVES), upto(largest, DEPTHS)
    print(f"\n{'trees: one pass':48}{'us':>10}{'U':>10}{'U/leaf':>10}")

    def row(name: str, work: Callable[[], object], leaves: int) -> float:
        seconds = best(work)
        print(f"{name:48}{seconds * 1e6:10.1f}{seconds / u:10.0f}{seconds / u / leaves:10.1f}")
        return seconds

    floor = []
    for leaves in leaf_counts:
        tree = their_parallel(leaves)
        tree.tick_once()
        floor.append(row(f"py_trees Parallel, {leaves} Running", tree.tick_once, leaves))
    ours = [
        row(f"Parallel, {leaves} Wait(event)", started(waits(leaves))[1].tick_once, leaves)
        for leaves in leaf_counts
    ]
    for depth in depths:
        tree = their_chain(depth)
        tree.tick_once()
        row(f"py_trees Sequence, depth {depth}", tree.tick_once, 1)
    deep = [
        row(f"Serial, depth {d}", started(chain(d, Serial, Wait(Event())))[1].tick_once, 1)
        for d in depths
    ]
    row("20 branches of serial, one_of, until", started(branches(20))[1].tick_once, 40)
    row("100 on beside a Wait(event)", started(reactions(100))[1].tick_once, 101)
    row("20 Wait(event), a whole instant of the runner", instant(waits(20)), 20)
    levels = Parallel("p", *(Wait(lambda: False) for _ in range(100)))
    row("100 Wait(condition), a whole instant", instant(levels), 100)
    print(f"growth exponents with leaves: py_trees {growth(leaf_counts, floor)},", end=" ")
    print(f"ours {growth(leaf_counts, ours)}; with depth: {growth(depths, deep)}")
