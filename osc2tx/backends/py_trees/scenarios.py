"""Scenario classes: declarations, initial placement, behavior."""

from __future__ import annotations

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
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import SCENARIO_ATTRIBUTES, NameTable, identifier
from osc2tx.backends.py_trees.runtime_api import (
    ACTOR_CLASSES,
    ANNOTATIONS,
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
        expressions = ExpressionWriter(self._names, uses.unit, uses.name, scenario.methods)
        self._calls = CallWriter(expressions, uses.name, uses.modifier)
        self.source_map: ScenarioMap = scenario_map(scenario)

    def write(self) -> ScenarioView:
        """Return the view model; afterwards `source_map` is complete."""
        declarations = tuple(
            self._declaration(declaration, is_first=index == 0)
            for index, declaration in enumerate(self._scenario.declarations)
        )
        functions = tuple(self._function(method) for method in self._scenario.methods)
        placements = tuple(self._placement(placement) for placement in self._scenario.placements)
        methods = BehaviorTreeBuilder(
            self._calls, self._names, self._classes, self.source_map
        ).write(self._scenario)
        return ScenarioView(
            class_name=self._classes[self._scenario.key],
            docstring=self._docstring(),
            attributes=self._attributes(),
            declarations=declarations,
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

    def _first_implicit_event(self) -> ir.Event | None:
        events = (d for d in self._scenario.declarations if isinstance(d, ir.Event))
        return next((event for event in events if event.is_implicit), None)

    def _declared_value(self, declaration: ir.Declaration) -> ArgumentView:
        match declaration:
            case ir.Actor(lineage=lineage):
                kind = next(ACTOR_CLASSES[t] for t in lineage if t in ACTOR_CLASSES)
                return self._constructor(kind, declaration.values)
            case ir.Struct(type=type_):
                return self._constructor(STRUCT_CLASSES[type_], declaration.values)
            case ir.Variable():
                return self._variable(declaration)
            case ir.Parameter():
                return self._parameter(declaration)
            case ir.Event(trigger=trigger):
                arguments = () if trigger is None else self._calls.trigger(trigger)
                arguments += self._event_parameters(declaration.parameters)
                return ArgumentView(call=self._calls.runtime_call("Event", *arguments))

    def _constructor(self, kind: str, values: tuple[ir.FieldValue, ...]) -> ArgumentView:
        arguments = tuple(
            ArgumentView(
                code=self._calls.expressions.write(value.value),
                keyword=PyName(constructor_keyword(value.path)),
                comments=comments(value.comments),
            )
            for value in values
        )
        return ArgumentView(call=self._calls.runtime_call(kind, *arguments))

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
        if parameter.is_fixed and parameter.value is not None:
            return code(write(parameter.value))
        arguments = [code(literal(parameter.name))]
        arguments += [code(write(v)) for v in (parameter.value, parameter.domain) if v is not None]
        method = "global_parameter" if parameter.is_global else "parameter"
        return ArgumentView(call=CallView(_self(method), tuple(arguments)))

    def _function(self, method: ir.Method) -> FunctionView:
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
            value=write(method.expression),
            location=PyComment.of(str(method.span)),
            comments=comments(method.comments),
        )

    def _annotation(self, type_: ir.ValueType) -> PyName:
        plain = ANNOTATIONS.get(type_.kind.value)
        if plain is not None:
            return PyName(plain)
        return self._calls.use_name(ACTOR_CLASSES[type_.name])

    def _placement(self, placement: ir.Placement) -> StatementView:
        self.source_map.placements.append(placement.span.line)
        actor = code(self._calls.expressions.field(placement.actor))
        modifiers = (self._calls.modifier(modifier) for modifier in placement.modifiers)
        call = CallView(_self("place"), (actor, *modifiers))
        return StatementView(None, ArgumentView(call=call), comments(placement.comments))


def _self(name: str) -> PyExpr:
    return self_attribute(PyName(name))
