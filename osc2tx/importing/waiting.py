"""Triggers as what is waited for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from osc2tx.importing.conditions import Condition, Trigger
from osc2tx.importing.dimensions import TIME, Quantity, literal, total
from osc2tx.importing.expressions import joined_by
from osc2tx.importing.program import EVENT, Declared
from osc2tx.importing.statements import Statement, When, composed, elapsed, happens, wait
from osc2tx.importing.steps import ENDS, STARTS, Block, Board, Step
from osc2tx_shared.classes import replace

ON_A_LINE = 60
"""Characters of a condition that is in brackets if it is longer, between which lines break."""


class Waiting:
    """Turns triggers into waits.

    Attributes:
        declared: What the order needs: events, overrides.
        references: How often the scenario refers to statements, by their labels.
    """

    def __init__(self, board: Board, name_event: Callable[[str], str]) -> None:
        """Take the storyboard.

        Args:
            board: The storyboard.
            name_event: Gives a name for an event of the scenario.
        """
        self._board, self._name_event = board, name_event
        self.declared: list[Declared] = []
        self._predecessor: dict[Step, Step] = {}
        self.references: Counter[str] = Counter()
        self._named: dict[str, str] = {}

    def _steps_of(self, condition: Condition) -> list[Step]:
        """Return the last steps of what a condition is about."""
        found = self._board.elements.get(condition.element, [])
        if condition.state == "endTransition":  # of the first execution
            found = [each for each in found if not any(a in found for a in each.before)]
        return self._last_of(found)

    def _last_of(self, steps: Sequence[Step]) -> list[Step]:
        """Return those of some steps behind which none of them comes."""
        return [each for each in steps if not any(self._predecessor.get(a) is each for a in steps)]

    def _behind(self, trigger: Trigger, step: Step) -> Trigger:
        """Return a trigger that waits for the execution before a step as well."""
        element = "execution", step.label
        self._board.elements[element] = list(step.before)
        done = Condition("state", step.node, element=element, state="completeState")
        groups = [[done, *group] for group in trigger.groups] or [[done]]
        return Trigger(groups, trigger.node, trigger.after)

    def waits(self, trigger: Trigger, behind: Step | None = None) -> list[Statement]:
        """Return what waits for a trigger; `behind`: it comes after this step."""
        later = [] if trigger.after is None else [wait(elapsed(trigger.after.text))]
        if trigger.is_immediate:
            return later
        groups = [self._of_group(group, behind) for group in trigger.groups]
        if len(groups) == 1:
            return [*groups[0], *later]
        if any(not group for group in groups):
            return later
        return [composed("one_of", [composed("serial", group) for group in groups]), *later]

    def _of_group(self, group: Sequence[Condition], behind: Step | None) -> list[Statement]:
        found: list[Statement] = []
        if any(each.kind == "time" for each in group) and behind is None:
            # an event may come before the time, and is only looked at then
            group = [_if_kept(each) for each in group]
        times = [each for each in group if each.kind == "time"]
        happenings = [each for each in group if each.kind in ("state", "event")]
        expressions = [each for each in group if each.kind == "expression"]
        levels = [each for each in expressions if each.edge == "none"]
        edges = [each for each in expressions if each.edge != "none"]
        late = max((lateness(each) for each in expressions), default=0.0)
        if late > 0.0 and (len(group) > len(expressions) or len(expressions) > 1):
            self._report_delays(happenings, expressions, late)
        if times and behind is not None:
            times[0].node.approximate(
                "the time counts from the start of the scenario; it is taken to have come"
            )
        elif times:
            latest = max(times, key=_nominal)
            # what counts later is looked at so much earlier
            time = _time_of(latest).text
            left = time if late == 0.0 else _earlier(time, latest, late)
            found += [] if left is None else [wait(elapsed(left))]
        found += self._happened(happenings, behind, late)
        if len(edges) == 1 and not levels:
            found.append(wait(When(_edge(edges[0]))))
        elif len(edges) == 1:
            name = self._event(_edge(edges[0]), edges[0])
            conjunction = joined_by("and", [each.text for each in levels])
            is_long = len(conjunction) > ON_A_LINE
            found.append(wait(happens(name, f"({conjunction})" if is_long else conjunction)))
        elif edges:
            edges[0].node.approximate(
                "edges of several conditions are the edge of their conjunction"
            )
            conjunction = joined_by("and", [each.text for each in (*edges, *levels)])
            found.append(wait(When(f"rise({conjunction})")))
        elif levels:
            conjunction = joined_by("and", [each.text for each in levels])
            is_long = len(levels) > 1 and len(conjunction) > ON_A_LINE
            found.append(wait(When(f"({conjunction})" if is_long else conjunction)))
        if late > 0.0:
            only = expressions[0]
            is_alone = len(expressions) == 1 and only.lasting == 0.0 and only.delay is not None
            text = only.delay.text if is_alone and only.delay else literal(late, TIME)
            found.append(wait(elapsed(text)))
        return found

    @staticmethod
    def _report_delays(
        happenings: Sequence[Condition], expressions: Sequence[Condition], late: float
    ) -> None:
        """Say where delays of conditions that count together cannot be told apart."""
        early = [each for each in happenings if lateness(each) < late]
        others = [each for each in expressions if lateness(each) != late]
        if early or others:
            (early or others)[0].node.approximate("delays of several conditions follow each other")

    def _happened(
        self, happenings: Sequence[Condition], behind: Step | None, late: float
    ) -> list[Statement]:
        """Return what waits for events and their delays, up to some time (s) before the last."""
        waits = []
        for each in happenings:
            marks = [wait(happens(mark)) for mark in self._ends(each, behind)]
            waited = [composed("parallel", marks)] if marks else []
            if each.delay is not None:
                text = each.delay.text if late == 0.0 else _earlier(each.delay.text, each, late)
                waited += [] if text is None else [wait(elapsed(text))]
            if waited:
                waits.append(composed("serial", waited))
        if not waits:
            return []
        whole = composed("parallel", waits)
        return list(whole.members) if whole.does == "serial" else [whole]

    def _ends(self, condition: Condition, behind: Step | None) -> Iterator[str]:
        """Yield the events of the language that a condition waits for."""
        if condition.kind == "event":
            yield condition.text
            return
        steps = self._steps_of(condition)
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
            if not step.effects and not isinstance(step, Block):
                yield step.label
            else:
                self.references[step.label] += 1
                yield f"{step.label}.{'start' if condition.state in STARTS else 'end'}"

    def _event(self, text: str, condition: Condition) -> str:
        if text not in self._named:
            name = self._name_event("condition")
            self.declared.append(Declared(name, EVENT, value=text))
            self._named[text] = name
        return self._named[text]


def start_of(step: Step) -> Quantity | None:
    """Return the time at which a step starts, if its triggers say nothing else."""
    found = Quantity("0s", 0.0)
    for trigger in step.triggers:
        if trigger.is_immediate and trigger.after is None:
            continue
        if len(trigger.groups) != 1 or len(trigger.groups[0]) != 1:
            return None
        condition = trigger.groups[0][0]
        if condition.kind != "time" or condition.quantity is None:
            return None
        time = _time_of(condition)
        time = time if trigger.after is None else total(TIME, (1, time), (1, trigger.after))
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


def _time_of(condition: Condition) -> Quantity:
    assert condition.quantity is not None
    if condition.delay is None:
        return condition.quantity
    return total(TIME, (1, condition.quantity), (1, condition.delay))


def minus(later: Quantity, earlier: Quantity) -> Quantity:
    """Return the time between two times."""
    return total(TIME, (1, later), (-1, earlier))


def _edge(condition: Condition) -> str:
    if condition.edge == "falling":
        return f"fall({condition.text})"
    if condition.edge == "risingOrFalling":
        condition.node.approximate("of both edges the rising one counts")
    return f"rise({condition.text})"


def lateness(condition: Condition) -> float:
    """Return how many seconds later than it is met a condition counts."""
    delay = 0.0 if condition.delay is None else condition.delay.value
    return delay + condition.lasting


def _earlier(text: str, condition: Condition, by: float) -> str | None:
    """Return a time that is some seconds earlier; `None`: nothing is left of it."""
    parts = [each for each in (condition.quantity, condition.delay) if each is not None]
    if any(each.is_open for each in parts):
        return f"{text} - {literal(by, TIME)}"
    left = round(sum(each.value for each in parts) - by, 9)
    return literal(left, TIME) if left > 0.0 else None


def _if_kept(condition: Condition) -> Condition:
    """Return the condition that an event has come, where that is kept."""
    if not condition.kept or condition.delay is not None:
        return condition
    return replace(condition, kind="expression", text=condition.kept)
