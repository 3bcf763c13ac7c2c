"""Refuses actions and modifiers that the runtime library cannot carry out as they are called."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from osc2tx import ir
from osc2tx.backends.py_trees.argument_rules import Given, by_name, violations
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.runtime_api import RuntimeSupport
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.diagnostics.nearest import nearest

# Names that constructors of actions take for themselves.
ACTION_KEYWORDS = frozenset({"actor", "label", "self"})


class CallCheck:
    """Checks invocations and placements against what the runtime knows.

    Args:
        runtime: Its tables.
        sink: Where complaints go.
        expressions: Checks expressions.
    """

    def __init__(
        self,
        runtime: RuntimeSupport,
        sink: DiagnosticSink,
        expressions: Callable[[Iterable[ir.Expression]], None],
    ) -> None:
        """See the class."""
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
        self._rules(modifier.name, modifier.span, modifier.arguments)

    def invocation(self, node: ir.Invoke) -> None:
        """Check an action with its modifiers."""
        key = f"{node.owner}.{node.action}"
        support = self._runtime.actions.get(key)
        if support is None and node.is_own:
            self._own_action(node, key)
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
            self._exclusive(node)
            self._conflicting(node)
            for modifier in node.modifiers:
                self._moving(modifier)
        self._modifiers(node, key, support.modifiers)

    def _own_action(self, node: ir.Invoke, key: str) -> None:
        """Check an action that a package of the user carries out: it takes what it declares."""
        name = identifier(node.action)
        if name in self._runtime.reserved:
            self._sink.report(
                "OSC507",
                node.span,
                f"the runtime has something else by the name `{name}`, so it cannot find `{key}`",
                help="rename the action",
            )
        for argument in node.arguments:
            if argument.parameter in ACTION_KEYWORDS:
                self._sink.report(
                    "OSC509",
                    argument.span,
                    f"`{argument.parameter}` is a word of the runtime's own here; rename it",
                )
        self._expressions((node.actor, *(argument.value for argument in node.arguments)))
        self._modifiers(node, key, frozenset(self._runtime.modifiers))

    # --- modifiers ---

    def _modifiers(self, node: ir.Invoke, key: str, accepted: frozenset[str]) -> None:
        for index, modifier in enumerate(node.modifiers):
            self._modifier(modifier, key, accepted)
            earlier = (m for m in node.modifiers[:index] if m.name == modifier.name)
            if any(other.at == modifier.at for other in earlier):
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
        for modifier in lasting:
            others = self._runtime.conflicts.get(_sort_of(modifier), frozenset())
            for other in lasting:
                if other.name in others and not _arrives(node, modifier, other):
                    self._same_thing(modifier, other)

    def _same_thing(self, one: ir.ModifierCall, other: ir.ModifierCall) -> None:
        self._sink.report(
            "OSC508",
            other.span,
            f"`{one.name}` and `{other.name}` speak of the same thing",
            help="give one of them",
        )

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
        self._rules(modifier.name, modifier.span, modifier.arguments)

    def _moving(self, modifier: ir.ModifierCall) -> None:
        if modifier.at == "start" and modifier.name in self._runtime.no_start:
            self._sink.report(
                "OSC509",
                modifier.span,
                f"modifier `{modifier.name}` says nothing about a start",
                help="leave `at: start` out",
            )
        what = f"{modifier.name} while moving"
        self._rules(what, modifier.span, modifier.arguments, {"at": modifier.at})

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


def _sort_of(modifier: ir.ModifierCall) -> str:
    """Return the name under which the runtime lists what a modifier leaves no room for."""
    values = (a.value for a in modifier.arguments if a.parameter == "direction")
    lateral = any(isinstance(v, ir.EnumValue) and v.member == "lateral" for v in values)
    return f"lateral {modifier.name}" if lateral else modifier.name


def _arrives(node: ir.Invoke, one: ir.ModifierCall, other: ir.ModifierCall) -> bool:
    """Whether a place is for the end: it comes while the speed is held, or both come then.

    Without a duration of its own the action may end with its phase; the runtime sees to that.
    """
    place = other if other.name == "position" else one
    rate = one if place is other else other
    ranges = isinstance(node.duration, ir.RangeValue)
    at_end = place.name == "position" and place.at == "end"
    return at_end and (rate.at == "all" or (rate.name == "speed" and not ranges))
