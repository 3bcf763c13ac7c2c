"""Refuses modifiers that do not go together in one action."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from osc2tx import ir
from osc2tx.catalogue import catalogue, object_tables
from osc2tx.diagnostics import DiagnosticSink, Label
from osc2tx.rules.given import GivenArguments, by_name, word
from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import Clash, Timing, clashes, is_across


@dataclass(frozen=True, slots=True, eq=False)
class _Call:
    """A modifier, as the rules see it."""

    node: ir.ModifierCall

    @property
    def name(self) -> str:
        return self.node.name

    @property
    def at(self) -> str:
        return self.node.at

    @property
    def given(self) -> GivenArguments:
        return GivenArguments({**by_name(self.node.arguments), "at": self.at})

    @property
    def shaped(self) -> bool:
        return any(name in self.given for name in ("rate_profile", "rate_peak"))


class CombinationCheck:
    """Checks the modifiers of an action against each other.

    Args:
        sink: Receives reports.
        lineages: The types of the scenario's objects, each with its bases.
    """

    def __init__(self, sink: DiagnosticSink, lineages: Mapping[str, tuple[str, ...]]) -> None:
        self._rules = {name: entry.combining for name, entry in catalogue().modifiers.items()}
        self._lane_bound = object_tables().lane_bound
        self._sink = sink
        self._lineages = lineages

    def check(self, node: ir.Invoke, *, ends_unknown: bool, physical: bool) -> None:
        """Check an action whose modifiers define its motion."""
        timing = Timing(has_duration=False, end_is_known=False) if ends_unknown else _timing(node)
        for clash in self._clashes(node, timing):
            if clash.kind != "twice":
                self._report(clash, self._duration_helps(node, clash))
        self._on_lanes(node)
        if physical:
            self._jumping(node)

    def twice(self, node: ir.Invoke) -> None:
        """Report modifiers that are applied twice, both to the start or both to the phase."""
        for clash in self._clashes(node, _timing(node)):
            if clash.kind == "twice":
                self._report(clash)

    def _clashes(self, node: ir.Invoke, timing: Timing) -> Iterator[Clash[_Call]]:
        calls = [_Call(modifier) for modifier in node.modifiers]
        yield from clashes(calls, self._rules, timing)

    def _duration_helps(self, node: ir.Invoke, clash: Clash[_Call]) -> bool:
        """Whether two modifiers of an action without a duration go together with one."""
        if node.duration is not None:
            return False
        timed = Timing(has_duration=True, end_is_known=True)
        others = self._clashes(node, timed)
        pairs = [{call.node for call in other.calls} for other in others]
        return {call.node for call in clash.calls} not in pairs

    def _report(self, clash: Clash[_Call], duration_helps: bool = False) -> None:
        *_, last = (call.node for call in clash.calls)
        match clash.kind:
            case "same thing":
                first, last = sorted((c.node for c in clash.calls), key=lambda m: m.span.start)
                self._sink.report(
                    "OSC508",
                    last.span,
                    f"`{first.name}` and `{last.name}` constrain the same motion",
                    labels=[Label(first.span, "the other modifier")],
                    help="give one of them"
                    + (", or state the duration of the action" if duration_helps else ""),
                )
            case "twice":
                text = f"modifier `{last.name}` is applied twice here"
                labels = [Label(clash.calls[0].node.span, "given here already")]
                self._sink.report("OSC508", last.span, text, labels=labels)
            case "no start":
                text = f"modifier `{last.name}` does not apply to a start"
                self._sink.report("OSC509", last.span, text, help="omit `at: start`")
            case "contradiction" | "rule":
                span = clash.calls[-1].given.span(clash.parameter, last.span)
                self._sink.report("OSC513", span, clash.text)

    def _on_lanes(self, node: ir.Invoke) -> None:
        name = node.actor.name if isinstance(node.actor, ir.FieldRef) else ""
        lineage = self._lineages.get(name)
        if lineage is None or self._lane_bound.intersection(lineage):
            return
        for modifier in node.modifiers:
            across = is_across(_Call(modifier), self._rules)
            what = "a lateral speed" if across else f"`{modifier.name}`"
            rules = self._rules.get(modifier.name)
            lanes_only = rules is not None and rules.lanes_only and modifier.at != "start"
            if across or lanes_only:
                text = f"{what} is for vehicles, which follow lanes"
                self._sink.report("OSC508", modifier.span, text)

    def _jumping(self, node: ir.Invoke) -> None:
        for modifier in node.modifiers:
            if any(word(argument) == "prefer_non_physical" for argument in modifier.arguments):
                text = f"`{node.action}` reaches its target by moving, not by a jump"
                self._sink.report("OSC508", modifier.span, text)


def _timing(node: ir.Invoke) -> Timing:
    """Return facts about the length; without a duration the phase around may state it."""
    if node.duration is None:
        return Timing(has_duration=False, end_is_known=None)
    if not isinstance(node.duration, ir.RangeValue):
        return Timing(has_duration=True, end_is_known=True, seconds=ir.constant(node.duration))
    # An end is drawn from a range, unless something else ends the action.
    endless = ir.constant(node.duration.upper) == math.inf
    return Timing(has_duration=True, end_is_known=not (node.until or endless))
