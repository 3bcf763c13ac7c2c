"""Event specifications and conditions (§7.3.10)."""

from __future__ import annotations

from typing import assert_never

from osc2tx.diagnostics.fixes import Remedy, insert_before
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.assignability import check_condition, check_duration, check_value
from osc2tx.semantics.builtins import TIME
from osc2tx.semantics.dialects import RUNNER_EVENTS
from osc2tx.semantics.expressions.access import resolve_member
from osc2tx.semantics.names.member_lookup import lookup_value
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import EventSymbol, ParameterSymbol, Symbol, TypeSymbol
from osc2tx.semantics.types import EVENT, OBJECT
from osc2tx.syntax import ast


def check_event(r: Resolution, node: ast.EventSpecification, env: Environment) -> Environment:
    """Check an event specification; return the environment with its event field."""
    inner = env
    if node.event is not None:
        event = resolve_event_path(r, node.event, env)
        if node.field is not None:
            inner = _bind_field(r, node.field, event, env)
    if node.condition is not None:
        check_event_condition(r, node.condition, inner)
    return inner


def _bind_field(
    r: Resolution, name: ast.Name, event: EventSymbol | None, env: Environment
) -> Environment:
    field = ParameterSymbol(name=name.text, namespace=env.context.namespace, span=name.span)
    if event is not None:
        field.type = EVENT
        r.event_fields[field] = event
    r.references[name] = field
    return env.with_locals([field])


def check_event_condition(r: Resolution, node: ast.EventCondition, env: Environment) -> None:
    """Check a condition of an event specification."""
    match node:
        case ast.LevelCondition() | ast.RiseCondition() | ast.FallCondition():
            check_condition(r, node.expression, env)
        case ast.ElapsedCondition():
            check_duration(r, node.duration, env)
        case ast.EveryCondition():
            check_value(r, node.period, TIME, env, "a period")
            if node.offset is not None:
                check_value(r, node.offset, TIME, env, "an offset")
        case _:
            assert_never(node)


def resolve_event_path(r: Resolution, path: ast.Expression, env: Environment) -> EventSymbol | None:
    """Return the event that `@path` names; report it if there is none."""
    match path:
        case ast.NameExpression():
            symbol: Symbol | None = resolve_event_name(r, path.name, env)
        case ast.MemberAccess():
            symbol = resolve_member(r, path, r.type_of(path.base, env, OBJECT), env)
        case _:
            r.type_of(path, env)
            r.report("OSC316", path.span, "this does not name an event")
            return None
    if symbol is None:
        return None
    r.references[path] = symbol
    if isinstance(symbol, EventSymbol):
        r.types[path] = EVENT
        return symbol
    r.report(
        "OSC316",
        path.span,
        f"`{symbol.name}` is not an event",
        labels=declared_here(symbol),
        help=(
            f"events of a behavior are `{symbol.name}.start`, `.end` and `.fail`"
            if type(symbol).__name__ == "LabelSymbol"
            else None
        ),
    )
    return None


def resolve_event_name(r: Resolution, name: ast.Name, env: Environment) -> Symbol | None:
    """Return the event of a simple name; in a dialect its use may declare it."""
    symbol = lookup_value(r, name, env)
    if symbol is not None:
        return symbol
    owner = env.owner
    if owner is None:
        r.report("OSC210", name.span, f"event `{name}` is not declared")
        return None
    implicit = EventSymbol(
        name=name.text,
        namespace=env.context.namespace,
        span=name.span,
        owner=owner,
        is_implicit=True,
    )
    owner.members[name.text] = implicit
    condition = None
    if name.text in RUNNER_EVENTS:
        condition = f"give it a condition: `event {name} is (….object_distance(…) < …)`"
    if not r.relaxes(
        "OSC603",
        name.span,
        f"event `{name}` is not declared; its use declares it in `{owner.name}`",
        key=f"{owner.name}.{name}",
        help=condition or f"declare it: `event {name}`",
    ):
        members = {n: m for type_ in supertypes(owner) for n, m in type_.members.items()}
        events = [n for n, m in members.items() if isinstance(m, EventSymbol) and not m.is_implicit]
        r.report(
            "OSC210",
            name.span,
            f"event `{name}` is not declared",
            help=condition or name_meant(name.span, events) or _declared(owner, name.text),
        )
    return implicit


def _declared(owner: TypeSymbol, name: str) -> Remedy:
    """Return the remedy that declares an event above the members of a type."""
    help_ = f"declare it in `{owner.name}`: `event {name}`"
    members = getattr(getattr(owner, "node", None), "members", ())
    if not members:
        return Remedy(help_)
    first = members[0].span
    indentation = " " * (first.source.position(first.start)[1] - 1)
    return insert_before(first, f"event {name}\n{indentation}", help_, is_safe=False)
