"""Acts: events that count from the start of their act, and acts that are stopped."""

from __future__ import annotations

from collections.abc import Callable

from osc2tx.importing.conditions import Condition, Trigger
from osc2tx.importing.dimensions import TIME, Quantity, literal
from osc2tx.importing.names import snake
from osc2tx.importing.steps import STARTS, Block, Board, Step
from osc2tx.importing.waiting import minus, start_of
from osc2tx_shared.classes import replace


def without_own_start(step: Step, board: Board) -> tuple[Trigger, Trigger]:
    """Return the triggers of an event without the start of what it is in, which has come."""
    act, event = step.triggers
    own = [[each for each in group if _is_own_start(each, step, board)] for group in event.groups]
    late = [each.delay for group in own for each in group if each.delay is not None]
    if late and not act.is_immediate:
        if event.groups == own and len(own) == 1:
            last = max(late, key=lambda delay: delay.value)
            return Trigger(act.groups, act.node, last), Trigger()
        return act, event
    now = Quantity(literal(0.0, TIME), 0.0)
    groups = [
        [
            Condition("time", each.node, quantity=now, delay=each.delay) if each in mine else each
            for each in group
            if each not in mine or each.delay is not None
        ]
        for group, mine in zip(event.groups, own, strict=True)
    ]
    return act, Trigger(groups, event.node)


def _is_own_start(condition: Condition, step: Step, board: Board) -> bool:
    if condition.kind != "state" or condition.state not in STARTS:
        return False
    steps = board.elements.get(condition.element, ())
    return any(each is step or (isinstance(each, Block) and step in each.inner) for each in steps)


def blocks_of(board: Board, name_event: Callable[[str], str]) -> list[Block]:
    """Put events for acts that are stopped in the place of their own ones; return them."""
    found = []
    for number, stop in board.stops.items():
        inner = [step for step in board.steps if step.act == number]
        if not inner or any(each.kind == "never" for group in stop.groups for each in group):
            continue
        first = inner[0]
        if stop.is_immediate:
            first.node.leave_out("its act is stopped from the start, which is not imported")
            continue
        said = next(
            (
                name
                for (kind, name), steps in board.elements.items()
                if kind == "act" and first in steps
            ),
            "",
        )
        block = Block(
            name_event(snake(said)),
            [effect for step in inner for effect in step.effects],
            (first.triggers[0], Trigger()),
            number,
            0,
            False,
            first.node,
            inner=inner,
        )
        begin = start_of(block)
        block.stop = _since(stop, begin)
        for step in inner:
            step.triggers = (Trigger(), _since(step.triggers[1], begin))
        board.steps = [each for each in board.steps if each not in inner[1:]]
        board.steps[board.steps.index(first)] = block
        for (kind, _), steps in board.elements.items():
            if kind in ("act", "story") and first in steps:
                at = steps.index(first)
                steps[:] = [each for each in steps if each not in inner]
                steps.insert(at, block)
        found.append(block)
    return found


def _since(trigger: Trigger, begin: Quantity | None) -> Trigger:
    """Return a trigger whose times count from the start of an act."""
    groups = [[_later(each, begin) for each in group] for group in trigger.groups]
    return Trigger(groups, trigger.node, trigger.after)


def _later(condition: Condition, begin: Quantity | None) -> Condition:
    if condition.kind != "time" or condition.quantity is None:
        return condition
    if begin is None:
        condition.node.approximate("the time counts from the start of its act")
        return condition
    return (
        condition
        if begin.value == 0.0
        else replace(condition, quantity=minus(condition.quantity, begin))
    )
