"""Members of a scenario: cast, values, events."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.lowering.behavior.composed_behaviors import Composed, is_placeholder, lineage_of
from osc2tx.lowering.behavior.triggers import boundary_of, event_parameter, lower_trigger
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import (
    LoweringContext,
    Receiver,
    comments_around,
    present,
    statement_comments,
)
from osc2tx.lowering.declarations.fields import FieldLowering
from osc2tx.lowering.placement.carla_paths import is_path, path_declarations, path_members
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.lowering.values.methods import lower_method
from osc2tx.lowering.values.references import alias_of
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.conversions import symbol_of
from osc2tx.syntax import ast


class DeclarationLowering:
    """Lowers the declarations of one scenario.

    Args:
        ctx: The checked program.
        scenario: The scenario.
        statements: Its member statements, inherited ones first.
        constraints: Its constraints.
    """

    def __init__(
        self,
        ctx: LoweringContext,
        scenario: Composed,
        statements: tuple[ast.Statement, ...],
        constraints: ConstraintLowering,
    ) -> None:
        self._ctx = ctx
        self._scenario = scenario
        self._statements = statements
        self._fields = FieldLowering(ctx, constraints)
        self._members: dict[str, sym.Member] = {}
        for symbol in reversed(list(lineage_of(scenario))):
            self._members |= symbol.members

    def lower_methods(self) -> tuple[ir.Method, ...]:
        """Return its own methods; the last declaration of a name is the one that counts.

        External ones that nothing calls are left out: no run needs their functions.
        """
        declared = [s for s in self._statements if isinstance(s, ast.MethodDeclaration)]
        lowered = []
        for name, node in {node.name.text: node for node in declared}.items():
            symbol = self._members.get(name)
            if isinstance(symbol, sym.MethodSymbol) and not self._is_idle(symbol, node):
                lowered.append(lower_method(self._ctx, symbol, statement_comments(node)))
        return present(lowered)

    def _is_idle(self, method: sym.MethodSymbol, node: ast.MethodDeclaration) -> bool:
        """Whether a method is external, and nothing in the program calls one of its name."""
        if not isinstance(node.body, ast.ExternalBody):
            return False
        mentioned = self._ctx.model.references.values()
        return not any(isinstance(m, sym.MethodSymbol) and m.name == method.name for m in mentioned)

    def lower_type_methods(self) -> tuple[ir.Method, ...]:
        """Return the methods of types that are called so far, and those that they call.

        They are in the order of the source.
        """
        lowered: dict[str, ir.Method | None] = {}
        while missing := [name for name in self._ctx.state.methods if name not in lowered]:
            for name in missing:
                symbol = self._ctx.state.methods[name]
                comments = () if symbol.node is None else statement_comments(symbol.node)
                lowered[name] = lower_method(self._ctx, symbol, comments)
        methods = present(list(lowered.values()))
        return tuple(sorted(methods, key=lambda m: (m.span.source.name, m.span.line)))

    def lower_object_variables(self) -> tuple[ir.Variable, ...]:
        """Return the sampled variables of objects that were read so far, and those that they read.

        Each is a variable of the scenario that reads it: it samples while that runs.
        """
        lowered: dict[str, ir.Variable | None] = {}
        while missing := [name for name in self._ctx.state.object_variables if name not in lowered]:
            for name in missing:
                field, object_ = self._ctx.state.object_variables[name]
                assert isinstance(field.owner, sym.ActorSymbol | sym.StructSymbol)
                inside = self._ctx.inside(Receiver(field.owner, object_))
                node = field.node
                assert isinstance(node, ast.VariableDeclaration)
                lowered[name] = self._variable(inside, field, node, statement_comments(node), name)
        return present(list(lowered.values()))

    def lower(self) -> tuple[ir.Declaration, ...]:
        """Return the declarations in source order, implicit events last."""
        declared = [d for statement in self._statements for d in self._statement(statement)]
        declared.extend(self._implicit_events())
        return tuple(declared)

    def _statement(self, statement: ast.Statement) -> Iterator[ir.Declaration]:
        match statement:
            case ast.ParameterDeclaration() | ast.VariableDeclaration():
                comments = _comments_of(statement)
                for name in statement.names:
                    yield from self._declared(statement, name, comments)
                    comments = ()
            case ast.EventDeclaration():
                event = self._event(statement)
                if event is not None:
                    yield event
            case _:
                pass  # constraints, coverage, behavior and modifiers are lowered elsewhere

    def _declared(
        self,
        statement: ast.ParameterDeclaration | ast.VariableDeclaration,
        name: ast.Name,
        comments: tuple[str, ...],
    ) -> tuple[ir.Declaration, ...]:
        symbol = self._members.get(name.text)
        if isinstance(symbol, sym.FieldSymbol) and is_path(symbol.type):
            members = path_members(self._ctx, self._statements)
            return path_declarations(self._ctx, symbol, members, comments)
        if isinstance(symbol, sym.FieldSymbol) and alias_of(self._ctx, symbol) is not None:
            return ()
        if isinstance(symbol, sym.FieldSymbol) and is_placeholder(symbol_of(symbol.type)):
            return ()
        return present([self._field(statement, name, comments)])

    def _field(
        self,
        statement: ast.ParameterDeclaration | ast.VariableDeclaration,
        name: ast.Name,
        comments: tuple[str, ...],
    ) -> ir.Declaration | None:
        symbol = self._members.get(name.text)
        if not isinstance(symbol, sym.FieldSymbol):
            return None
        if isinstance(statement, ast.VariableDeclaration) and statement.default is not None:
            return self._variable(self._ctx, symbol, statement, comments, symbol.name)
        return self._fields.lower(symbol, name.span, comments)

    def _variable(
        self,
        ctx: LoweringContext,
        field: sym.FieldSymbol,
        node: ast.VariableDeclaration,
        comments: tuple[str, ...],
        name: str,
    ) -> ir.Variable | None:
        sample = None
        initial: ast.Expression | None
        if isinstance(node.default, ast.SampleExpression):
            sample, initial = self._sample(ctx, node.default), node.default.default
            if sample is None:
                return None
        else:
            initial = node.default
        value = None if initial is None else lower_expression(ctx, initial)
        if initial is not None and value is None:
            return None
        if value is not None and ir.is_live(value):
            self._ctx.unsupported(
                "OSC501",
                value.span,
                "the initial value of a variable cannot depend on the state of the world",
                help="take it at an event: `sample(expression, @event)`",
            )
            return None
        return ir.Variable(
            name=name,
            span=node.span,
            comments=comments,
            type=lower_type(field.type),
            value=value,
            sample=sample,
        )

    def _sample(self, ctx: LoweringContext, node: ast.SampleExpression) -> ir.Sample | None:
        moment = boundary_of(ctx, node.event)
        trigger = ir.Moment(moment) if moment else lower_trigger(ctx, node.event)
        expression = lower_expression(ctx, node.expression)
        if trigger is None or expression is None:
            return None
        return ir.Sample(expression=expression, trigger=trigger)

    def _event(self, node: ast.EventDeclaration) -> ir.Event | None:
        symbol = self._members.get(node.name.text)
        if isinstance(symbol, sym.EventSymbol) and symbol.node is not node:
            return None  # a more derived scenario declares it again
        parameters = symbol.parameters if isinstance(symbol, sym.EventSymbol) else ()
        trigger = None
        if node.specification is not None and boundary_of(self._ctx, node.specification) is None:
            trigger = lower_trigger(self._ctx, node.specification)
            if trigger is None:
                return None
        return ir.Event(
            name=node.name.text,
            span=node.span,
            comments=statement_comments(node),
            trigger=trigger,
            is_implicit=False,
            parameters=tuple(event_parameter(self._ctx, p) for p in parameters),
        )

    def _implicit_events(self) -> Iterator[ir.Event]:
        """Return the undeclared events that a dialect allows a scenario to use."""
        for member in self._scenario.members.values():
            if isinstance(member, sym.EventSymbol) and member.is_implicit:
                yield ir.Event(name=member.name, span=member.span, trigger=None, is_implicit=True)


def _comments_of(node: ast.ParameterDeclaration | ast.VariableDeclaration) -> tuple[str, ...]:
    """Return the comment lines of a declaration; nothing but them is left of a `remove_default`."""
    rules = node.constraints if isinstance(node, ast.ParameterDeclaration) else ()
    removals = (each for each in rules if isinstance(each, ast.RemoveDefault))
    said = (line for each in removals for line in statement_comments(each))
    return comments_around(statement_comments(node), said)
