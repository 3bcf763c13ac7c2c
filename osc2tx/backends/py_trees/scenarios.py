"""Scenario classes: declarations, initial placement, behavior."""

from __future__ import annotations

from dataclasses import replace

from osc2tx import ir
from osc2tx.backends.py_trees.behaviors import BehaviorTreeBuilder
from osc2tx.backends.py_trees.calls import CallWriter, code, comments
from osc2tx.backends.py_trees.code import (
    Level,
    PyComment,
    PyDocLine,
    PyExpr,
    PyName,
    literal,
    name_expression,
    self_attribute,
)
from osc2tx.backends.py_trees.coverage import CoverageWriter
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import SCENARIO_ATTRIBUTES, NameTable, identifier
from osc2tx.backends.py_trees.own_types import class_key
from osc2tx.backends.py_trees.runtime_api import (
    ACTOR_CLASSES,
    ANNOTATIONS,
    NESTED_OBJECTS,
    STRUCT_CLASSES,
    constructor_keyword,
)
from osc2tx.backends.py_trees.source_map import ScenarioMap, scenario_map
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import (
    ArgumentView,
    CallView,
    FunctionParameterView,
    FunctionView,
    ScenarioView,
    StatementView,
)


class ScenarioWriter:
    """Turns one scenario into its view model and its source map.

    Args:
        scenario: The scenario.
        one_of: Policy of `one_of` in this module.
        classes: Names of the module's scenario classes, by key of the scenario.
        uses: What the module has to import.
    """

    def __init__(self, scenario: ir.Scenario, one_of: str, classes: NameTable, uses: Uses) -> None:
        """See the class."""
        self._scenario = scenario
        self._one_of = one_of
        self._classes = classes
        self._names = NameTable(SCENARIO_ATTRIBUTES)
        for member in (*scenario.declarations, *scenario.methods):
            self._names.add(member.name, identifier(member.name))
        self._uses = uses
        expressions = ExpressionWriter(
            self._names, uses.unit, uses.name, lambda type_: self._class((type_,)), scenario.methods
        )
        self._calls = CallWriter(expressions, uses.name, uses.modifier)
        self.source_map: ScenarioMap = scenario_map(scenario)

    def write(self) -> ScenarioView:
        """Return the view model; afterwards `source_map` is complete."""
        declarations = tuple(
            self._declaration(declaration, is_first=index == 0)
            for index, declaration in enumerate(self._scenario.declarations)
        )
        functions = tuple(
            self._function(method, method.expression)
            for method in self._scenario.methods
            if method.expression is not None
        )
        placements = tuple(self._placement(placement) for placement in self._scenario.placements)
        methods = BehaviorTreeBuilder(
            self._calls, self._names, self._classes, self.source_map
        ).write(self._scenario)
        return ScenarioView(
            class_name=self._classes[self._scenario.key],
            docstring=self._docstring(),
            attributes=self._attributes(),
            declarations=(
                *self._externals(),
                *declarations,
                *self._constraints(),
                *self._coverage(),
            ),
            functions=functions,
            placements=placements,
            methods=methods,
            end_comments=comments(self._scenario.end_comments),
        )

    def _docstring(self) -> tuple[PyDocLine, ...]:
        scenario = self._scenario
        lines = [f"Scenario `{scenario.name}` ({scenario.span})."]
        if scenario.comments:
            lines += ["", *scenario.comments]
        return tuple(PyDocLine.of(line) for line in lines)

    def _attributes(self) -> tuple[StatementView, ...]:
        values = {"name": self._scenario.name, "source": self._scenario.span.source.name}
        if self._one_of != "race":
            values["one_of"] = self._one_of
        return tuple(
            StatementView(name_expression(PyName(name)), code(literal(value)))
            for name, value in values.items()
        )

    def _declaration(self, declaration: ir.Declaration, *, is_first: bool) -> StatementView:
        name = self._names[declaration.name]
        self.source_map.fields[str(name)] = declaration.span.line
        lines = declaration.comments
        if declaration is self._first_implicit_event():
            lines = ("Events that the scenario uses without declaring them",)
        return StatementView(
            target=self_attribute(name),
            value=self._declared_value(declaration),
            comments=comments(lines),
            blank_before=bool(lines) and not is_first,
        )

    def _constraints(self) -> tuple[StatementView, ...]:
        """Write what must hold between the values, below them."""
        write = self._calls.expressions.write
        statements = []
        for index, constraint in enumerate(self._scenario.constraints):
            text = " ".join(constraint.span.text.split())
            self.source_map.constraints.append((constraint.span.line, text))
            statements.append(
                StatementView(
                    target=None,
                    value=ArgumentView(
                        call=CallView(_self("keep"), (code(write(constraint.expression)),))
                    ),
                    comments=comments(constraint.comments),
                    blank_before=index == 0 or bool(constraint.comments),
                )
            )
        return tuple(statements)

    def _coverage(self) -> tuple[StatementView, ...]:
        """Write what is sampled for coverage, below the values."""
        writer = CoverageWriter(self._calls)
        return tuple(
            StatementView(
                target=None,
                value=ArgumentView(call=writer.write(item)),
                comments=comments(item.comments),
                blank_before=index == 0 or bool(item.comments),
            )
            for index, item in enumerate(self._scenario.coverage)
        )

    def _first_implicit_event(self) -> ir.Event | None:
        events = (d for d in self._scenario.declarations if isinstance(d, ir.Event))
        return next((event for event in events if event.is_implicit), None)

    def _declared_value(self, declaration: ir.Declaration) -> ArgumentView:
        match declaration:
            case ir.Actor(lineage=lineage):
                return self._constructor(lineage, declaration.values)
            case ir.Struct():
                return self._struct(declaration)
            case ir.Variable():
                return self._variable(declaration)
            case ir.Parameter():
                return self._parameter(declaration)
            case ir.Event(trigger=trigger):
                arguments = () if trigger is None else self._calls.trigger(trigger)
                arguments += self._event_parameters(declaration.parameters)
                return ArgumentView(call=self._calls.runtime_call("Event", *arguments))

    def _struct(self, struct: ir.Struct) -> ArgumentView:
        """Write an object; one of an invoked scenario may come from the caller."""
        if struct.value is not None:
            value = code(self._calls.expressions.write(struct.value))
        else:
            value = self._constructor(struct.lineage, struct.values)
        if not self._scenario.is_invoked:
            return value
        return ArgumentView(call=CallView(_self("argument"), (code(literal(struct.name)), value)))

    def _constructor(
        self, lineage: tuple[str, ...], values: tuple[ir.FieldValue, ...]
    ) -> ArgumentView:
        nested = {v.path[0]: NESTED_OBJECTS.get((lineage[0], v.path[0])) for v in values}
        arguments: dict[str, ArgumentView] = {}
        for value in values:
            first = value.path[0]
            inner = nested[first]
            if inner is None or len(value.path) == 1:
                arguments[constructor_keyword(value.path)] = ArgumentView(
                    code=self._calls.expressions.write(value.value),
                    comments=comments(value.comments),
                )
            elif first not in arguments:
                below = tuple(replace(v, path=v.path[1:]) for v in values if v.path[0] == first)
                arguments[first] = self._constructor((inner,), below)
        written = (replace(a, keyword=PyName(keyword)) for keyword, a in arguments.items())
        return ArgumentView(call=CallView(name_expression(self._class(lineage)), tuple(written)))

    def _class(self, lineage: tuple[str, ...]) -> PyName:
        """Name the class of an object: one of the module, or of the runtime."""
        if class_key(lineage[0]) in self._classes:
            return self._classes[class_key(lineage[0])]
        known = {**ACTOR_CLASSES, **STRUCT_CLASSES}
        return self._calls.use_name(next(known[name] for name in lineage if name in known))

    def _variable(self, variable: ir.Variable) -> ArgumentView:
        """Write the value, or how the variable is sampled."""
        writer = self._calls.expressions
        initial = [code(writer.write(v)) for v in (variable.value,) if v is not None]
        if variable.sample is None:
            return initial[0]  # the verifier saw to it that there is one
        what = code(writer.late(writer.write(variable.sample.expression)))
        when = self._calls.occurrence(variable.sample.trigger)
        return ArgumentView(call=CallView(_self("sample"), (what, when, *initial)))

    def _event_parameters(
        self, parameters: tuple[ir.MethodParameter, ...]
    ) -> tuple[ArgumentView, ...]:
        """Write the parameters of an event with their defaults; `None` must be given."""
        if not parameters:
            return ()
        writer = self._calls.expressions
        entries = ", ".join(
            f"{literal(p.name)}: {'None' if p.default is None else writer.value(p.default)}"
            for p in parameters
        )
        return (code(PyExpr(f"{{{entries}}}", Level.ATOM), "parameters"),)

    def _parameter(self, parameter: ir.Parameter) -> ArgumentView:
        """Write a constant as its value, anything else so that `--set` can reach it."""
        write = self._calls.expressions.write
        if parameter.value is not None and self._is_constant(parameter):
            return code(write(parameter.value))
        if parameter.value is not None and parameter.type.element is not None:
            name, value = code(literal(parameter.name)), code(write(parameter.value))
            return ArgumentView(call=CallView(_self("argument"), (name, value)))
        arguments = [code(literal(parameter.name))]
        is_plain = parameter.type.element is None and parameter.type.kind is not ir.Kind.STRUCT
        method = "global_parameter" if parameter.is_global else "parameter"
        if parameter.is_required and not is_plain:
            method = "required_argument"
            arguments.append(code(self._annotation(parameter.type)))
        elif parameter.is_required:
            method = "required_global" if parameter.is_global else "required"
            arguments.append(code(self._annotation(parameter.type)))
        arguments += [code(write(v)) for v in (parameter.value, parameter.domain) if v is not None]
        return ArgumentView(call=CallView(_self(method), tuple(arguments)))

    def _externals(self) -> tuple[StatementView, ...]:
        """Write the methods that are code of the user: the runtime asks whether they may run."""
        statements = []
        for method in self._scenario.methods:
            if method.external is None:
                continue
            name = self._names[method.name]
            path = f"{method.external.module}.{method.external.function}"
            self.source_map.fields[path] = method.span.line
            kind = code(self._annotation(method.result)) if method.result is not None else None
            arguments = (code(literal(path)),) if kind is None else (code(literal(path)), kind)
            statements.append(
                StatementView(
                    target=self_attribute(name),
                    value=ArgumentView(call=CallView(_self("external"), arguments)),
                    comments=comments(method.comments),
                )
            )
        return tuple(statements)

    def _is_constant(self, parameter: ir.Parameter) -> bool:
        """Whether nothing can change a value: lists and ranges only come from an invoker."""
        is_single = parameter.type.element is None
        return parameter.is_fixed or not (is_single or self._scenario.is_invoked)

    def _function(self, method: ir.Method, body: ir.Expression) -> FunctionView:
        write = self._calls.expressions.write
        return FunctionView(
            name=self._names[method.name],
            parameters=tuple(
                FunctionParameterView(
                    self._calls.expressions.parameter(parameter.name),
                    self._annotation(parameter.type),
                    None if parameter.default is None else write(parameter.default),
                )
                for parameter in method.parameters
            ),
            result=self._annotation(method.result),
            value=write(body),
            location=PyComment.of(str(method.span)),
            comments=comments(method.comments),
        )

    def _annotation(self, type_: ir.ValueType | None) -> PyExpr:
        if type_ is None:
            return PyExpr("object", Level.ATOM)  # called for what it does
        if type_.element is not None:
            is_list = type_.kind is ir.Kind.LIST
            outer = "list" if is_list else str(self._calls.use_name("Range"))
            return PyExpr(f"{outer}[{self._annotation(type_.element)}]", Level.ATOM)
        plain = ANNOTATIONS.get(type_.kind.value)
        if plain is not None:
            return name_expression(PyName(plain))
        return name_expression(self._class((type_.name,)))

    def _placement(self, placement: ir.Placement) -> StatementView:
        self.source_map.placements.append(placement.span.line)
        actor = code(self._calls.expressions.field(placement.actor))
        # A placement speaks of the start anyway.
        modifiers = (self._calls.modifier(replace(m, at="all")) for m in placement.modifiers)
        may_start_later = self._scenario.is_invoked and placement.is_throughout
        later = (code(literal(True), "throughout"),) if may_start_later else ()
        method = _self("require" if placement.of_map else "place")
        call = CallView(method, (actor, *modifiers, *later))
        return StatementView(None, ArgumentView(call=call), comments(placement.comments))


def _self(name: str) -> PyExpr:
    return self_attribute(PyName(name))
