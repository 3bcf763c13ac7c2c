"""Slots and effects: hand-over, conflicts, what the world is told."""

from __future__ import annotations

from typing import Any

import pytest

from osc2tx_runtime.errors import ScenarioError, SlotConflict
from osc2tx_runtime.language.tree import Behaviour, Parallel, Serial, Wait, elapsed
from osc2tx_runtime.world.commands import KeepLane
from tests.runtime.tree.kit import Drive, FakeActor, Run, Switch, Task

HERO: Any = FakeActor("hero")


def at_line(node: Any, line: int) -> Any:
    node.source, node.position = f"x.osc:{line}", line
    return node


def test_hand_over_in_a_serial_is_one_command() -> None:
    tree = Serial("s", Drive(HERO, 5.0, duration=0.2), Drive(HERO, 8.0, duration=0.2))
    run = Run(tree, ids=("hero",)).go()
    slot = ("hero", "longitudinal")
    assert run.world.commands == [(0, *slot, 5.0), (4, *slot, 8.0), (8, *slot, None)]


@pytest.mark.parametrize("swap", [False, True])
def test_hand_over_between_branches_does_not_depend_on_their_order(swap: bool) -> None:
    members: list[Behaviour] = [
        Drive(HERO, 5.0, duration=0.2),
        Serial("s", Wait(elapsed(0.2)), Drive(HERO, 8.0, duration=0.2)),
    ]
    run = Run(Parallel("p", *(members[::-1] if swap else members)), ids=("hero",)).go()
    assert [(k, command) for k, _, _, command in run.world.commands] == [
        (0, 5.0),
        (4, 8.0),
        (8, None),
    ]


@pytest.mark.parametrize("swap", [False, True])
def test_two_live_owners_conflict(swap: bool) -> None:
    members = [at_line(Drive(HERO), 10), at_line(Drive(HERO), 9)]
    run = Run(Parallel("p", *(members[::-1] if swap else members)), ids=("hero",))
    with pytest.raises(SlotConflict) as caught:
        run.go()
    assert str(caught.value) == (
        "x.osc:10: hero drive (x.osc:9) and hero drive (x.osc:10) control the longitudinal slot"
        " of hero at the same time; let them run one after the other (at 0.000 s)"
    )
    assert run.world.commands == []
    assert not run.context.slots.live()


def test_command_without_claim_is_refused() -> None:
    class Pushy(Task):
        def on_start(self) -> None:
            self.command("lateral", KeepLane())

    with pytest.raises(ScenarioError, match="commands the lateral slot of hero without owning it"):
        Run(Pushy(HERO, 1), ids=("hero",)).go()


def test_the_last_effect_of_a_sequence_counts() -> None:
    run = Run(Serial("s", Switch(HERO, "on"), Switch(HERO, "off"))).go()
    assert [line for line in run.lines if "lights" in line] == [
        '{"t":0.0,"kind":"lights","actor":"hero","mode":"off"}'
    ]


def test_parallel_effects_must_agree() -> None:
    assert Run(Parallel("p", Switch(HERO, "on"), Switch(HERO, "on"))).go().outcome.steps == 0
    tree = Parallel("p", at_line(Switch(HERO, "on"), 1), at_line(Switch(HERO, "off"), 2))
    with pytest.raises(SlotConflict, match="control lights hero at the same time"):
        Run(tree).go()
