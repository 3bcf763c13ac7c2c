"""Aliases: names of other tools for items of the standard."""

from __future__ import annotations

from collections.abc import Container

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Remedy, write
from osc2tx.semantics.dialects import (
    BEHAVIOR_ALIASES,
    ENUM_MEMBER_ALIASES,
    MEMBER_ALIASES,
    PARAMETER_ALIASES,
    TYPE_ALIASES,
    UNIT_ALIASES,
    ParameterAlias,
)
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import EnumSymbol, Symbol, TypeSymbol
from osc2tx.syntax import ast


def type_alias(r: Resolution, name: ast.Name) -> ast.Name | None:
    """Return the standard's name of a type, if the dialect reads this one for it."""
    return _standard_name(r, "OSC612", "type", name, TYPE_ALIASES.get(name.text))


def unit_alias(r: Resolution, name: ast.Name) -> ast.Name | None:
    """Return the standard's name of a unit, if the dialect reads this one for it."""
    return _standard_name(r, "OSC613", "unit", name, UNIT_ALIASES.get(name.text))


def enum_member_alias(r: Resolution, enum: EnumSymbol, name: ast.Name) -> ast.Name | None:
    """Return the standard's name of an enum member, if the dialect reads this one for it."""
    standard = ENUM_MEMBER_ALIASES.get((enum.name, name.text))
    return _standard_name(r, "OSC615", f"member of `{enum.name}`", name, standard)


def member_alias(r: Resolution, owner: TypeSymbol, name: ast.Name) -> ast.Name | None:
    """Return the standard's name of a member, if the dialect reads this one for it."""
    standard = standard_member(owner, name)
    return _standard_name(r, "OSC619", f"member of `{owner.name}`", name, standard)


def behavior_alias(r: Resolution, actor: TypeSymbol, name: ast.Name) -> ast.Name | None:
    """Return the standard's name of an action, if the dialect reads this one for it."""
    standard = standard_behavior(actor, name)
    return _standard_name(r, "OSC619", f"action of `{actor.name}`", name, standard)


def parameter_alias(
    r: Resolution, callee: Symbol, name: ast.Name, known: Container[str]
) -> ParameterAlias | None:
    """Return the parameter that another name denotes, if the dialect accepts it."""
    alias = standard_parameter(callee, name)
    if alias is None or name.namespace is not None or alias.parameter not in known:
        return None
    read = r.relaxes(
        "OSC614",
        name.span,
        f"`{name}` of `{callee.name}` stands for `{alias.written_out}`"
        + (f"; {alias.note}" if alias.note else ""),
        key=f"{callee.name} {name}",
        help=f"write `{alias.written_out}`",
    )
    return alias if read else None


def standard_member(owner: TypeSymbol, name: ast.Name) -> str | None:
    """Return the standard name of a member of a type."""
    keys = ((s.name, name.text) for s in supertypes(owner))
    return next((MEMBER_ALIASES[key] for key in keys if key in MEMBER_ALIASES), None)


def standard_behavior(actor: TypeSymbol, name: ast.Name) -> str | None:
    """Return the standard name of an action of an actor type."""
    keys = ((s.name, name.text) for s in supertypes(actor))
    return next((BEHAVIOR_ALIASES[key] for key in keys if key in BEHAVIOR_ALIASES), None)


def standard_parameter(callee: Symbol, name: ast.Name) -> ParameterAlias | None:
    """Return the standard name of a parameter of its modifiers and actions."""
    if callee.origin == "user":
        return None
    return PARAMETER_ALIASES.get((callee.name, name.text))


def write_instead(written: Span, standard: str | None) -> Remedy | None:
    """Return the remedy that writes the standard's word."""
    return write(written, standard) if standard else None


def _standard_name(
    r: Resolution, code: str, kind: str, name: ast.Name, standard: str | None
) -> ast.Name | None:
    if standard is None or name.namespace is not None:
        return None
    read = r.relaxes(
        code,
        name.span,
        f"{kind} `{name}` stands for `{standard}`",
        key=f"{kind} {name}",
        help=write_instead(name.span, standard),
    )
    return ast.Name(span=name.span, text=standard) if read else None
