"""Calls as the templates place them: actions, modifiers, constructors."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyExpr, PyName, literal, name_expression
from osc2tx.backends.py_trees.comments import around, comments
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.modifier_calls import ModifierCalls
from osc2tx.backends.py_trees.naming import event_parameter, identifier
from osc2tx.backends.py_trees.view import ArgumentView, CallView
from osc2tx_shared.classes import replace


def code(expression: PyExpr, keyword: str | None = None) -> ArgumentView:
    """Return a plain argument."""
    return ArgumentView(code=expression, keyword=PyName(keyword) if keyword else None)


class CallWriter:
    """Writes modifiers, conditions and argument lists.

    Args:
        expressions: Writer of the scenario's expressions.
        use_name: Called with each name needed from the runtime library.
        use_modifier: Called with each modifier function needed.
        functions: User-defined modifiers that the module has as functions.
    """

    def __init__(
        self,
        expressions: ExpressionWriter,
        use_name: Callable[[str], PyName],
        use_modifier: Callable[[str], PyName],
        functions: ModifierCalls,
    ) -> None:
        self._functions = functions
        self.expressions = expressions
        self.use_name = use_name
        self._use_modifier = use_modifier

    def runtime_call(self, name: str, *arguments: ArgumentView) -> CallView:
        """Return a call of a function or class of the runtime library."""
        return CallView(name_expression(self.use_name(name)), arguments)

    def modifiers(self, calls: Iterable[ir.ModifierCall], depth: int = 0) -> Iterator[ArgumentView]:
        """Write modifiers; those of a user-defined modifier as a call of its function.

        Args:
            calls: The modifiers.
            depth: Number of surrounding applications that are written out.
        """
        for application, modifier, parts in self._functions.groups(calls, depth):
            if application is None:
                yield from map(self.modifier, parts)
            elif modifier is not None:
                yield self._own_modifier(modifier, application, parts[0])
            else:
                yield from self.modifiers(parts, depth + 1)

    def _own_modifier(
        self, modifier: ir.UserModifier, application: ir.Application, first: ir.ModifierCall
    ) -> ArgumentView:
        """Write a call of a function; the comments in its body are at the function."""
        arguments = self._functions.arguments(modifier, application)
        function = PyExpr(f"*{self._functions.name(modifier)}", Level.ATOM)
        written = tuple(code(self.expressions.write(value), str(name)) for name, value in arguments)
        above = first.comments[: len(first.comments) - len(modifier.calls[0].comments)]
        return ArgumentView(call=CallView(function, written), **around(above))

    def modifier(self, call: ir.ModifierCall) -> ArgumentView:
        """Write a modifier; its first argument stays positional if the source has it so."""
        arguments = tuple(
            self._modifier_argument(argument, is_first=index == 0)
            for index, argument in enumerate(call.arguments)
        )
        if call.at != "all":
            arguments += (code(literal(call.at), "at"),)
        function = name_expression(self._use_modifier(identifier(call.name)))
        return ArgumentView(call=CallView(function, arguments), **around(call.comments))

    def _modifier_argument(self, argument: ir.Argument, *, is_first: bool) -> ArgumentView:
        value = self.expressions.value(argument.value)
        if is_first and argument.is_positional:
            return code(value)
        return code(value, identifier(argument.parameter))

    def keywords(self, arguments: tuple[ir.Argument, ...]) -> tuple[ArgumentView, ...]:
        """Write arguments of an action, all by name: its positions are for modifiers."""
        return tuple(
            code(self.expressions.value(argument.value), identifier(argument.parameter))
            for argument in arguments
        )

    def event_parameters(self, arguments: tuple[ir.Argument, ...]) -> tuple[ArgumentView, ...]:
        """Write arguments of an event."""
        return tuple(
            code(self.expressions.value(argument.value), str(event_parameter(argument.parameter)))
            for argument in arguments
        )

    def duration(self, duration: ir.Expression | None) -> tuple[ArgumentView, ...]:
        """Write `duration=…`, a range as a pair."""
        return self.time_limit("duration", duration)

    def time_limit(self, keyword: str, value: ir.Expression | None) -> tuple[ArgumentView, ...]:
        """Write a time or range of time as a keyword argument."""
        if value is None:
            return ()
        if isinstance(value, ir.RangeValue):
            lower = self.expressions.write(value.lower)
            upper = self.expressions.write(value.upper)
            return (code(PyExpr(f"({lower}, {upper})", Level.ATOM), keyword),)
        if isinstance(value, ir.HalfRange):
            bound = self.expressions.write(value.bound)
            pair = f"{bound}, {self.use_name('inf')}" if value.is_lower else f"0.0, {bound}"
            return (code(PyExpr(f"({pair})", Level.ATOM), keyword),)
        return (code(self.expressions.write(value), keyword),)

    def triggers(self, triggers: tuple[ir.Trigger, ...]) -> tuple[ArgumentView, ...]:
        """Write triggers as arguments of `Until`."""
        return tuple(self.occurrence(trigger) for trigger in triggers)

    def occurrence(self, trigger: ir.Trigger) -> ArgumentView:
        """Write an event specification as one argument; `@e if c` becomes an event object."""
        arguments = self.trigger(trigger)
        if len(arguments) == 1:
            return arguments[0]
        call = self.runtime_call("Event", *(replace(a, comments=()) for a in arguments))
        return ArgumentView(call=call, comments=arguments[0].comments)

    def trigger(self, trigger: ir.Trigger) -> tuple[ArgumentView, ...]:
        """Write an event specification: an event, a condition, or both."""
        arguments: list[ArgumentView] = []
        match trigger.event:
            case ir.EventRef(name=name):
                arguments.append(code(self.expressions.field(name)))
            case ir.LabelEvent():
                arguments.append(self._label_event(trigger.event))
            case ir.InnerEvent(label=label, name=name):
                path = code(literal(f"{label}.{name}"))
                event = PyExpr("self.event", Level.ATOM)
                arguments.append(ArgumentView(call=CallView(event, (path,))))
            case None:
                pass
        if trigger.condition is not None:
            condition = self.condition(trigger.condition)
            keyword = PyName("condition") if arguments else None
            arguments.append(replace(condition, keyword=keyword))
        first = replace(arguments[0], comments=comments(trigger.comments))
        return (first, *arguments[1:])

    def _label_event(self, event: ir.LabelEvent) -> ArgumentView:
        methods = {
            ir.Moment.START: "started",
            ir.Moment.END: "ended",
            ir.Moment.FAIL: "failed",
        }
        method = PyExpr(f"self.{methods[event.moment]}", Level.ATOM)
        return ArgumentView(call=CallView(method, (code(literal(event.label)),)))

    def condition(self, condition: ir.Condition) -> ArgumentView:
        """Write a condition; expressions over the world are read late."""
        writer = self.expressions
        match condition:
            case ir.Level(expression=expression):
                return code(writer.late(writer.write(expression)))
            case ir.Edge(rising=rising, expression=expression):
                late = code(writer.late(writer.write(expression)))
                return ArgumentView(call=self.runtime_call("rise" if rising else "fall", late))
            case ir.Elapsed(duration=duration):
                time = code(writer.value(duration))
                return ArgumentView(call=self.runtime_call("elapsed", time))
            case ir.Every(period=period, offset=offset):
                shift = () if offset is None else (code(writer.write(offset), "offset"),)
                call = self.runtime_call("every", code(writer.write(period)), *shift)
                return ArgumentView(call=call)
