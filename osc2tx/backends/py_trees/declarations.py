"""Declarations of scenario classes: cast, values and events, and narrowed inherited ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence

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
from osc2tx.backends.py_trees.coverage import written_unit
from osc2tx.backends.py_trees.members import Members, event_class_key
from osc2tx.backends.py_trees.naming import event_parameter
from osc2tx.backends.py_trees.objects import ObjectWriter
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.view import (
    ArgumentView,
    CallView,
    EventView,
    FieldView,
    StatementView,
)
from osc2tx_shared.classes import replace


class DeclarationWriter:
    """Writes the declarations of one scenario.

    Args:
        scenario: The scenario.
        members: The members of its class, and its name.
        calls: Writer of calls.
        types: All types that the module knows.
    """

    def __init__(
        self,
        scenario: ir.AbstractScenario,
        members: Members,
        calls: CallWriter,
        types: TypeTable,
    ) -> None:
        self._source = scenario.span.source
        self._own, self._names = members.own, members.names
        self._calls = calls
        self._types = types
        self._objects = ObjectWriter(calls.expressions, types)
        events = (each for each in scenario.declarations if isinstance(each, ir.Event))
        self._first_implicit_event = next((each for each in events if each.is_implicit), None)

    def declared(self, declarations: Sequence[ir.Declaration]) -> tuple[StatementView, ...]:
        """Write declarations."""
        return tuple(
            self._declaration(each, is_first=index == 0) for index, each in enumerate(declarations)
        )

    def narrowed(self) -> tuple[StatementView, ...]:
        """Write the narrowed declarations of the base, before the base declares them."""
        pairs = [(there, here) for there, here in self._own.narrowed if not _is_assigned(there)]
        early = [(there, here) for there, here in pairs if here.name in self._own.early]
        return (
            *(self._assigned(here, there) for there, here in early),
            *(
                StatementView(
                    target=None,
                    value=self._narrowing(here, there),
                    comments=comments(
                        () if here.name in self._own.early else _further_lines(here, there)
                    ),
                )
                for there, here in pairs
            ),
        )

    def reassigned(self) -> tuple[StatementView, ...]:
        """Write constants of the base that are written otherwise here."""
        return tuple(
            self._assigned(here, there) for there, here in self._own.narrowed if _is_assigned(there)
        )

    def _assigned(self, here: ir.Declaration, there: ir.Declaration) -> StatementView:
        return StatementView(
            target=self_attribute(self._names[here.name]),
            value=self._declared_value(here),
            comments=comments(_further_lines(here, there)),
        )

    def _narrowing(self, declaration: ir.Declaration, there: ir.Declaration) -> ArgumentView:
        """Write the call that narrows a declaration; it computes values that depend on the base."""
        name = code(literal(ir.setting_name(declaration.name)))
        arguments: tuple[ArgumentView, ...]
        read: list[ir.Expression]
        match declaration:
            case ir.Parameter() if declaration.name in self._own.early:
                method, read = "fix_to", []
                arguments = (code(self_attribute(self._names[declaration.name])),)
            case ir.Parameter(value=value, is_fixed=True) if value is not None:
                method, read = "fix_to", [value]
                arguments = (code(self._calls.expressions.write(value)),)
            case ir.Parameter(value=value, domain=domain):
                method, read = "narrow_to", [part for part in (value, domain) if part is not None]
                is_unit_known = isinstance(there, ir.Parameter) and there.unit == declaration.unit
                arguments = self._choice(
                    replace(declaration, unit=None) if is_unit_known else declaration
                )
            case ir.Actor(values=values) | ir.Struct(values=values):
                read = [each.value for each in values]
                whole = declaration.value if isinstance(declaration, ir.Struct) else None
                read += [] if whole is None else [whole]
                method, arguments = "fix_to", (self._value_of(declaration),)
            case _:
                raise AssertionError(f"{declaration.name}: cannot be narrowed")
        if any(map(self._reads_base, read)):
            late = self._calls.expressions.late
            arguments = tuple(a if a.keyword else _deferred(a, late) for a in arguments)
        return ArgumentView(call=CallView(_self(method), (name, *arguments)))

    def _reads_base(self, value: ir.Expression) -> bool:
        """Whether a value is computed from declarations of the base, which come later."""
        ahead = {each.name for each in self._own.ahead} | self._own.early
        return any(
            (isinstance(part, ir.FieldRef) and part.name not in ahead)
            or (isinstance(part, ir.MethodCall) and isinstance(part.base, ir.ScenarioSelf))
            for part in ir.walk(value)
        )

    def _declaration(self, declaration: ir.Declaration, *, is_first: bool) -> StatementView:
        name = self._names[declaration.name]
        lines = declaration.comments
        if declaration is self._first_implicit_event:
            lines = ("Events that the scenario uses without declaring them",)
        return StatementView(
            target=self_attribute(name),
            value=self._declared_value(declaration),
            **around(lines),
            blank_before=not is_first and self._has_blank_line(declaration),
            annotation=self._declared_type(declaration),
        )

    def _has_blank_line(self, declaration: ir.Declaration) -> bool:
        """Whether a blank line is above a declaration in its source, or above all of its source."""
        source, number = declaration.span.source, declaration.span.line - 1
        before, self._source = self._source, source
        if source is not before or declaration is self._first_implicit_event:
            return True
        while number > 0 and source.line_text(number).lstrip().startswith("#"):
            number -= 1
        return number > 0 and not source.line_text(number).strip()

    def _declared_type(self, declaration: ir.Declaration) -> PyExpr | None:
        """Write the type of a value that alone does not show it: Python takes a member for text."""
        if not isinstance(declaration, ir.Parameter | ir.Variable):
            return None
        is_enum = (declaration.type.element or declaration.type).kind is ir.Kind.ENUM
        return self._types.annotation(declaration.type) if is_enum else None

    def _declared_value(self, declaration: ir.Declaration) -> ArgumentView:
        match declaration:
            case ir.Actor(name=name, lineage=lineage, is_given=True):
                class_ = name_expression(self._types.class_of(lineage))
                call = CallView(_self("required_argument"), (code(literal(name)), code(class_)))
                return ArgumentView(call=call)
            case ir.Actor() | ir.Struct():
                method = "cast" if isinstance(declaration, ir.Actor) else "argument"
                if declaration.is_global:
                    method = "global_object"
                known_as = code(literal(ir.setting_name(declaration.name)))
                value = self._value_of(declaration)
                return ArgumentView(call=CallView(_self(method), (known_as, value)))
            case ir.Variable():
                return self._variable(declaration)
            case ir.Parameter():
                return self._parameter(declaration)
            case ir.Event(trigger=trigger):
                arguments = () if trigger is None else self._calls.trigger(trigger)
                arguments += self._event_defaults(declaration.parameters)
                arguments += self._known_as(declaration.name)
                if not declaration.parameters:
                    return ArgumentView(call=self._calls.runtime_call("Event", *arguments))
                class_ = self_attribute(self._names[event_class_key(declaration.name)])
                return ArgumentView(call=CallView(class_, arguments))

    def _value_of(self, declared: ir.Actor | ir.Struct) -> ArgumentView:
        """Write an object: the equal object, or the call that creates it."""
        if isinstance(declared, ir.Struct) and declared.value is not None:
            return code(self._calls.expressions.write(declared.value))
        return self._objects.write(declared.lineage, declared.values)

    def _variable(self, variable: ir.Variable) -> ArgumentView:
        """Write the value, or how the variable is sampled."""
        writer = self._calls.expressions
        initial = [code(writer.write(v)) for v in (variable.value,) if v is not None]
        if variable.sample is None:
            return self._fixed(variable.type, initial[0])  # the verifier saw that there is one
        what = code(writer.late(writer.write(variable.sample.expression)))
        trigger = variable.sample.trigger
        if isinstance(trigger, ir.Moment):
            at: tuple[ArgumentView, ...] = (code(literal(trigger.value)),)
        else:
            at = self._calls.trigger(trigger)
        when, *condition = at
        known_as = self._known_as(variable.name)
        arguments = (what, when, *initial, *condition, *known_as)
        return ArgumentView(call=CallView(_self("sample"), arguments))

    def _known_as(self, name: str) -> tuple[ArgumentView, ...]:
        """Write the name that a member has in the scenario, where its attribute has another."""
        return () if str(self._names[name]) == name else (code(literal(name), "name"),)

    def events(self) -> tuple[EventView, ...]:
        """Write the classes of events with parameters."""
        declared = (*self._own.ahead, *self._own.declarations)
        return tuple(
            self._event_class(each)
            for each in declared
            if isinstance(each, ir.Event) and each.parameters
        )

    def _event_class(self, event: ir.Event) -> EventView:
        self._calls.use_name("Event")
        return EventView(
            class_name=self._names[event_class_key(event.name)],
            docstring=(PyDocLine.of(f"Event `{event.name}` and its parameters."),),
            parameters=tuple(
                FieldView(event_parameter(each.name), self._types.annotation(each.type))
                for each in event.parameters
            ),
        )

    def _event_defaults(
        self, parameters: tuple[ir.MethodParameter, ...]
    ) -> tuple[ArgumentView, ...]:
        writer = self._calls.expressions
        entries = ", ".join(
            f"{literal(str(event_parameter(each.name)))}: {writer.value(each.default)}"
            for each in parameters
            if each.default is not None
        )
        return (code(PyExpr(f"{{{entries}}}", Level.ATOM), "defaults"),) if entries else ()

    def _parameter(self, parameter: ir.Parameter) -> ArgumentView:
        """Write a constant as its value, anything else so that `--set` can reach it."""
        if parameter.value is not None and parameter.is_fixed:
            return self._choice(parameter)[0]
        is_object = parameter.type.element is not None or parameter.type.kind is ir.Kind.ACTOR
        is_plain = parameter.type.element is None and parameter.type.kind is not ir.Kind.STRUCT
        if parameter.value is not None and is_object:
            method = "argument"
        elif parameter.is_required and not is_plain:
            method = "required_argument"
        elif parameter.is_required:
            method = "required_global" if parameter.is_global else "required"
        else:
            method = "global_parameter" if parameter.is_global else "parameter"
        known_as = ir.setting_name(parameter.name) if parameter.is_global else parameter.name
        name = code(literal(known_as))
        return ArgumentView(call=CallView(_self(method), (name, *self._choice(parameter))))

    def _choice(self, parameter: ir.Parameter) -> tuple[ArgumentView, ...]:
        """Write the content of a parameter: its value, or type or default, domain and unit."""
        write = self._calls.expressions.write
        if parameter.value is not None and parameter.is_fixed:
            return (self._fixed(parameter.type, code(write(parameter.value))),)
        is_object = parameter.type.element is not None or parameter.type.kind is ir.Kind.ACTOR
        if parameter.value is not None and is_object:
            return (code(write(parameter.value)),)
        arguments = [code(write(v)) for v in (parameter.value, parameter.domain) if v is not None]
        if parameter.is_required:
            arguments.insert(0, code(self._types.annotation(parameter.type)))
        if parameter.unit is not None:
            arguments.append(code(written_unit(self._calls, parameter.unit), "unit"))
        return tuple(arguments)

    def _fixed(self, type_: ir.ValueType, value: ArgumentView) -> ArgumentView:
        """Write a constant; that of an enum so that it may be compared with other members."""
        if type_.kind is not ir.Kind.ENUM:
            return value
        return ArgumentView(call=self._calls.runtime_call("fixed", value))


def _is_assigned(declaration: ir.Declaration) -> bool:
    """Whether a class assigns a declaration, without a call that has its name."""
    return isinstance(declaration, ir.Parameter) and declaration.is_fixed


def _further_lines(here: ir.Declaration, there: ir.Declaration) -> tuple[str, ...]:
    """Return the comment lines of the constraints that narrow a declaration."""
    return tuple(line for line in here.comments if line not in there.comments)


def _deferred(argument: ArgumentView, late: Callable[[PyExpr], PyExpr]) -> ArgumentView:
    """Return an argument as a function without parameters that gives it."""
    if argument.call is not None and argument.call.callee is not None:
        callee = PyExpr(f"lambda: {argument.call.callee}", Level.LAMBDA)
        return replace(argument, call=replace(argument.call, callee=callee))
    return argument if argument.code is None else replace(argument, code=late(argument.code))


def _self(name: str) -> PyExpr:
    return self_attribute(PyName(name))
