"""Events and groups that are executed several times: as steps of their own each time.

An execution starts when the one before it is over. A condition that is met at one instant is not
met again; a time or an end that has come is not waited for again.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from osc2tx.importing.conditions import Condition, Trigger
from osc2tx.importing.steps import Board, Step
from osc2tx_shared.classes import replace


def may_start_again(step: Step, group: Collection[Step], board: Board) -> bool:
    """Whether an event starts another time, if the events of its group do."""
    return _again(step.triggers[1], group, board) is not None


def is_first(step: Step, group: Collection[Step], board: Board) -> bool:
    """Whether an event waits for none of its group."""
    conditions = (each for group_ in step.triggers[1].groups for each in group_)
    return not any(_is_inside(each, group, board) for each in conditions)


def put_behind(steps: Sequence[Step], before: Sequence[Step], board: Board) -> None:
    """Let the steps of an execution start when those of the one before it are over."""
    for step in steps:
        trigger = _again(step.triggers[1], steps, board)
        assert trigger is not None, "only what may start again is executed again"
        if is_first(step, steps, board):
            step.before = tuple(before)
        step.triggers = Trigger(), trigger


def name_within(steps: Sequence[Step], board: Board, execution: int) -> None:
    """Let conditions in an execution of a group be about the events of that execution."""
    for step in steps:
        act, event = step.triggers
        groups = [[_named(each, steps, board, execution) for each in g] for g in event.groups]
        step.triggers = act, Trigger(groups, event.node, event.after)


def _named(condition: Condition, steps: Sequence[Step], board: Board, execution: int) -> Condition:
    inside = _inside(condition, steps, board)
    if not inside:
        return condition
    kind, name = condition.element
    element = kind, f"{name} ({inside[0].label}, {execution})"
    board.elements[element] = inside
    return replace(condition, element=element)


def _inside(condition: Condition, steps: Collection[Step], board: Board) -> list[Step]:
    if condition.kind != "state":
        return []
    return [each for each in board.elements.get(condition.element, ()) if each in steps]


def _is_inside(condition: Condition, steps: Collection[Step], board: Board) -> bool:
    return bool(_inside(condition, steps, board))


def _again(trigger: Trigger, steps: Collection[Step], board: Board) -> Trigger | None:
    """Return what is waited for in another execution; `None`: it does not come again."""
    groups = []
    for group in trigger.groups:
        found = [(each, _is_inside(each, steps, board)) for each in group]
        if any(not inside and _is_momentary(each) for each, inside in found):
            continue
        groups.append([_lasting(each) for each, inside in found if inside or not _stays(each)])
    return Trigger(groups, trigger.node, trigger.after) if groups or not trigger.groups else None


def _is_momentary(condition: Condition) -> bool:
    """Whether a condition is met at a single instant."""
    return condition.is_once or condition.state.endswith("Transition")


def _stays(condition: Condition) -> bool:
    """Whether a condition is met for good once it is met."""
    return condition.kind == "time" or condition.state == "completeState"


def _lasting(condition: Condition) -> Condition:
    """Return a condition on an event that has come as one on what it leaves behind."""
    if condition.kind != "event" or not condition.kept:
        return condition
    return replace(condition, kind="expression", text=condition.kept)
