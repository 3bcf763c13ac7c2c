"""The behavior tree as methods that return nested constructor calls.

The root gets a method, and so does every composition that the IR calls a phase; the others are
inline, nested as in the source.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import assert_never

from osc2tx import ir
from osc2tx.backends.py_trees.calls import CallWriter, code
from osc2tx.backends.py_trees.code import (
    Level,
    PyDocLine,
    PyExpr,
    PyName,
    literal,
    name_expression,
    self_attribute,
)
from osc2tx.backends.py_trees.comments import around, comments
from osc2tx.backends.py_trees.formatting import INDENT, LINE_LENGTH
from osc2tx.backends.py_trees.naming import (
    InvocationName,
    NameTable,
    composition_names,
    identifier,
    invocation_names,
)
from osc2tx.backends.py_trees.user_actions import action_key, is_function
from osc2tx.backends.py_trees.view import (
    ArgumentView,
    CallView,
    MethodView,
    StatementView,
    signature,
)
from osc2tx_shared.classes import replace

BEHAVIOUR = name_expression(PyName("Behaviour"))
CLASSES = {ir.Serial: "Serial", ir.Parallel: "Parallel", ir.OneOf: "OneOf"}


class BehaviorTreeBuilder:
    """Writes the methods of one scenario.

    Args:
        calls: Writer of calls.
        phases: Names of the methods for parts of the tree.
        classes: Names of the module's scenario classes, by key of the scenario.
        actions: The user-defined actions.
    """

    def __init__(
        self,
        calls: CallWriter,
        phases: Mapping[ir.Behavior, PyName],
        classes: NameTable,
        actions: Iterable[ir.UserAction],
    ) -> None:
        self._actions = {action.qualified_name: action for action in actions}
        self._classes = classes
        self._calls = calls
        self._phases = phases
        self._written: list[MethodView] = []
        self._compositions: dict[ir.Behavior, PyExpr] = {}
        self._invocations: dict[ir.Behavior, InvocationName] = {}

    def write(self, scenario: ir.Scenario) -> tuple[MethodView, ...]:
        """Return `behavior` and the methods it calls, in source order."""
        self._compositions = {
            node: literal(name) for node, name in composition_names(scenario.body).items()
        }
        if ir.is_named_after(scenario):  # a subclass is called otherwise
            self._compositions[scenario.body] = _own_name(scenario)
        self._invocations = invocation_names(scenario.body)
        self._method(PyName("behavior"), scenario.body)
        first = replace(self._written[0], statements=tuple(map(_override, scenario.overrides)))
        return (first, *self._written[1:])

    def _method(self, name: PyName, node: ir.Behavior) -> None:
        """Write a method; it is listed before those it calls.

        A short comment above the phase is its docstring, a longer one stays above.
        """
        index = len(self._written)
        value = self._node(node)
        story = docstring_of(_not_below(node))
        method = MethodView(
            signature=signature(name, (), BEHAVIOUR),
            value=replace(value, comments=(), trailing=None, below=()),
            docstring=tuple(PyDocLine.of(text) for text in (story,) if text),
            comments=() if story else comments(_not_below(node)),
        )
        self._written.insert(index, method)

    def _member(self, node: ir.Behavior) -> ArgumentView:
        """Write a member of a composition: inline, or as the call of its method."""
        name = self._phases.get(node)
        if name is None:
            return self._node(node)
        self._method(name, node)
        below = around(node.comments)["below"]
        return ArgumentView(call=CallView(self_attribute(name)), below=below)

    def _node(self, node: ir.Behavior) -> ArgumentView:
        until = (
            () if isinstance(node, ir.Wait | ir.Emit | ir.Finish | ir.Call | ir.On) else node.until
        )
        call = self._call(node)
        if until:
            triggers = self._calls.triggers(until)
            call = self._calls.runtime_call("Until", ArgumentView(call=call), *triggers)
            call = replace(call, exploded=True)
        return ArgumentView(call=call, **around(node.comments))

    def _call(self, node: ir.Behavior) -> CallView:
        match node:
            case ir.Serial() | ir.Parallel() | ir.OneOf():
                return self._composition(node)
            case ir.Invoke():
                return self._invocation(node)
            case ir.InvokeScenario():
                return self._scenario_invocation(node)
            case ir.Wait(trigger=trigger):
                arguments = (*self._label(node.label), *self._calls.trigger(trigger))
                return self._calls.runtime_call("Wait", *arguments)
            case ir.Emit(event=event):
                target = code(self._calls.expressions.field(event.name))
                given = self._calls.event_parameters(node.arguments)
                return self._calls.runtime_call("Emit", target, *given)
            case ir.Finish(succeeds=succeeds):
                label = self._label(node.label)
                return self._calls.runtime_call("End" if succeeds else "Fail", *label)
            case ir.Call(call=expression):
                writer = self._calls.expressions
                function = code(writer.late(writer.write(expression)))
                return self._calls.runtime_call("Call", *self._label(node.label), function)
            case ir.On(trigger=trigger, reactions=reactions):
                what, *condition = self._calls.trigger(trigger)
                do = map(self._node, reactions)
                call = self._calls.runtime_call("On", what, *do, *condition)
                return replace(call, exploded=True)
            case _:
                assert_never(node)

    def _composition(self, node: ir.Composition) -> CallView:
        name = code(self._compositions[node])
        members = tuple(map(self._member, node.members))
        arguments = (name, *members, *self._composition_arguments(node))
        function = name_expression(self._calls.use_name(CLASSES[type(node)]))
        return CallView(
            function, arguments, exploded=True, end_comments=comments(node.end_comments)
        )

    def _composition_arguments(self, node: ir.Composition) -> tuple[ArgumentView, ...]:
        arguments = self._calls.duration(node.duration)
        if isinstance(node, ir.Parallel):
            if node.overlap is not None:
                arguments += (code(literal(node.overlap), "overlap"),)
            arguments += self._calls.time_limit("start_to_start", node.start_to_start)
            arguments += self._calls.time_limit("end_to_end", node.end_to_end)
        return arguments

    def _invocation(self, node: ir.Invoke) -> CallView:
        given = node.arguments
        written = () if node.actor is None else (self._calls.expressions.write(node.actor),)
        first: tuple[ArgumentView, ...] = ()
        if is_function(node):
            action = name_expression(self._classes[action_key(node.qualified_name)])
            first = tuple(map(code, written))
            given = self._not_by_default(node)
        else:
            path = (*(actor.within(Level.ATOM) for actor in written), identifier(node.action))
            action = PyExpr(".".join(path), Level.ATOM)
        arguments = (
            *first,
            *self._label(node.label),
            *self._calls.modifiers(node.modifiers),
            *self._calls.keywords(given),
            *self._calls.duration(node.duration),
        )
        return CallView(action, arguments)

    def _not_by_default(self, node: ir.Invoke) -> tuple[ir.Argument, ...]:
        """Return the arguments that are not the defaults of a user-defined action."""
        declared = self._actions[node.qualified_name].parameters
        defaults = {p.name: p.default for p in declared if p.default is not None}
        return tuple(
            argument
            for argument in node.arguments
            if argument.parameter not in defaults
            or not ir.means_same(argument.value, defaults[argument.parameter])
        )

    def _scenario_invocation(self, node: ir.InvokeScenario) -> CallView:
        name = self._invocations[node]
        arguments = [*self._label(name.label), code(name_expression(self._classes[node.key]))]
        arguments += map(self._special, node.specials)
        if node.actor is not None:
            arguments.append(code(self._calls.expressions.write(node.actor), "actor"))
        arguments += self._calls.keywords(node.arguments)
        arguments += self._calls.duration(node.duration)
        if node.times:
            arguments.append(self._times(node.times))
        if name.known_as is not None:
            arguments.append(code(literal(name.known_as), "known_as"))
        return CallView(self_attribute(PyName("invoke")), tuple(arguments))

    def _special(self, special: ir.SpecialScenario) -> ArgumentView:
        """Write a conditional scenario: `SlowPhase.when(fast=False)`."""
        of_class = name_expression(self._classes[special.key])
        function = PyExpr(f"{of_class.text}.when", Level.ATOM)
        return ArgumentView(call=CallView(function, self._calls.keywords(special.values)))

    def _times(self, times: tuple[ir.Argument, ...]) -> ArgumentView:
        """Write the times of an invoked scenario by their paths."""
        value = self._calls.expressions.value
        entries = (f"{literal(each.parameter)}: {value(each.value)}" for each in times)
        return code(PyExpr(f"{{{', '.join(entries)}}}", Level.ATOM), "times")

    def _label(self, label: str | None) -> tuple[ArgumentView, ...]:
        return () if label is None else (code(literal(label)),)


def _own_name(scenario: ir.Scenario) -> PyExpr:
    """Write the name of a scenario, which is another one in a subclass."""
    return self_attribute(PyName("short_name" if "." in scenario.name else "name"))


def _not_below(node: ir.Behavior) -> tuple[str, ...]:
    """Return the comment lines above and behind a member."""
    return tuple(line for line in node.comments if not isinstance(line, ir.CommentBelow))


def docstring_of(lines: Sequence[str]) -> str:
    """Return a comment as a docstring, without rules and frames around it; empty if it is long."""
    plain = [text for line in lines if (text := line.strip(RULES))]
    if lines and not lines[-1]:
        return ""  # a blank line parts them from the phase
    if len(plain) != 1 or len(plain[0]) >= DOC_WIDTH:
        return ""
    return f"{plain[0]}." if plain[0][-1].isalnum() else plain[0]


RULES = "-=*#~_ "
"""The characters of rules and frames in comments."""
DOC_WIDTH = LINE_LENGTH - 2 * INDENT - 2 * len('"""')


def _override(override: ir.Override) -> StatementView:
    labels = (code(literal(override.overridden)), code(literal(override.by)))
    mode = () if override.mode == "on_start" else (code(literal(override.mode), "mode"),)
    call = CallView(self_attribute(PyName("override")), (*labels, *mode))
    return StatementView(None, ArgumentView(call=call), **around(override.comments))
