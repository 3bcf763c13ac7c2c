"""Scenario classes: writers of their parts, initial placement, constraints, methods."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from osc2tx import ir
from osc2tx.backends.py_trees.behaviors import BehaviorTreeBuilder
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
from osc2tx.backends.py_trees.coverage import CoverageWriter
from osc2tx.backends.py_trees.declarations import DeclarationWriter
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.members import Members, event_class_key
from osc2tx.backends.py_trees.modifier_calls import ModifierCalls
from osc2tx.backends.py_trees.naming import NameTable
from osc2tx.backends.py_trees.source_map import ScenarioMap
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import (
    ArgumentView,
    CallView,
    FunctionView,
    MethodView,
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
        members: The members of the classes of the module, by key of the scenario.
        one_of: Policy of `one_of` in this module.
        first_come: The first of duration and `until` ends a member.
        is_main: It is the default scenario of the module.
        classes: Names of the module's scenario classes, by key of the scenario.
        types: All types that the module knows.
        type_methods: The methods of types that are in their classes.
        functions: The user-defined modifiers that are functions of the module.
        uses: Collects the imports of the module.
        actions: The user-defined actions.
    """

    def __init__(
        self,
        scenario: ir.AbstractScenario,
        members: Mapping[str, Members],
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
        self._scenario = scenario
        self._one_of = one_of
        self._first_come = first_come
        self._is_main = is_main
        self._classes = classes
        self._all_members, self._members = members, members[scenario.key]
        self._own, self._names = self._members.own, self._members.names
        self._methods = [each for each in self._own.methods if each.name not in type_methods]
        self._types = types
        expressions = ExpressionWriter(
            self._names,
            uses.unit,
            uses.name,
            lambda type_: types.class_of((type_,)),
            scenario.methods,
            types.member,
            type_methods,
            event_class=self._event_class,
        )
        self._bounded = uses.bounded
        self._calls = CallWriter(expressions, uses.name, uses.modifier, functions)
        self._declarations = DeclarationWriter(scenario, self._members, self._calls, types)
        self.source_map = ScenarioMap(scenario.span.source.name)

    def write(self) -> ScenarioView:
        """Return the view model; afterwards `source_map` is complete."""
        self._note_places()
        own, base = self._own, self._members.base
        functions = tuple(
            self._function(method, method.expression)
            for method in self._methods
            if method.expression is not None
        )
        declare = self._declarations
        ahead = (*self._externals(), *declare.declared(own.ahead), *declare.narrowed())
        values = (*declare.reassigned(), *declare.declared(own.declarations))
        return ScenarioView(
            class_name=self._classes[self._scenario.key],
            base=PyName("Scenario") if base is None else self._classes[base.key],
            is_derived=base is not None,
            docstring=tuple(PyDocLine.of(line) for line in self._scenario.comments),
            attributes=self._attributes(),
            events=declare.events(),
            ahead=ahead,
            declarations=(*values, *self._constraints(), *self._coverage()),
            functions=functions,
            places_besides=not own.places_anew,
            placements=tuple(map(self._placement, own.placements)),
            methods=self._behavior(),
            end_comments=comments(self._scenario.end_comments),
        )

    def _event_class(self, scenario: str, event: str) -> PyExpr:
        """Name the class of an event with parameters that another scenario has."""
        name = self._all_members[scenario].names[event_class_key(event)]
        return PyExpr(f"{self._classes[scenario]}.{name}", Level.ATOM)

    def _note_places(self) -> None:
        """Fill the source map: with all that the scenario has, in the order of a run."""
        found, scenario = self.source_map, self._scenario
        for method in scenario.methods:
            if method.external is not None:
                path = f"{method.external.module}.{method.external.function}"
                found.fields[path] = found.place_of(method.span)
        for declaration in scenario.declarations:
            found.fields[str(self._names[declaration.name])] = found.place_of(declaration.span)
        found.constraints += (found.place_of(each.span) for each in self._members.constraints)
        found.placements += (found.place_of(each.span) for each in scenario.placements)
        if isinstance(scenario, ir.Scenario):
            found.add_nodes(scenario.body)

    def _behavior(self) -> tuple[MethodView, ...]:
        if self._own.body is None or not isinstance(self._scenario, ir.Scenario):
            return ()
        phases = self._members.phases
        return BehaviorTreeBuilder(self._calls, phases, self._classes, self._actions).write(
            self._scenario
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

    def _constraints(self) -> tuple[StatementView, ...]:
        """Write the checks of the values, below them."""
        write = self._calls.expressions.write
        statements = []
        for index, constraint in enumerate(self._own.constraints):
            statements.append(
                StatementView(
                    target=None,
                    value=ArgumentView(
                        call=CallView(_self("keep"), (code(write(constraint.expression)),))
                    ),
                    **around(constraint.comments),
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
                **around(item.comments),
                blank_before=index == 0 or bool(item.comments),
            )
            for index, item in enumerate(self._own.coverage)
        )

    def _externals(self) -> tuple[StatementView, ...]:
        """Write the external methods, for which the runtime requires permission."""
        statements = []
        for method in self._methods:
            if method.external is None:
                continue
            name = self._names[method.name]
            path = f"{method.external.module}.{method.external.function}"
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
            is_bounded=self._bounded(body),
            comments=comments(method.comments),
        )

    def _function_parameter(self, parameter: ir.MethodParameter) -> str:
        writer = self._calls.expressions
        name = writer.parameter(parameter.name)
        text = f"{name}: {self._types.annotation(parameter.type)}"
        return text if parameter.default is None else f"{text} = {writer.write(parameter.default)}"

    def _placement(self, placement: ir.Placement) -> StatementView:
        actor = code(self._calls.expressions.field(placement.actor))
        # A placement mentions the start anyway.
        modifiers = (self._calls.modifier(replace(m, at="all")) for m in placement.modifiers)
        flags = {"throughout": placement.is_throughout, "implied": placement.is_implied}
        later = (code(literal(True), name) for name, is_set in flags.items() if is_set)
        method = _self("require" if placement.of_map else "place")
        call = CallView(method, (actor, *modifiers, *later))
        return StatementView(None, ArgumentView(call=call), comments(placement.comments))


def _self(name: str) -> PyExpr:
    return self_attribute(PyName(name))
