"""Scenario classes: declarations, initial placement, behavior."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.backends.py_trees.behaviors import BehaviorTreeBuilder
from osc2tx.backends.py_trees.calls import CallWriter, apart, code, comments
from osc2tx.backends.py_trees.code import (
    Level,
    PyDocLine,
    PyExpr,
    PyName,
    literal,
    name_expression,
    self_attribute,
)
from osc2tx.backends.py_trees.coverage import CoverageWriter, written_unit
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.modifier_calls import ModifierCalls
from osc2tx.backends.py_trees.naming import SCENARIO_ATTRIBUTES, NameTable, identifier
from osc2tx.backends.py_trees.objects import ObjectWriter
from osc2tx.backends.py_trees.source_map import ScenarioMap
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import (
    ArgumentView,
    CallView,
    FunctionView,
    ScenarioView,
    StatementView,
    signature,
)
from osc2tx_shared.classes import replace

FIRST_COME = "first_come"
ABOUT_FIRST_COME = "A duration only ends its member early"


def is_first_come(module: ir.Module) -> bool:
    """Whether the first of a member and its duration ends both, and some member has one."""
    nodes = (n for each in module.scenarios for n in ir.walk_behaviors(each.body))
    limited = (ir.Serial, ir.Parallel, ir.OneOf, ir.Invoke, ir.InvokeScenario)
    return module.dialect == "carla" and any(
        isinstance(node, limited) and node.duration is not None for node in nodes
    )


class ScenarioWriter:
    """Turns one scenario into its view model and its source map.

    Args:
        scenario: The scenario.
        one_of: Policy of `one_of` in this module.
        first_come: Durations and `until` end with whichever comes first.
        is_main: It is the default scenario of the module.
        classes: Names of the module's scenario classes, by key of the scenario.
        types: All types that the module knows.
        type_methods: The methods of types that are in their classes.
        functions: The modifiers of the user's own that the module has as functions.
        uses: Collects the imports of the module.
        actions: The actions of the user's own.
    """

    def __init__(
        self,
        scenario: ir.Scenario,
        one_of: str,
        first_come: bool,
        is_main: bool,
        classes: NameTable,
        types: TypeTable,
        type_methods: TypeMethods,
        functions: ModifierCalls,
        uses: Uses,
        actions: Iterable[ir.UserAction] = (),
    ) -> None:
        self._actions = actions
        self._source = scenario.span.source
        self._scenario = scenario
        self._one_of = one_of
        self._first_come = first_come
        self._is_main = is_main
        self._classes = classes
        self._names = NameTable(SCENARIO_ATTRIBUTES)
        self._methods = [each for each in scenario.methods if each.name not in type_methods]
        for member in (*scenario.declarations, *self._methods):
            self._names.add(member.name, identifier(member.name))
        self._types = types
        expressions = ExpressionWriter(
            self._names,
            uses.unit,
            uses.name,
            lambda type_: types.class_of((type_,)),
            scenario.methods,
            types.member,
            type_methods,
        )
        self._calls = CallWriter(expressions, uses.name, uses.modifier, functions)
        self._objects = ObjectWriter(expressions, types)
        events = (each for each in scenario.declarations if isinstance(each, ir.Event))
        self._first_implicit_event = next((each for each in events if each.is_implicit), None)
        self.source_map = ScenarioMap(scenario.span.source.name)

    def write(self) -> ScenarioView:
        """Return the view model; afterwards `source_map` is complete."""
        declarations = tuple(
            self._declaration(declaration, is_first=index == 0)
            for index, declaration in enumerate(self._scenario.declarations)
        )
        functions = tuple(
            self._function(method, method.expression)
            for method in self._methods
            if method.expression is not None
        )
        placements = tuple(self._placement(placement) for placement in self._scenario.placements)
        methods = BehaviorTreeBuilder(
            self._calls, self._names, self._classes, self.source_map, self._actions
        ).write(self._scenario)
        return ScenarioView(
            class_name=self._classes[self._scenario.key],
            docstring=tuple(PyDocLine.of(line) for line in self._scenario.comments),
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

    def _attributes(self) -> tuple[StatementView, ...]:
        values: dict[str, str | bool] = {
            "name": self._scenario.name,
            "source": self._scenario.span.source.name,
        }
        if self._one_of != "race":
            values["one_of"] = self._one_of
        if self._first_come:
            values[FIRST_COME] = True
        if self._is_main:
            values["is_main"] = True
        return tuple(
            StatementView(
                name_expression(PyName(name)),
                code(literal(value)),
                comments=comments((ABOUT_FIRST_COME,) if name == FIRST_COME else ()),
            )
            for name, value in values.items()
        )

    def _declaration(self, declaration: ir.Declaration, *, is_first: bool) -> StatementView:
        name = self._names[declaration.name]
        self.source_map.fields[str(name)] = self.source_map.place_of(declaration.span)
        lines = declaration.comments
        if declaration is self._first_implicit_event:
            lines = ("Events that the scenario uses without declaring them",)
        above, behind = apart(lines)
        return StatementView(
            target=self_attribute(name),
            value=self._declared_value(declaration),
            comments=above,
            trailing=behind,
            blank_before=not is_first and self._stands_apart(declaration),
            annotation=self._declared_type(declaration),
        )

    def _stands_apart(self, declaration: ir.Declaration) -> bool:
        """Whether a blank line stands above a declaration in its source, or none of its source."""
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

    def _constraints(self) -> tuple[StatementView, ...]:
        """Write what must hold between the values, below them."""
        write = self._calls.expressions.write
        statements = []
        for index, constraint in enumerate(self._scenario.constraints):
            self.source_map.constraints.append(self.source_map.place_of(constraint.span))
            above, behind = apart(constraint.comments)
            statements.append(
                StatementView(
                    target=None,
                    value=ArgumentView(
                        call=CallView(_self("keep"), (code(write(constraint.expression)),))
                    ),
                    comments=above,
                    trailing=behind,
                    blank_before=index == 0 or bool(constraint.comments),
                )
            )
        return tuple(statements)

    def _coverage(self) -> tuple[StatementView, ...]:
        """Write the values sampled for coverage, below the values."""
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

    def _declared_value(self, declaration: ir.Declaration) -> ArgumentView:
        match declaration:
            case ir.Actor(name=name, lineage=lineage, is_given=True):
                class_ = name_expression(self._types.class_of(lineage))
                call = CallView(_self("required_argument"), (code(literal(name)), code(class_)))
                return ArgumentView(call=call)
            case ir.Actor(name=name, lineage=lineage):
                actor = self._objects.write(lineage, declaration.values)
                if declaration.is_global:
                    return self._shared(name, actor)
                return self._from_invoker("cast", name, actor)
            case ir.Struct():
                return self._struct(declaration)
            case ir.Variable():
                return self._variable(declaration)
            case ir.Parameter():
                return self._parameter(declaration)
            case ir.Event(trigger=trigger):
                arguments = () if trigger is None else self._calls.trigger(trigger)
                arguments += self._event_parameters(declaration.parameters)
                arguments += self._known_as(declaration.name)
                return ArgumentView(call=self._calls.runtime_call("Event", *arguments))

    def _struct(self, struct: ir.Struct) -> ArgumentView:
        """Write an object; it may come from the caller."""
        if struct.value is not None:
            value = code(self._calls.expressions.write(struct.value))
        else:
            value = self._objects.write(struct.lineage, struct.values)
        if struct.is_global:
            return self._shared(struct.name, value)
        return self._from_invoker("argument", struct.name, value)

    def _shared(self, name: str, value: ArgumentView) -> ArgumentView:
        """Write an object that all scenarios of a run share."""
        known_as = code(literal(ir.setting_name(name)))
        return ArgumentView(call=CallView(_self("global_object"), (known_as, value)))

    def _from_invoker(self, method: str, name: str, value: ArgumentView) -> ArgumentView:
        """Write the values that an invoker may hand in instead of the declared ones."""
        return ArgumentView(call=CallView(_self(method), (code(literal(name)), value)))

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
        if parameter.value is not None and parameter.is_fixed:
            return self._fixed(parameter.type, code(write(parameter.value)))
        is_object = parameter.type.element is not None or parameter.type.kind is ir.Kind.ACTOR
        if parameter.value is not None and is_object:
            name, value = code(literal(parameter.name)), code(write(parameter.value))
            return ArgumentView(call=CallView(_self("argument"), (name, value)))
        known_as = ir.setting_name(parameter.name) if parameter.is_global else parameter.name
        arguments = [code(literal(known_as))]
        is_plain = parameter.type.element is None and parameter.type.kind is not ir.Kind.STRUCT
        method = "global_parameter" if parameter.is_global else "parameter"
        if parameter.is_required and not is_plain:
            method = "required_argument"
            arguments.append(code(self._types.annotation(parameter.type)))
        elif parameter.is_required:
            method = "required_global" if parameter.is_global else "required"
            arguments.append(code(self._types.annotation(parameter.type)))
        arguments += [code(write(v)) for v in (parameter.value, parameter.domain) if v is not None]
        if parameter.unit is not None:
            arguments.append(code(written_unit(self._calls, parameter.unit), "unit"))
        return ArgumentView(call=CallView(_self(method), tuple(arguments)))

    def _fixed(self, type_: ir.ValueType, value: ArgumentView) -> ArgumentView:
        """Write a constant; that of an enum so that it may be compared with other members."""
        if type_.kind is not ir.Kind.ENUM:
            return value
        return ArgumentView(call=self._calls.runtime_call("fixed", value))

    def _externals(self) -> tuple[StatementView, ...]:
        """Write the methods that are code of the user: the runtime asks whether they may run."""
        statements = []
        for method in self._methods:
            if method.external is None:
                continue
            name = self._names[method.name]
            path = f"{method.external.module}.{method.external.function}"
            self.source_map.fields[path] = self.source_map.place_of(method.span)
            kind = (
                code(self._types.annotation(method.result)) if method.result is not None else None
            )
            arguments = (code(literal(path)),) if kind is None else (code(literal(path)), kind)
            statements.append(
                StatementView(
                    target=self_attribute(name),
                    value=ArgumentView(call=CallView(_self("external"), arguments)),
                    comments=comments(method.comments),
                )
            )
        return tuple(statements)

    def _function(self, method: ir.Method, body: ir.Expression) -> FunctionView:
        return FunctionView(
            signature=signature(
                self._names[method.name],
                map(self._function_parameter, method.parameters),
                self._types.annotation(method.result),
            ),
            value=self._calls.expressions.write(body),
            comments=comments(method.comments),
        )

    def _function_parameter(self, parameter: ir.MethodParameter) -> str:
        writer = self._calls.expressions
        name = writer.parameter(parameter.name)
        text = f"{name}: {self._types.annotation(parameter.type)}"
        return text if parameter.default is None else f"{text} = {writer.write(parameter.default)}"

    def _placement(self, placement: ir.Placement) -> StatementView:
        self.source_map.placements.append(self.source_map.place_of(placement.span))
        actor = code(self._calls.expressions.field(placement.actor))
        # A placement speaks of the start anyway.
        modifiers = (self._calls.modifier(replace(m, at="all")) for m in placement.modifiers)
        later = (code(literal(True), "throughout"),) if placement.is_throughout else ()
        method = _self("require" if placement.of_map else "place")
        call = CallView(method, (actor, *modifiers, *later))
        return StatementView(None, ArgumentView(call=call), comments(placement.comments))


def _self(name: str) -> PyExpr:
    return self_attribute(PyName(name))
