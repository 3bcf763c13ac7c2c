"""Members of a scenario: cast, values, events."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.constraints import Bound, lower_constraints
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.expressions import lower_expression, lower_type
from osc2tx.lowering.triggers import lower_trigger
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast


class DeclarationLowering:
    """Lowers the declarations of one scenario.

    Args:
        ctx: The checked program.
        scenario: The scenario.
        statements: Its member statements, inherited ones first.
    """

    def __init__(
        self,
        ctx: LoweringContext,
        scenario: sym.ScenarioSymbol,
        statements: tuple[ast.Statement, ...],
    ) -> None:
        """See the class."""
        self._ctx = ctx
        self._scenario = scenario
        self._statements = statements
        own = tuple(s for s in statements if isinstance(s, ast.KeepConstraint))
        self._scenario_bounds = lower_constraints(ctx, own)

    def lower_methods(self) -> tuple[ir.Method, ...]:
        """Return the methods whose body is an expression; others are refused where called."""
        declared = [s for s in self._statements if isinstance(s, ast.MethodDeclaration)]
        last = {node.name.text: node for node in declared}
        return present([self._method(node) for node in last.values()])

    def lower_globals(self) -> tuple[ir.Parameter, ...]:
        """Return the global parameters that were used so far, as parameters of the scenario."""
        lowered: dict[str, ir.Parameter | None] = {}
        while missing := [name for name in self._ctx.globals if name not in lowered]:
            for name in missing:  # one global may be defined by another
                symbol = self._ctx.globals[name]
                lowered[name] = self._parameter(symbol, symbol.span, self._global_comments(symbol))
        return tuple(
            replace(parameter, is_global=True)
            for parameter in present(list(reversed(lowered.values())))
        )

    def _global_comments(self, symbol: sym.FieldSymbol) -> tuple[str, ...]:
        statements = (s for file in self._ctx.model.files for s in file.statements)
        shared = (s for s in statements if isinstance(s, ast.GlobalParameter))
        return next((statement_comments(s) for s in shared if s.parameter is symbol.node), ())

    def lower(self) -> tuple[ir.Declaration, ...]:
        """Return the declarations in source order, implicit events last."""
        declared = [d for statement in self._statements for d in self._statement(statement)]
        declared.extend(self._implicit_events())
        self._refuse_unused_bounds({declaration.name for declaration in declared})
        return tuple(declared)

    def _statement(self, statement: ast.Statement) -> Iterator[ir.Declaration]:
        match statement:
            case ast.ParameterDeclaration() | ast.VariableDeclaration():
                comments = statement_comments(statement)
                for name in statement.names:
                    declaration = self._field(statement, name, comments)
                    comments = ()
                    if declaration is not None:
                        yield declaration
            case ast.EventDeclaration():
                event = self._event(statement)
                if event is not None:
                    yield event
            case ast.RemoveDefault() | ast.CoverageDeclaration():
                word = statement.span.text.split("(")[0].strip()
                self._ctx.unsupported("OSC501", statement.span, f"`{word}` is not supported yet")
            case _:
                pass  # constraints, behavior and modifiers are lowered elsewhere

    def _field(
        self,
        statement: ast.ParameterDeclaration | ast.VariableDeclaration,
        name: ast.Name,
        comments: tuple[str, ...],
    ) -> ir.Declaration | None:
        symbol = self._scenario_member(name.text)
        if not isinstance(symbol, sym.FieldSymbol):
            return None
        if isinstance(statement, ast.VariableDeclaration):
            return self._variable(symbol, statement, comments)
        match symbol.type:
            case types.ActorType(symbol=actor):
                return ir.Actor(
                    name=symbol.name,
                    span=name.span,
                    comments=comments,
                    type=actor.name,
                    lineage=lineage(actor),
                    values=self._values(symbol),
                )
            case types.StructType(symbol=struct):
                return ir.Struct(
                    name=symbol.name,
                    span=name.span,
                    comments=comments,
                    type=struct.name,
                    values=self._values(symbol),
                )
            case types.PrimitiveType() | types.PhysicalType() | types.EnumType():
                return self._parameter(symbol, name.span, comments)
            case _:
                self._ctx.unsupported(
                    "OSC501", name.span, f"a field of type `{symbol.type}` is not supported yet"
                )
                return None

    def _scenario_member(self, name: str) -> sym.Member | None:
        scenario: sym.ScenarioSymbol | None = self._scenario
        while scenario is not None:
            if name in scenario.members:
                return scenario.members[name]
            scenario = scenario.base
        return None

    def _bounds(self, field: sym.FieldSymbol) -> tuple[Bound, ...]:
        own = lower_constraints(self._ctx, field.constraints)
        return (*own, *(b for b in self._scenario_bounds if b.root == field.name))

    def _refuse_unused_bounds(self, names: set[str]) -> None:
        for bound in self._scenario_bounds:
            if bound.root not in names:
                self._ctx.unsupported(
                    "OSC502", bound.span, "this constraint is about no field of the scenario"
                )

    def _values(self, field: sym.FieldSymbol) -> tuple[ir.FieldValue, ...]:
        """Return what the constraints fix about an object; the last word on a path wins."""
        values: dict[tuple[str, ...], ir.FieldValue] = {}
        for bound in self._bounds(field):
            if isinstance(bound.value, ir.RangeValue) or not bound.path:
                self._ctx.unsupported(
                    "OSC502", bound.span, "only a fixed value is supported for a member yet"
                )
                continue
            values[bound.path] = ir.FieldValue(
                path=bound.path, value=bound.value, span=bound.span, comments=bound.comments
            )
        return tuple(values.values())

    def _parameter(
        self, field: sym.FieldSymbol, span: Span, comments: tuple[str, ...]
    ) -> ir.Parameter | None:
        """Apply default and constraints in the order of the text (§7.3.11)."""
        value: ir.Expression | None = None
        domain: ir.RangeValue | None = None
        is_fixed = False
        if field.default is not None and not isinstance(field.default, ast.SampleExpression):
            value = lower_expression(self._ctx, field.default)
        for bound in self._bounds(field):
            comments = (*comments, *bound.comments)
            if isinstance(bound.value, ir.RangeValue):
                domain = bound.value
                value = value if is_fixed else None
            elif not is_fixed:
                value = bound.value
                is_fixed = not bound.is_default
        if value is None and domain is None:
            self._ctx.unsupported(
                "OSC501",
                span,
                f"parameter `{field.name}` has neither value nor range",
                help="give it a default, `= value`, or a range, `with: keep(it in [low..high])`",
            )
            return None
        return ir.Parameter(
            name=field.name,
            span=span,
            comments=comments,
            type=lower_type(field.type),
            value=value,
            domain=domain,
            is_fixed=is_fixed,
        )

    def _variable(
        self, field: sym.FieldSymbol, node: ast.VariableDeclaration, comments: tuple[str, ...]
    ) -> ir.Variable | None:
        if node.default is None:
            self._ctx.unsupported(
                "OSC501", node.span, "a variable without initial value is not supported yet"
            )
            return None
        sample = None
        initial: ast.Expression | None
        if isinstance(node.default, ast.SampleExpression):
            sample, initial = self._sample(node.default), node.default.default
            if sample is None:
                return None
        else:
            initial = node.default
        value = None if initial is None else lower_expression(self._ctx, initial)
        if initial is not None and value is None:
            return None
        if value is not None and ir.is_live(value):
            self._ctx.unsupported(
                "OSC501",
                value.span,
                "the initial value of a variable cannot depend on the state of the world",
            )
            return None
        return ir.Variable(
            name=field.name,
            span=node.span,
            comments=comments,
            type=lower_type(field.type),
            value=value,
            sample=sample,
        )

    def _sample(self, node: ast.SampleExpression) -> ir.Sample | None:
        trigger = lower_trigger(self._ctx, node.event)
        expression = lower_expression(self._ctx, node.expression)
        if trigger is None or expression is None:
            return None
        return ir.Sample(expression=expression, trigger=trigger)

    def _method(self, node: ast.MethodDeclaration) -> ir.Method | None:
        symbol = self._scenario_member(node.name.text)
        if not isinstance(symbol, sym.MethodSymbol) or not isinstance(
            node.body, ast.ExpressionBody
        ):
            return None
        expression = lower_expression(self._ctx, node.body.expression)
        if expression is None:
            return None
        return ir.Method(
            name=symbol.name,
            span=node.span,
            parameters=tuple(self._method_parameter(p) for p in symbol.parameters),
            result=lower_type(symbol.result),
            expression=expression,
            comments=statement_comments(node),
        )

    def _method_parameter(self, parameter: sym.ParameterSymbol) -> ir.MethodParameter:
        default = parameter.default
        return ir.MethodParameter(
            name=parameter.name,
            type=lower_type(parameter.type),
            default=None if default is None else lower_expression(self._ctx, default),
        )

    def _event(self, node: ast.EventDeclaration) -> ir.Event | None:
        symbol = self._scenario_member(node.name.text)
        parameters = symbol.parameters if isinstance(symbol, sym.EventSymbol) else ()
        trigger = None
        if node.specification is not None:
            trigger = lower_trigger(self._ctx, node.specification)
            if trigger is None:
                return None
        return ir.Event(
            name=node.name.text,
            span=node.span,
            comments=statement_comments(node),
            trigger=trigger,
            is_implicit=False,
            parameters=tuple(self._method_parameter(p) for p in parameters),
        )

    def _implicit_events(self) -> Iterator[ir.Event]:
        """Return the events that a dialect lets a scenario use without declaration."""
        for member in self._scenario.members.values():
            if isinstance(member, sym.EventSymbol) and member.is_implicit:
                yield ir.Event(name=member.name, span=member.span, trigger=None, is_implicit=True)


def lineage(actor: sym.ActorSymbol) -> tuple[str, ...]:
    """Return an actor type and its ancestors, most derived first."""
    names = []
    current: sym.ActorSymbol | None = actor
    while current is not None:
        names.append(current.name)
        current = current.base
    return tuple(names)
