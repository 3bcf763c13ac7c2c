"""Invocations, compositions and directives (§7.3.13)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from osc2tx.diagnostics.fixes import Help
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.assignability import check_duration, check_value
from osc2tx.semantics.bodies.binding import bind_behavior, bind_call, misplaced_of, type_arguments
from osc2tx.semantics.bodies.constraints import check_keep, check_remove_default
from osc2tx.semantics.bodies.events import check_event, resolve_event_name
from osc2tx.semantics.bodies.modifiers import check_modifier
from osc2tx.semantics.builtins import COMPOSITION, COMPOSITION_FIELDS, DIRECTIVE
from osc2tx.semantics.conversions import type_of_owner
from osc2tx.semantics.declarations.resolve_types import (
    choose,
    find_behavior,
    report_modifier,
    report_unknown_behavior,
)
from osc2tx.semantics.expressions.methods import resolve_call, type_itself
from osc2tx.semantics.names.colloquial_names import OUTPUT
from osc2tx.semantics.names.member_lookup import lookup_value
from osc2tx.semantics.names.unfit_types import actions_on, described, hidden_type
from osc2tx.semantics.names.unknown_names import report_unimported
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import CallableBehavior
from osc2tx.semantics.symbols import ActionSymbol, ActorSymbol, EventSymbol, LabelSymbol, TypeSymbol
from osc2tx.semantics.types import ERROR, OBJECT, ActorType, BehaviorType, Type
from osc2tx.syntax import ast

COMPOSITIONS = frozenset(operator.value for operator in ast.CompositionOperator)


def resolve_label(r: Resolution, label: LabelSymbol, env: Environment) -> None:
    """Give a label the type of its member."""
    match label.node:
        case ast.Invocation():
            callee = resolve_invocation(r, label.node, env)
            label.type = BehaviorType(callee) if callee else ERROR
        case ast.Composition():
            label.type = BehaviorType(COMPOSITION)
        case ast.WaitDirective() | ast.EmitDirective() | ast.CallDirective():
            label.type = BehaviorType(DIRECTIVE)
        case _:
            assert_never(label.node)


def check_do_member(r: Resolution, node: ast.BehaviorMember, env: Environment) -> None:
    """Check a member of a `do` tree."""
    if node.label is not None and node.label.text in COMPOSITIONS:
        word = node.label.text
        r.report(
            "OSC416",
            node.label.span,
            f"`{word}:` before a member on the same line is a label, not a composition",
            help=f"end the line behind `{word}:`, and indent the members below it",
        )
    match node:
        case ast.Composition():
            _check_composition(r, node, env)
        case ast.Invocation():
            _check_invocation(r, node, env)
        case ast.WaitDirective():
            check_event(r, node.event, env)
        case ast.EmitDirective():
            check_emit(r, node, env)
        case ast.CallDirective():
            resolve_call(r, node, node.method, env)
        case _:
            assert_never(node)


def check_on(r: Resolution, node: ast.OnDirective, env: Environment) -> None:
    """Check an `on` directive; its body sees the event field."""
    inner = check_event(r, node.event, env)
    for member in node.members:
        check_do_member(r, member, inner)


def check_emit(r: Resolution, node: ast.EmitDirective, env: Environment) -> None:
    """Check `emit event(arguments)`."""
    symbol = resolve_event_name(r, node.event, env)
    if isinstance(symbol, EventSymbol):
        r.references[node.event] = symbol
        bind_call(r, node, symbol, None, node.event.span, env)
        return
    type_arguments(r, node.arguments, env)
    if symbol is not None:
        r.report(
            "OSC316",
            node.event.span,
            f"`{node.event}` is not an event",
            labels=declared_here(symbol),
        )


def _check_composition(r: Resolution, node: ast.Composition, env: Environment) -> None:
    parallel = node.operator is ast.CompositionOperator.PARALLEL
    names = list(COMPOSITION_FIELDS) if parallel else ["duration"]
    positional = "overlap" if parallel else "duration"
    seen: set[str] = set()
    misplaced = misplaced_of(node.arguments)
    for index, argument in enumerate(node.arguments):
        if argument in misplaced:
            type_arguments(r, [argument], env)
            continue
        if argument.name is None and index > 0:
            r.report(
                "OSC405", argument.span, f"`{node.operator.value}` takes one positional argument"
            )
            type_arguments(r, [argument], env)
            continue
        name = argument.name.text if argument.name else positional
        _check_composition_argument(r, node, argument, name, names, env)
        if name in seen:
            r.report("OSC403", argument.span, f"`{name}` is given twice")
        seen.add(name)
    for member in node.members:
        check_do_member(r, member, env)
    inner = env.with_it(BehaviorType(COMPOSITION))
    check_with(r, node.with_members, inner, None, env.actor, is_composition=True)
    if "duration" in seen:
        _note_first_come(r, node)


def _check_composition_argument(
    r: Resolution,
    node: ast.Composition,
    argument: ast.Argument,
    name: str,
    names: Sequence[str],
    env: Environment,
) -> None:
    if name not in names:
        r.report(
            "OSC402",
            (argument.name or argument).span,
            f"`{node.operator.value}` has no parameter `{name}`",
            help=name_meant(argument.name.span, names) if argument.name else None,
        )
        type_arguments(r, [argument], env)
        return
    parameter = COMPOSITION_FIELDS[name]
    if argument.name is not None:
        r.references[argument.name] = parameter
    if name == "overlap":
        check_value(r, argument.value, parameter.type, env, "`overlap`")
    else:
        check_duration(r, argument.value, env)


def _check_invocation(r: Resolution, node: ast.Invocation, env: Environment) -> None:
    callee = resolve_invocation(r, node, env)
    actor = _actor_of(r, node, env)
    if callee is None:
        type_arguments(r, node.arguments, env)
        check_with(r, node.with_members, env.with_it(ERROR), None, actor)
        return
    bind_behavior(r, node, callee, env)
    inner = Environment(
        context=env.context,
        owner=env.owner,
        it=type_of_owner(callee),
        actor=env.actor,
        invoked=callee,
        locals=env.locals,
    )
    check_with(r, node.with_members, inner, callee, actor)
    if any(each.name is not None and each.name.text == "duration" for each in node.arguments):
        _note_first_come(r, node)


def _note_first_come(r: Resolution, node: ast.Invocation | ast.Composition) -> None:
    """Warn that the first of a duration and an `until` ends a member in the dialect."""
    for member in node.with_members:
        if isinstance(member, ast.UntilDirective):
            r.relaxes(
                "OSC623",
                member.event.span,
                "this and the duration end it, whichever comes first",
                key=str(member.event.span.start),
            )


def _actor_of(r: Resolution, node: ast.Invocation, env: Environment) -> ActorSymbol | None:
    if node.actor is None:
        return env.actor
    type_ = r.type_of(node.actor, env, OBJECT)
    return type_.symbol if isinstance(type_, ActorType) else None


def resolve_invocation(
    r: Resolution, node: ast.Invocation, env: Environment
) -> CallableBehavior | None:
    """Return the behavior that is invoked; report it if there is none."""
    if node.behavior in r.invoked:
        return r.invoked[node.behavior]
    if node.actor is not None:
        type_ = type_itself(r, node.actor, node.behavior, env) or r.type_of(node.actor, env, OBJECT)
        found = _find_of_actor(r, node, type_, env)
    else:
        found = _find_without_actor(r, node.behavior, env)
    r.invoked[node.behavior] = found
    if found is not None:
        r.references[node.behavior] = found
        if found.origin == "prelude":
            _note_prelude(r, found, node.behavior)
    return found


def _note_prelude(r: Resolution, behavior: CallableBehavior, name: ast.Name) -> None:
    kind = "action" if isinstance(behavior, ActionSymbol) else "scenario"
    r.relaxes(
        "OSC609",
        name.span,
        f"{kind} `{behavior.qualified_name}` belongs to dialect "
        f"`{r.relaxations.dialect.name}`, not to the standard library",
        key=behavior.qualified_name,
    )


def _find_of_actor(
    r: Resolution, node: ast.Invocation, type_: Type, env: Environment
) -> CallableBehavior | None:
    assert node.actor is not None
    if type_ == ERROR:
        _report_circle(r, node.actor, env)
        return None
    if not isinstance(type_, ActorType):
        r.report(
            "OSC301",
            node.actor.span,
            f"{described(type_)} is not an actor; it has no behaviors",
            help=hidden_type(r, type_) or actions_on(r, type_, node),
        )
        return None
    found = find_behavior(r, type_.symbol, node.behavior, env.context)
    if found is None:
        report_unknown_behavior(r, type_.symbol, node.behavior)
    return found


def _report_circle(r: Resolution, actor: ast.Expression, env: Environment) -> None:
    """Report an actor that is a member of its own invocation."""
    root = actor
    while isinstance(root, ast.MemberAccess):
        root = root.base
    if not isinstance(root, ast.NameExpression):
        return
    label = lookup_value(r, root.name, env, quiet=True)
    named = label.node if isinstance(label, LabelSymbol) else None
    if isinstance(named, ast.Invocation) and named.behavior not in r.invoked:
        r.report(
            "OSC301",
            actor.span,
            f"the actor depends on itself through the label `{root.span.text}`",
            help="name an actor before the dot",
        )


def _find_without_actor(r: Resolution, name: ast.Name, env: Environment) -> CallableBehavior | None:
    if env.actor is not None:
        found = find_behavior(r, env.actor, name, env.context)
        if found is not None:
            return found
    unassociated = [b for b in r.scope.behaviors_named(name.text) if b.node.name.actor is None]
    if unassociated:
        return choose(r, unassociated, name, env.context)
    associated = [b for b in r.scope.behaviors_named(name.text) if b.actor is not None]
    if associated:
        r.report(
            "OSC407",
            name.span,
            f"`{associated[0].qualified_name}` needs an actor, and `{_owner_name(env.owner)}` "
            f"{'has none' if env.actor is None else f'acts as `{env.actor.name}`'}",
            help=f"write `<{associated[0].actor.name if associated[0].actor else ''}>.{name}(…)`",
        )
        return None
    if report_unimported(r, name):
        return None
    if r.scope.modifiers_named(name.text):
        report_modifier(r, name)
        return None
    known = {n for layer in r.scope.layers() for n in layer.behaviors}
    help_: Help
    if name.text in OUTPUT:
        help_ = "`record(…)` stores values; `call …` of an external method writes them"
    else:
        help_ = name_meant(name.span, known)
        help_ = help_ or f"declare it, `scenario {name}:`, or import the file that does"
    r.report(
        "OSC211",
        name.span,
        f"no scenario or action `{name}`",
        help=help_,
    )
    return None


def _owner_name(owner: TypeSymbol | None) -> str:
    return owner.name if owner else "this"


def check_with(
    r: Resolution,
    members: Sequence[ast.WithMember],
    env: Environment,
    invoked: CallableBehavior | None,
    actor: ActorSymbol | None,
    *,
    is_composition: bool = False,
) -> None:
    """Check a `with` block.

    Args:
        r: The state of the pass.
        members: Its contents.
        env: Its environment.
        invoked: The behavior that it belongs to.
        actor: The actor that modifiers may leave out.
        is_composition: It belongs to a composition: its modifiers are like those of a scenario.
    """
    for member in members:
        match member:
            case ast.KeepConstraint():
                check_keep(r, member, env)
            case ast.RemoveDefault():
                check_remove_default(r, member, env)
            case ast.ModifierApplication():
                check_modifier(r, member, env, invoked, actor, is_member=is_composition)
            case ast.UntilDirective():
                check_event(r, member.event, env)
            case _:
                assert_never(member)
