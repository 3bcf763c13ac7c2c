"""Refuses modifiers that the runtime cannot carry out together in one action."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from osc2tx import ir
from osc2tx.backends.py_trees.argument_rules import by_name, word
from osc2tx.backends.py_trees.runtime_api import RuntimeSupport, Sort
from osc2tx.diagnostics import DiagnosticSink

LATERAL_SPEED = "lateral speed"


class CombinationCheck:
    """Checks the modifiers of an action against each other.

    Args:
        runtime: Its tables.
        sink: Where complaints go.
        lineages: The types of the scenario's objects, each with its bases.
    """

    def __init__(
        self, runtime: RuntimeSupport, sink: DiagnosticSink, lineages: Mapping[str, tuple[str, ...]]
    ) -> None:
        """See the class."""
        self._runtime = runtime
        self._sink = sink
        self._lineages = lineages

    def check(self, node: ir.Invoke, *, physical: bool) -> None:
        """Check an action that moves as its modifiers say."""
        self._exclusive(node)
        self._conflicting(node)
        self._contradicting(node)
        self._on_lanes(node)
        if physical:
            self._jumping(node)

    def twice(self, node: ir.Invoke) -> None:
        """Report modifiers that stand there twice, both for the start or both for later."""

        def subject(modifier: ir.ModifierCall) -> tuple[str, bool, bool]:
            return modifier.name, self._is_across(modifier), modifier.at == "start"

        for index, modifier in enumerate(node.modifiers):
            if subject(modifier) in map(subject, node.modifiers[:index]):
                self._sink.report(
                    "OSC508", modifier.span, f"modifier `{modifier.name}` stands here twice"
                )

    def _exclusive(self, node: ir.Invoke) -> None:
        for group in self._runtime.exclusive:
            found = [m for m in node.modifiers if m.name in group and m.at != "start"]
            for other in found[1:]:
                if other.name != found[0].name:
                    self._same_thing(found[0], other)

    def _conflicting(self, node: ir.Invoke) -> None:
        """Report what leaves no room for other modifiers, though those go together."""
        lasting = [m for m in node.modifiers if m.at != "start"]
        pairs = [
            (modifier, other)
            for modifier in lasting
            for sort in self._sorts(modifier)
            for other in lasting
            if other is not modifier and not self._is_across(other)
            if other.name in self._runtime.conflicts.get(sort, frozenset())
            if not (sort == modifier.name and _arrives(node, modifier, other))
        ]
        seen: set[frozenset[int]] = set()
        for modifier, other in pairs:
            pair = frozenset((id(modifier), id(other)))
            if pair not in seen:
                self._same_thing(modifier, other)
            seen.add(pair)

    def _sorts(self, modifier: ir.ModifierCall) -> Iterator[str]:
        """Yield the name of a modifier, or what it is instead, and the sorts it is of."""
        found = [sort.name for sort in self._runtime.sorts if _has(sort, modifier)]
        if LATERAL_SPEED not in found:
            yield modifier.name
        yield from found

    def _is_across(self, modifier: ir.ModifierCall) -> bool:
        return LATERAL_SPEED in self._sorts(modifier)

    def _same_thing(self, one: ir.ModifierCall, other: ir.ModifierCall) -> None:
        first, second = sorted((one, other), key=lambda each: each.span.start)
        self._sink.report(
            "OSC508",
            second.span,
            f"`{first.name}` and `{second.name}` speak of the same thing",
            help="give one of them",
        )

    def _contradicting(self, node: ir.Invoke) -> None:
        said = {
            (argument.parameter, word(argument)): argument
            for modifier in node.modifiers
            for argument in modifier.arguments
        }
        for one, other in self._runtime.contradictions:
            if one in said and other in said:
                self._sink.report(
                    "OSC513", said[other].span, f"`{one[1]}` and `{other[1]}` exclude each other"
                )

    def _on_lanes(self, node: ir.Invoke) -> None:
        name = node.actor.name if isinstance(node.actor, ir.FieldRef) else ""
        lineage = self._lineages.get(name)
        if lineage is None or self._runtime.lane_bound.intersection(lineage):
            return
        for modifier in node.modifiers:
            across = self._is_across(modifier)
            what = "a lateral speed" if across else f"`{modifier.name}`"
            if across or (modifier.name in self._runtime.on_lanes and modifier.at != "start"):
                self._sink.report(
                    "OSC508",
                    modifier.span,
                    f"{what} is for vehicles, which follow lanes",
                )

    def _jumping(self, node: ir.Invoke) -> None:
        for modifier in node.modifiers:
            for argument in modifier.arguments:
                if word(argument) == "prefer_non_physical":
                    self._sink.report(
                        "OSC508",
                        modifier.span,
                        f"`{node.action}` reaches its target by moving, not by a jump",
                    )


def _has(sort: Sort, modifier: ir.ModifierCall) -> bool:
    """Whether a modifier is of a sort."""
    given = by_name(modifier.arguments)
    if modifier.name != sort.modifier or any(name in given for name in sort.lacks):
        return False
    values = [word(given[name]) for name in sort.given if name in given]
    return not sort.given or any(not sort.value or value == sort.value for value in values)


def _arrives(node: ir.Invoke, one: ir.ModifierCall, other: ir.ModifierCall) -> bool:
    """Whether a place is for the end: it comes while the speed is held, or both come then.

    Without a duration of its own the action may end with its phase; the runtime sees to that.
    """
    place = other if other.name == "position" else one
    rate = one if place is other else other
    ranges = isinstance(node.duration, ir.RangeValue)
    at_end = place.name == "position" and place.at == "end"
    return at_end and (rate.at == "all" or (rate.name == "speed" and not ranges))
