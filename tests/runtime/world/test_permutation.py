"""Trees of real actions in the embedded world: the order of members changes no byte of the trace.

The trees are drawn: compositions over actions of three cars, with modifiers, gaps, lane changes and
conditions on each other. Where two members control the same thing, the conflict is the same too.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from osc2tx_runtime import (
    Behaviour,
    OneOf,
    Parallel,
    RunSettings,
    Serial,
    Status,
    Until,
    Vehicle,
    Wait,
    elapsed,
    run_scenario,
)
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import acceleration, avoid_collisions, lane, lateral, position, speed
from tests.runtime.world.two_cars import TwoCars
from tests.traces import whatever_the_order

Made = Callable[[], Behaviour]


class Three(TwoCars):
    """Two cars in one lane and one beside them."""

    def declare(self) -> None:
        super().declare()
        self.c = Vehicle()

    def placement(self) -> None:
        super().placement()
        self.place(self.c, lane(3), position(distance=70.0), speed(11.0))


class Drawn(Three):
    """Behaviour from a seed; `shuffle` permutes the members of parallels.

    Those of `one_of` keep their order: which of several for one actor is drawn depends on it.
    """

    seed = 0
    shuffle: random.Random | None = None

    def behavior(self) -> Behaviour:
        self.draw = random.Random(self.seed)
        return self.tree(3)

    def tree(self, depth: int) -> Behaviour:
        if depth == 0 or self.draw.random() < 0.15:
            return self.leaf()
        members = [self.tree(depth - 1) for _ in range(self.draw.randint(2, 3))]
        kind = self.draw.choice(("serial", "serial", "parallel", "parallel", "one_of", "until"))
        if kind == "serial":
            return Serial("serial", *members)
        if kind == "until":
            return Until(members[0], elapsed(self.draw.choice((0.5, 1.0, 2.0))))
        if self.shuffle is not None and kind == "parallel":
            self.shuffle.shuffle(members)
        return (Parallel if kind == "parallel" else OneOf)(kind, *members)

    def leaf(self) -> Behaviour:
        draw = self.draw
        me, other = draw.sample((self.a, self.b, self.c), 2)
        time = draw.choice((0.5, 1.0, 1.5, (0.5, 4.0)))
        makers: list[Made] = [
            lambda: me.change_speed(target=draw.uniform(6.0, 14.0)),
            lambda: me.change_lane(side=draw.choice(("left", "right")), duration=2.0),
            lambda: me.drive(speed(draw.uniform(6.0, 14.0)), duration=time),
            lambda: me.drive(speed(1.0, faster_than=other), lane(same_as=other), duration=time),
            lambda: me.drive(acceleration(0.5), avoid_collisions(True), duration=time),
            lambda: me.drive(position(20.0, behind=other), lateral(0.2), duration=time),
            lambda: me.follow_lane(offset=0.3, duration=time),
            lambda: me.keep_space_headway(reference=other, duration=time),
            lambda: me.keep_speed(duration=time),
            lambda: Wait(elapsed(draw.choice((0.3, 0.8)))),
            lambda: Wait(lambda: me.speed > other.speed),
        ]
        return draw.choice(makers)()


def outcome(seed: int, shuffle: random.Random | None) -> list[str]:
    made = type("Made", (Drawn,), {"seed": seed, "shuffle": shuffle})
    try:
        result = run_scenario(made, RunSettings(max_time=6.0))
    except ScenarioError as error:
        return [type(error).__name__]
    assert result.status in ("success", "failure", "timeout")
    return whatever_the_order(result.trace_lines)


@pytest.mark.parametrize(
    "seed", [*range(16), *(pytest.param(n, marks=pytest.mark.slow) for n in range(16, 80))]
)
def test_the_order_of_members_changes_nothing(seed: int) -> None:
    first = outcome(seed, None)
    assert outcome(seed, random.Random(seed)) == first
    assert outcome(seed, None) == first


@pytest.mark.slow
def test_most_of_the_drawn_trees_run() -> None:
    lengths = [len(outcome(seed, None)) for seed in range(80)]
    assert sum(length > 30 for length in lengths) >= 30


@pytest.mark.parametrize("when", [0.0, 0.5])
def test_an_exception_leaves_nothing_running_and_nobody_commanded(when: float) -> None:
    made: list[Behaviour] = []

    class Broken(Three):
        def behavior(self) -> Behaviour:
            tree = Parallel(
                "all",
                self.a.change_lane(side="left"),
                self.b.drive(speed(14.0), duration=5.0),
                Serial(
                    "then",
                    Wait(elapsed(when)),
                    self.c.change_speed(target=lambda: 1.0 / (self.c.speed - self.c.speed)),
                ),
            )
            made.append(tree)
            return tree

    with pytest.raises(ScenarioError, match="division by zero"):
        run_scenario(Broken)
    (tree,) = made
    assert all(node.status is not Status.RUNNING for node in tree.iterate())
    assert not tree.context.slots.live()
