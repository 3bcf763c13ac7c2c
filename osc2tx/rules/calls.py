"""Refuses actions and modifiers that no world can carry out as they are called."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

from osc2tx import ir
from osc2tx.catalogue import ActionEntry, ModifierEntry, catalogue
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.rules.combinations import CombinationCheck
from osc2tx.rules.given import Given, GivenArguments, by_name, domains_of, word
from osc2tx_shared.rules import Rule, violations

# Limits of quantities in worlds, in SI units: the speed of light, lengths of roads.
LARGEST = {"speed": 299_792_458.0, "acceleration": 1e9, "length": 1e9}

# Standard forms of modifiers of forks of ScenarioRunner, which the runtime does not support.
INSTEAD = {
    "follow_trajectory": "use the action of that name: `….follow_trajectory(absolute: …)`",
    "road_action": "use `speed(…)`, `lane(…)` and, at a junction, a route for `along(…)`",
    "set_color": "set the field `color` instead: `keep(it.color == …)`",
}


class CallCheck:
    """Checks invocations and placements.

    Args:
        declarations: Of the scenario.
        sink: Receives reports.
    """

    def __init__(self, declarations: Sequence[ir.Declaration], sink: DiagnosticSink) -> None:
        declared = (d for d in declarations if isinstance(d, ir.Actor | ir.Struct))
        self._lineages = {each.name: each.lineage for each in declared}
        self._values = {d.name: d.value for d in declarations if isinstance(d, ir.Parameter)}
        self._domains = domains_of(declarations)
        self._library = catalogue()
        self._combinations = CombinationCheck(sink, self._lineages)
        self._sink = sink

    def placing(self, modifier: ir.ModifierCall) -> None:
        """Check a modifier that places an actor."""
        entry = self._library.modifiers.get(modifier.name)
        if entry is None or not entry.placement:
            self._sink.report(
                "OSC508", modifier.span, f"modifier `{modifier.name}` cannot place an actor"
            )
            return
        self._modifier_arguments(modifier, entry)

    def invocation(self, node: ir.Invoke, *, ends_unknown: bool) -> None:
        """Check an action with its modifiers.

        Args:
            node: The action.
            ends_unknown: Whether nothing states in advance when it ends.
        """
        key = node.qualified_name
        entry = self._library.actions.get(key)
        if entry is None and node.is_own:
            self._modifiers(node, key, frozenset(self._library.modifiers))
            return
        if entry is None:  # the tables are complete: only abstract actions have no entry
            self._sink.report(
                "OSC507",
                node.span,
                f"`{key}` is abstract: only actions that derive from it have a behavior",
                help="use one of these, such as `drive`",
            )
            return
        self._arguments(node.arguments, entry.arguments, f"action `{key}`")
        self._required(node, key, entry.required)
        others = {"with": None} if node.modifiers else {}
        self._rules(f"`{node.action}`", entry.rules, node.span, node.arguments, others)
        if entry.moves:
            self._combinations.check(node, ends_unknown=ends_unknown, physical=entry.physical)
        self._modifiers(node, key, entry.modifiers)
        self._narrowed(node, key, entry)

    def _modifiers(self, node: ir.Invoke, key: str, accepted: frozenset[str]) -> None:
        for modifier in node.modifiers:
            self._modifier(modifier, key, accepted)
        self._combinations.twice(node)

    def _narrowed(self, node: ir.Invoke, key: str, entry: ActionEntry) -> None:
        """Report modifiers that an action honours, but not with the arguments that it has."""
        words = {argument.parameter: word(argument) for argument in node.arguments}
        for parameter, values in entry.modifiers_with.items():
            value = words.get(parameter, "")
            honoured = entry.modifiers if value is None else values.get(value, entry.modifiers)
            said = f" with `{parameter}: {value}`" if value else ""
            for modifier in node.modifiers:
                if modifier.name in entry.modifiers - honoured:
                    self._sink.report(
                        "OSC508",
                        modifier.span,
                        f"action `{key}`{said} does not support modifier `{modifier.name}`",
                        help="it controls the same direction of motion itself",
                    )

    def _modifier(self, modifier: ir.ModifierCall, action: str, accepted: frozenset[str]) -> None:
        entry = self._library.modifiers.get(modifier.name)
        starts = modifier.at == "start" and entry is not None and entry.placement
        if entry is None or (modifier.name not in accepted and not starts):
            self._sink.report(
                "OSC508",
                modifier.span,
                f"action `{action}` does not support modifier `{modifier.name}` yet",
                help=INSTEAD.get(modifier.name),
            )
            return
        if modifier.at == "end" and "at" not in entry.parameters:
            self._sink.report(
                "OSC509",
                modifier.span,
                f"modifier `{modifier.name}` does not support `at: end` yet",
            )
        self._modifier_arguments(modifier, entry)
        self._shape(modifier, entry)

    def _modifier_arguments(self, modifier: ir.ModifierCall, entry: ModifierEntry) -> None:
        name, arguments = modifier.name, modifier.arguments
        self._arguments(arguments, entry.parameters, f"modifier `{name}`")
        for missing in sorted(entry.required - {argument.parameter for argument in arguments}):
            self._sink.report("OSC509", modifier.span, f"modifier `{name}` needs `{missing}`")
        self._rules(f"`{name}`", entry.rules, modifier.span, arguments)

    def _shape(self, modifier: ir.ModifierCall, entry: ModifierEntry) -> None:
        """Report a shape of something else than the modifier is about."""
        for argument in modifier.arguments:
            if argument.parameter != "shape" or entry.shape is None:
                continue
            wanted, value = entry.shape, argument.value
            if wanted != "any_shape" and wanted not in self._kinds(value):
                self._sink.report(
                    "OSC513",
                    argument.span,
                    f"a shape of `{modifier.name}` is an `{wanted}`, not a `{value.type.name}`",
                )
            elif wanted == "any_shape" and not isinstance(value, ir.UserShape):
                self._sink.report(
                    "OSC513",
                    argument.span,
                    f"a shape of `{modifier.name}` computes an angle, unlike a `{value.type.name}`",
                    help="derive one from `any_shape` with `def compute(time: time) -> angle`",
                )

    def _kinds(self, shape: ir.Expression) -> tuple[str, ...]:
        """Return the types of a shape, as those of the bases that the library has."""
        if isinstance(shape, ir.UserShape):
            return (shape.kind,)
        name = shape.name if isinstance(shape, ir.FieldRef) else ""
        lineage = self._lineages.get(name, (shape.type.name,))
        return tuple(type_.replace("common_", "any_") for type_ in lineage)

    # --- arguments ---

    def _arguments(
        self, arguments: tuple[ir.Argument, ...], known: frozenset[str], what: str
    ) -> None:
        for argument in arguments:
            if argument.parameter not in known:
                self._sink.report(
                    "OSC509",
                    argument.span,
                    f"argument `{argument.parameter}` of {what} is not supported yet",
                )
            self._size(argument.value)

    def _size(self, value: ir.Expression) -> None:
        """Report a number that no world can follow."""
        largest = LARGEST.get(value.type.name)
        known = self._values.get(value.name) if isinstance(value, ir.FieldRef) else value
        number = None if known is None else ir.constant(known)
        if largest is not None and number is not None and not abs(number) <= largest:
            self._sink.report(
                "OSC516",
                value.span,
                f"no world has such {_with_article(value.type.name)}",
                notes=[f"it is {number:g}, and the largest {largest:g}, in SI units"],
            )

    def _required(self, node: ir.Invoke, action: str, needed: frozenset[str]) -> None:
        given = {argument.parameter for argument in node.arguments}
        missing = sorted(needed - given)
        if missing:
            names = ", ".join(f"`{name}`" for name in missing)
            self._sink.report(
                "OSC509",
                node.span,
                f"action `{action}` requires {names}",
                help=f"write `{missing[0]}: …` among its arguments",
            )

    def _rules(
        self,
        subject: str,
        rules: Sequence[Rule],
        span: Span,
        arguments: tuple[ir.Argument, ...],
        others: Given = MappingProxyType({}),
    ) -> None:
        given = GivenArguments({**by_name(arguments), **others}, self._domains)
        for broken in violations(subject, rules, given):
            self._sink.report("OSC513", given.span(broken.parameter, span), broken.text)


def _with_article(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"
