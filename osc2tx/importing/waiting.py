"""Triggers as what is waited for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from osc2tx.importing.conditions import Condition, Trigger
from osc2tx.importing.dimensions import PRODUCT, TIME, Quantity, literal
from osc2tx.importing.names import snake
from osc2tx.importing.program import Statement, composed, wait
from osc2tx.importing.steps import ENDS, Board, Step

STARTS = ("startTransition", "runningState")


class Waiting:
    """Turns triggers into waits.

    Attributes:
        lines: Declarations that the order needs: events, overrides.
        predecessor: Steps by those behind them.
        stopped: Names of the compositions of acts that are stopped, by the numbers of the acts.
    """

    def __init__(self, board: Board, name_event: Callable[[str], str]) -> None:
        """Take the storyboard.

        Args:
            board: The storyboard.
            name_event: Gives a name for an event of the scenario.
        """
        self._board, self._name_event = board, name_event
        self.lines: list[str] = []
        self.predecessor: dict[Step, Step] = {}
        self.stopped: dict[int, str] = {}
        self._declared: dict[str, str] = {}

    def steps_of(self, condition: Condition) -> list[Step]:
        """Return the last steps of what a condition is about."""
        found = self._board.elements.get(condition.element, [])
        return [
            step for step in found if not any(self.predecessor.get(each) is step for each in found)
        ]

    def waits(self, trigger: Trigger, behind: Step | None = None) -> list[Statement]:
        """Return what waits for a trigger; `behind`: it comes after this step."""
        if trigger.is_immediate:
            return []
        groups = [self._of_group(group, behind) for group in trigger.groups]
        if len(groups) == 1:
            return groups[0]
        if any(not group for group in groups):
            return []
        return [composed("one_of", [composed("serial", group) for group in groups])]

    def _of_group(self, group: Sequence[Condition], behind: Step | None) -> list[Statement]:
        found: list[Statement] = []
        late = 0.0
        times = [each for each in group if each.kind == "time"]
        states = [each for each in group if each.kind == "state"]
        events = [each for each in group if each.kind == "event"]
        levels = [each for each in group if each.kind == "expression" and each.edge == "none"]
        edges = [each for each in group if each.kind == "expression" and each.edge != "none"]
        if times and behind is not None:
            times[0].node.approximate(
                "the time counts from the start of the scenario; it is taken to have come"
            )
        elif times:
            latest = max(times, key=_nominal)
            found.append(wait(f"elapsed({_time_of(latest)})"))
        marks = [text for each in (*states, *events) for text in self._ends(each, behind)]
        if len(marks) == 1:
            found.append(wait(marks[0]))
        elif marks:
            found.append(composed("parallel", [wait(mark) for mark in marks]))
        for each in (*states, *events):
            found += _delayed(each)
        if len(edges) == 1 and not levels:
            found.append(wait(_edge(edges[0])))
        elif len(edges) == 1:
            name = self._event(_edge(edges[0]), edges[0])
            conjunction = " and ".join(_operand(each.text) for each in levels)
            found.append(wait(f"@{name} if {conjunction}"))
        elif edges:
            edges[0].node.approximate(
                "edges of several conditions are the edge of their conjunction"
            )
            conjunction = " and ".join(_operand(each.text) for each in (*edges, *levels))
            found.append(wait(f"rise({conjunction})"))
        elif levels:
            found.append(
                wait(
                    " and ".join(
                        _operand(each.text) if len(levels) > 1 else each.text for each in levels
                    )
                )
            )
        for each in (*levels, *edges):
            late = max(late, each.delay.value if each.delay is not None else 0.0, each.lasting)
        delayed = [
            each for each in (*levels, *edges) if each.delay is not None or each.lasting > 0.0
        ]
        if late > 0.0:
            if len(group) > 1:
                group[0].node.approximate("delays of several conditions follow each other")
            only = delayed[0].delay
            text = only.text if len(delayed) == 1 and only is not None else literal(late, TIME)
            found.append(wait(f"elapsed({text})"))
        return found

    def _ends(self, condition: Condition, behind: Step | None) -> Iterator[str]:
        """Yield the events of the language that a condition waits for."""
        if condition.kind == "event":
            yield f"@{condition.text}"
            return
        steps = self.steps_of(condition)
        label = self.stopped_act(condition)
        if label is not None:
            yield f"@{label}.end"
            return
        if not steps:
            kind, name = condition.element
            condition.node.approximate(
                f"the {kind} {name} does nothing here, so it is not waited for"
            )
        if condition.state in STARTS:
            steps = self._board.elements.get(condition.element, [])[:1]
        elif condition.state not in ENDS:
            condition.node.approximate(f"{condition.state} is taken to be met always")
            return
        for step in steps:
            if step is behind:
                continue
            if not step.effects:
                yield f"@{step.label}"
            else:
                yield f"@{step.label}.{'start' if condition.state in STARTS else 'end'}"

    def stopped_act(self, condition: Condition) -> str | None:
        """Return the name of the act whose end is waited for, if that act is stopped."""
        kind, name = condition.element
        if kind != "act" or condition.state not in ENDS:
            return None
        acts = {step.act for step in self._board.elements.get(condition.element, ())}
        number = next(iter(acts)) if len(acts) == 1 else 0
        if number not in self._board.stops:
            return None
        if number not in self.stopped:
            self.stopped[number] = self._name_event(snake(name))
        return self.stopped[number]

    def _event(self, text: str, condition: Condition) -> str:
        if text not in self._declared:
            name = self._name_event("condition")
            self.lines.append(f"event {name} is {text}")
            self._declared[text] = name
        return self._declared[text]


def start_of(step: Step) -> Quantity | None:
    """Return the time at which a step starts, if its triggers say nothing else."""
    found = Quantity("0s", 0.0)
    for trigger in step.triggers:
        if trigger.is_immediate:
            continue
        if len(trigger.groups) != 1 or len(trigger.groups[0]) != 1:
            return None
        condition = trigger.groups[0][0]
        if condition.kind != "time" or condition.quantity is None:
            return None
        time = Quantity(_time_of(condition), _nominal(condition), condition.quantity.is_open, 1)
        found = max(found, time, key=lambda each: each.value)
    return found


def nominal_start(step: Step) -> Quantity:
    """Return the time at which a step starts, which only a time starts."""
    found = start_of(step)
    assert found is not None
    return found


def _nominal(condition: Condition) -> float:
    assert condition.quantity is not None
    return condition.quantity.value + (
        condition.delay.value if condition.delay is not None else 0.0
    )


def _time_of(condition: Condition) -> str:
    assert condition.quantity is not None
    if condition.delay is None:
        return condition.quantity.text
    if not condition.quantity.is_open and not condition.delay.is_open:
        return literal(_nominal(condition), TIME)
    return f"{condition.quantity.text} + {condition.delay.text}"


def minus(later: Quantity, earlier: Quantity) -> Quantity:
    """Return the time between two times."""
    value = later.value - earlier.value
    if later.is_open or earlier.is_open:
        return Quantity(f"{later.text} - {earlier.within(PRODUCT)}", value, True, 1)
    return Quantity(literal(round(value, 9), TIME), value)


def _edge(condition: Condition) -> str:
    if condition.edge == "falling":
        return f"fall({condition.text})"
    if condition.edge == "risingOrFalling":
        condition.node.approximate("of both edges the rising one counts")
    return f"rise({condition.text})"


def _operand(text: str) -> str:
    return f"({text})" if " or " in text or " and " in text else text


def _delayed(condition: Condition) -> list[Statement]:
    return [] if condition.delay is None else [wait(f"elapsed({condition.delay.text})")]
