"""Refuses actions and modifiers that the runtime library cannot carry out as they are called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from osc2tx import ir
from osc2tx.backends.py_trees.argument_rules import Given, by_name, violations
from osc2tx.backends.py_trees.combinations import CombinationCheck
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.runtime_api import RuntimeSupport
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.diagnostics.suggestions import nearest

# Names that constructors of actions take for themselves.
ACTION_KEYWORDS = frozenset({"actor", "label", "modifiers", "self"})


class CallCheck:
    """Checks invocations and placements against what the runtime knows.

    Args:
        runtime: Its tables.
        sink: Where complaints go.
        expressions: Checks expressions.
        lineages: The types of the scenario's objects, each with its bases.
    """

    def __init__(
        self,
        runtime: RuntimeSupport,
        sink: DiagnosticSink,
        expressions: Callable[[Iterable[ir.Expression]], None],
        lineages: Mapping[str, tuple[str, ...]],
    ) -> None:
        """See the class."""
        self._lineages = lineages
        self._combinations = CombinationCheck(runtime, sink, lineages)
        self._runtime = runtime
        self._sink = sink
        self._expressions = expressions

    def placing(self, modifier: ir.ModifierCall) -> None:
        """Check a modifier that places an actor."""
        if modifier.name not in self._runtime.placement:
            self._sink.report(
                "OSC508", modifier.span, f"modifier `{modifier.name}` cannot place an actor"
            )
            return
        known = self._runtime.placement[modifier.name]
        self._arguments(modifier.arguments, known, f"modifier `{modifier.name}`")
        self._asked(modifier)
        self._rules(modifier.name, modifier.span, modifier.arguments)

    def invocation(self, node: ir.Invoke) -> None:
        """Check an action with its modifiers."""
        key = f"{node.owner}.{node.action}"
        support = self._runtime.actions.get(key)
        if support is None and node.is_own:
            self._user_action(node, key)
            return
        if support is None:
            near = nearest(key, self._runtime.actions)
            help_ = f"the runtime has `{near}`" if near else None
            self._sink.report(
                "OSC507", node.span, f"the runtime has no action `{key}` yet", help=help_
            )
            return
        self._expressions((node.actor,))
        self._arguments(node.arguments, support.arguments, f"action `{key}`")
        self._required(node, key, support.required)
        self._rules(key, node.span, node.arguments, {"with": None} if node.modifiers else {})
        if support.moves:
            self._combinations.check(node, physical=support.physical)
            for modifier in node.modifiers:
                self._moving(modifier)
        self._modifiers(node, key, support.modifiers)

    def _user_action(self, node: ir.Invoke, key: str) -> None:
        """Check an action that a package of the user carries out: it takes what it declares."""
        for argument in node.arguments:
            if argument.parameter in ACTION_KEYWORDS:
                self._sink.report(
                    "OSC509",
                    argument.span,
                    f"`{argument.parameter}` is a word of the runtime's own here; rename it",
                )
        self._expressions((node.actor, *(argument.value for argument in node.arguments)))
        self._modifiers(node, key, frozenset(self._runtime.modifiers))

    def _modifiers(self, node: ir.Invoke, key: str, accepted: frozenset[str]) -> None:
        for modifier in node.modifiers:
            self._modifier(modifier, key, accepted)
        self._combinations.twice(node)

    def _modifier(self, modifier: ir.ModifierCall, action: str, accepted: frozenset[str]) -> None:
        starts = modifier.at == "start" and modifier.name in self._runtime.placement
        if modifier.name not in accepted and not starts:
            self._sink.report(
                "OSC508",
                modifier.span,
                f"action `{action}` cannot honour modifier `{modifier.name}` yet",
            )
            return
        known = self._runtime.modifiers[modifier.name]
        if modifier.at == "end" and "at" not in known:
            self._sink.report(
                "OSC509",
                modifier.span,
                f"modifier `{modifier.name}` cannot be asked for `at: end` yet",
            )
        self._arguments(modifier.arguments, known, f"modifier `{modifier.name}`")
        self._asked(modifier)
        self._rules(modifier.name, modifier.span, modifier.arguments)
        self._shape(modifier)

    def _asked(self, modifier: ir.ModifierCall) -> None:
        given = {identifier(argument.parameter) for argument in modifier.arguments}
        for name in sorted(self._runtime.asked.get(modifier.name, frozenset()) - given):
            self._sink.report("OSC509", modifier.span, f"modifier `{modifier.name}` needs `{name}`")

    def _moving(self, modifier: ir.ModifierCall) -> None:
        if modifier.at == "start" and modifier.name in self._runtime.no_start:
            self._sink.report(
                "OSC509",
                modifier.span,
                f"modifier `{modifier.name}` says nothing about a start",
                help="leave `at: start` out",
            )
        what = "a start" if modifier.at == "start" else f"{modifier.name} while moving"
        self._rules(what, modifier.span, modifier.arguments, {"at": modifier.at})

    def _shape(self, modifier: ir.ModifierCall) -> None:
        """Report a shape of something else than the modifier is about."""
        for argument in modifier.arguments:
            if argument.parameter != "shape" or modifier.name not in self._runtime.shapes:
                continue
            wanted, value = self._runtime.shapes[modifier.name], argument.value
            if wanted not in (*self._kinds(value), "any_shape"):
                self._sink.report(
                    "OSC513",
                    argument.span,
                    f"a shape of `{modifier.name}` is an `{wanted}`, not a `{value.type.name}`",
                )
            elif wanted == "any_shape" and not isinstance(value, ir.OwnShape):
                self._sink.report(
                    "OSC513",
                    argument.span,
                    f"a shape of `{modifier.name}` computes an angle, unlike a `{value.type.name}`",
                    help="derive one from `any_shape` with `def compute(time: time) -> angle`",
                )

    def _kinds(self, shape: ir.Expression) -> tuple[str, ...]:
        """Return the types of a shape, as those of the bases that the library has."""
        if isinstance(shape, ir.OwnShape):
            return (shape.kind,)
        name = shape.name if isinstance(shape, ir.FieldRef) else ""
        lineage = self._lineages.get(name, (shape.type.name,))
        return tuple(type_.replace("common_", "any_") for type_ in lineage)

    # --- arguments ---

    def _arguments(
        self, arguments: tuple[ir.Argument, ...], known: frozenset[str], what: str
    ) -> None:
        for argument in arguments:
            if identifier(argument.parameter) not in known:
                self._sink.report(
                    "OSC509",
                    argument.span,
                    f"argument `{argument.parameter}` of {what} is not supported yet",
                )
            self._expressions((argument.value,))

    def _required(self, node: ir.Invoke, action: str, needed: frozenset[str]) -> None:
        given = {identifier(argument.parameter) for argument in node.arguments}
        missing = sorted(needed - given)
        if missing:
            names = ", ".join(f"`{name}`" for name in missing)
            self._sink.report(
                "OSC509", node.span, f"action `{action}` cannot do without {names} yet"
            )

    def _rules(
        self,
        what: str,
        span: Span,
        arguments: tuple[ir.Argument, ...],
        others: Given | None = None,
    ) -> None:
        given = {**by_name(arguments), **(others or {})}
        short = what.partition(" ")[0].rpartition(".")[2]
        for where, text in violations(short, self._runtime.rules.get(what, ()), span, given):
            self._sink.report("OSC513", where, text)
