"""Second half of the resolution pass: the bodies of types, member by member."""

from __future__ import annotations

from osc2tx.diagnostics import Span
from osc2tx.semantics.assignability import check_value
from osc2tx.semantics.bodies.behaviors import check_do_member, check_on, resolve_label
from osc2tx.semantics.bodies.constraints import check_keep, check_remove_default
from osc2tx.semantics.bodies.coverage import check_coverage
from osc2tx.semantics.bodies.events import check_event
from osc2tx.semantics.bodies.modifiers import check_modifier
from osc2tx.semantics.builtins import BEHAVIOR
from osc2tx.semantics.declarations.inheritance_conditions import check_inheritance_condition
from osc2tx.semantics.names.scenario_runner import note_runner_event
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    BehaviorSymbol,
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    MethodSymbol,
    ModifierSymbol,
    PrimitiveSymbol,
    ScenarioSymbol,
    TypeSymbol,
)
from osc2tx.semantics.types import ERROR, BehaviorType, PrimitiveType, Type
from osc2tx.syntax import ast


def check_bodies(r: Resolution) -> None:
    """Check the declarations of the layer in bodies of types, its own and extended ones."""
    owners = r.scope.own_types()
    for owner in owners:
        for member in _labels(owner):
            if member.type == ERROR:
                env = environment_of(r, owner, _statement_of(r, owner, member))
                resolve_label(r, member, env)
    for owner in owners:
        check_inheritance_condition(r, owner)
        for statement in owner.statements:
            if statement not in r.scope.contexts:
                continue  # of the layer below
            _check_statement(r, owner, statement, environment_of(r, owner, statement))
        _check_single_do(r, owner)
    for symbol in r.scope.declared:
        if isinstance(symbol, FieldSymbol) and symbol.node is not None:
            env = Environment(r.scope.context_of(symbol.node))
            _check_field(r, symbol.node, symbol.type, env)


def _labels(owner: TypeSymbol) -> list[LabelSymbol]:
    """Return the labels of a type; those last whose type depends on another one's."""
    found = [member for member in owner.members.values() if isinstance(member, LabelSymbol)]
    names = {label.name for label in found}

    def asks_another(label: LabelSymbol) -> bool:
        actor = label.node.actor if isinstance(label.node, ast.Invocation) else None
        while isinstance(actor, ast.MemberAccess):
            actor = actor.base
        return isinstance(actor, ast.NameExpression) and actor.name.text in names

    return sorted(found, key=asks_another)


def _statement_of(r: Resolution, owner: TypeSymbol, label: LabelSymbol) -> ast.Statement:
    for statement in owner.statements:
        if statement.span.start <= label.span.start < statement.span.end:
            return statement
    return label.node


def environment_of(r: Resolution, owner: TypeSymbol, statement: ast.Statement) -> Environment:
    """Return the environment of a member of a type."""
    actor: ActorSymbol | None = owner.actor if isinstance(owner, BehaviorSymbol) else None
    it: Type | None = None
    invoked: BehaviorSymbol | None = None
    if isinstance(owner, ModifierSymbol):
        it = BehaviorType(owner.target or BEHAVIOR)
    elif isinstance(owner, PrimitiveSymbol):
        it = PrimitiveType(owner.name)
    return Environment(r.scope.context_of(statement), owner, it, actor, invoked)


def _check_statement(
    r: Resolution, owner: TypeSymbol, node: ast.Statement, env: Environment
) -> None:
    match node:
        case ast.ParameterDeclaration() | ast.VariableDeclaration():
            _check_field(r, node, r.types.get(node.type, ERROR), env)
        case ast.EventDeclaration():
            _check_event_declaration(r, node, env)
        case ast.MethodDeclaration():
            _check_method(r, owner, node, env)
        case ast.KeepConstraint() | ast.RemoveDefault() | ast.CoverageDeclaration():
            _check_constraint(r, node, env)
        case ast.ModifierApplication():
            _check_applied_modifier(r, owner, node, env)
        case ast.DoDirective():
            check_do_member(r, node.member, env)
        case ast.OnDirective():
            check_on(r, node, env)
        case _:
            return


def _check_applied_modifier(
    r: Resolution, owner: TypeSymbol, node: ast.ModifierApplication, env: Environment
) -> None:
    match owner:
        case ModifierSymbol():
            is_open = owner.target is None
            check_modifier(r, node, env, owner.target, owner.actor, is_open=is_open)
        case ScenarioSymbol() | ActionSymbol():
            is_member = isinstance(owner, ScenarioSymbol)
            check_modifier(r, node, env, owner, env.actor, is_member=is_member)
        case ActorSymbol():
            check_modifier(r, node, env, None, owner, is_member=True)
        case _:
            check_modifier(r, node, env, None, None)


def _check_field(
    r: Resolution,
    node: ast.ParameterDeclaration | ast.VariableDeclaration,
    type_: Type,
    env: Environment,
) -> None:
    what = f"`{node.names[0].text}`"
    match node.default:
        case None:
            pass
        case ast.SampleExpression() as sample:
            inner = check_event(r, sample.event, env)
            check_value(r, sample.expression, type_, inner, what)
            if sample.default is not None:
                check_value(r, sample.default, type_, env, what)
        case expression:
            check_value(r, expression, type_, env, what)
    if isinstance(node, ast.VariableDeclaration) or not node.constraints:
        return
    inner = env.with_it(type_)
    for constraint in node.constraints:
        _check_constraint(r, constraint, inner)


def _check_constraint(
    r: Resolution,
    node: ast.KeepConstraint | ast.RemoveDefault | ast.CoverageDeclaration,
    env: Environment,
) -> None:
    match node:
        case ast.KeepConstraint():
            check_keep(r, node, env)
        case ast.RemoveDefault():
            check_remove_default(r, node, env)
        case ast.CoverageDeclaration():
            check_coverage(r, node, env)


def _check_event_declaration(r: Resolution, node: ast.EventDeclaration, env: Environment) -> None:
    note_runner_event(r, node)
    symbol = env.owner.members.get(node.name.text) if env.owner else None
    for index, parameter in enumerate(node.parameters):
        if parameter.default is not None and isinstance(symbol, EventSymbol):
            type_ = symbol.parameters[index].type
            check_value(r, parameter.default, type_, env, f"`{parameter.name}`")
    if node.specification is None:
        return
    if node.parameters:
        r.report(
            "OSC320",
            node.specification.span,
            "an event with parameters cannot have a specification",
        )
    check_event(r, node.specification, env)


def _check_method(
    r: Resolution, owner: TypeSymbol, node: ast.MethodDeclaration, env: Environment
) -> None:
    symbol = _declared_by(r, owner, node)
    if symbol is None:
        return
    for parameter in symbol.parameters:
        if parameter.default is not None:
            check_value(r, parameter.default, parameter.type, env, f"`{parameter.name}`")
    inner = env.with_locals(symbol.parameters)
    match node.body:
        case ast.ExpressionBody(expression=expression):
            if node.result is None:
                r.type_of(expression, inner)
            else:
                check_value(r, expression, symbol.result, inner, "the result")
        case ast.ExternalBody(path=path, arguments=arguments):
            if path[0] == "osc":
                _report_reserved(r, node.body.span, ".".join(path))
            for argument in arguments:
                r.type_of(argument.value, inner)
        case ast.UndefinedBody():
            pass


def _declared_by(
    r: Resolution, owner: TypeSymbol, node: ast.MethodDeclaration
) -> MethodSymbol | None:
    """Return the method that a declaration makes, also one that an extension replaces."""
    for member in owner.named(node.name.text):
        method = member if isinstance(member, MethodSymbol) else None
        while method is not None:
            if method.node is node:
                return method
            method = r.scope.overridden.get(method)
    return None


def _report_reserved(r: Resolution, span: Span, path: str) -> None:
    r.report(
        "OSC216",
        span,
        f"`{path}` begins with `osc`, which is reserved for the standard",
        help="name what your tool offers, such as `python(…)`",
    )


def _check_single_do(r: Resolution, owner: TypeSymbol) -> None:
    """Check that a behavior has one effective `do` (§7.3.13)."""
    if not isinstance(owner, ScenarioSymbol | ActionSymbol):
        return
    found = [
        statement
        for ancestor in reversed(list(supertypes(owner)))
        for statement in ancestor.statements
        if isinstance(statement, ast.DoDirective)
    ]
    own = [s for s in found if s in owner.statements]
    for statement in found[1:]:
        if statement not in own:
            continue
        span = type(statement.span)(
            statement.span.source, statement.span.start, statement.span.start + len("do")
        )
        if r.relaxes(
            "OSC602",
            span,
            f"`{owner.name}` has several `do`; they are run one after the other",
            key=owner.name,
            help="write one `do serial` around them",
        ):
            continue
        r.report(
            "OSC401",
            span,
            f"`{owner.name}` has more than one `do`",
            help="write one `do serial` around them",
        )
