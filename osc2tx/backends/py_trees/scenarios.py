"""Scenario classes: declarations, initial placement, behavior."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

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
from osc2tx.backends.py_trees.members import Members
from osc2tx.backends.py_trees.modifier_calls import ModifierCalls
from osc2tx.backends.py_trees.naming import NameTable
from osc2tx.backends.py_trees.objects import ObjectWriter
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
        members: What its class has, and how it is called.
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
        scenario: ir.AbstractScenario,
        members: Members,
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
        self._members, self._own, self._names = members, members.own, members.names
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
        )
        self._calls = CallWriter(expressions, uses.name, uses.modifier, functions)
        self._objects = ObjectWriter(expressions, types)
        events = (each for each in scenario.declarations if isinstance(each, ir.Event))
        self._first_implicit_event = next((each for each in events if each.is_implicit), None)
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
        statements = (*self._externals(), *self._declared(own.ahead), *self._narrowed())
        after = (*self._reassigned(), *self._declared(own.declarations))
        return ScenarioView(
            class_name=self._classes[self._scenario.key],
            base=PyName("Scenario") if base is None else self._classes[base.key],
            is_derived=base is not None,
            docstring=tuple(PyDocLine.of(line) for line in self._scenario.comments),
            attributes=self._attributes(),
            ahead=statements,
            declarations=(*after, *self._constraints(), *self._coverage()),
            functions=functions,
            places_besides=not own.places_anew,
            placements=tuple(map(self._placement, own.placements)),
            methods=self._behavior(),
            end_comments=comments(self._scenario.end_comments),
        )

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

    def _declared(self, declarations: Sequence[ir.Declaration]) -> tuple[StatementView, ...]:
        return tuple(
            self._declaration(each, is_first=index == 0) for index, each in enumerate(declarations)
        )

    def _narrowed(self) -> tuple[StatementView, ...]:
        """Write what constraints leave of declarations of the base, before it declares them."""
        return tuple(
            StatementView(
                target=None,
                value=self._narrowing(here, there),
                comments=comments(_lines_besides(here, there)),
            )
            for there, here in self._own.narrowed
            if not _is_assigned(there)
        )

    def _reassigned(self) -> tuple[StatementView, ...]:
        """Write constants of the base that are written otherwise here."""
        return tuple(
            StatementView(
                target=self_attribute(self._names[here.name]),
                value=self._declared_value(here),
                comments=comments(_lines_besides(here, there)),
            )
            for there, here in self._own.narrowed
            if _is_assigned(there)
        )

    def _narrowing(self, declaration: ir.Declaration, there: ir.Declaration) -> ArgumentView:
        """Write the call that narrows a declaration; what reads the base is computed by it."""
        name = code(literal(ir.setting_name(declaration.name)))
        arguments: tuple[ArgumentView, ...]
        match declaration:
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
        ahead = {each.name for each in self._own.ahead}
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
        for index, constraint in enumerate(self._own.constraints):
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
            for index, item in enumerate(self._own.coverage)
        )

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
                arguments += self._event_parameters(declaration.parameters)
                arguments += self._known_as(declaration.name)
                return ArgumentView(call=self._calls.runtime_call("Event", *arguments))

    def _value_of(self, declared: ir.Actor | ir.Struct) -> ArgumentView:
        """Write an object: what it equals, or the call that makes it."""
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
        """Write what a parameter may be: its value, or type or default, domain and unit."""
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

    def _externals(self) -> tuple[StatementView, ...]:
        """Write the methods that are code of the user: the runtime asks whether they may run."""
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
            comments=comments(method.comments),
        )

    def _function_parameter(self, parameter: ir.MethodParameter) -> str:
        writer = self._calls.expressions
        name = writer.parameter(parameter.name)
        text = f"{name}: {self._types.annotation(parameter.type)}"
        return text if parameter.default is None else f"{text} = {writer.write(parameter.default)}"

    def _placement(self, placement: ir.Placement) -> StatementView:
        actor = code(self._calls.expressions.field(placement.actor))
        # A placement speaks of the start anyway.
        modifiers = (self._calls.modifier(replace(m, at="all")) for m in placement.modifiers)
        later = (code(literal(True), "throughout"),) if placement.is_throughout else ()
        method = _self("require" if placement.of_map else "place")
        call = CallView(method, (actor, *modifiers, *later))
        return StatementView(None, ArgumentView(call=call), comments(placement.comments))


def _is_assigned(declaration: ir.Declaration) -> bool:
    """Whether a class assigns a declaration, without a call that has its name."""
    return isinstance(declaration, ir.Parameter) and declaration.is_fixed


def _lines_besides(here: ir.Declaration, there: ir.Declaration) -> tuple[str, ...]:
    """Return the comment lines of what narrows a declaration."""
    return tuple(line for line in here.comments if line not in there.comments)


def _deferred(argument: ArgumentView, late: Callable[[PyExpr], PyExpr]) -> ArgumentView:
    """Return an argument as a function without parameters that gives it."""
    if argument.call is not None and argument.call.callee is not None:
        callee = PyExpr(f"lambda: {argument.call.callee}", Level.LAMBDA)
        return replace(argument, call=replace(argument.call, callee=callee))
    return argument if argument.code is None else replace(argument, code=late(argument.code))


def _self(name: str) -> PyExpr:
    return self_attribute(PyName(name))
