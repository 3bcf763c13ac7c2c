"""Contexts in which each statement is allowed (§7.2.2)."""

from __future__ import annotations

from enum import Enum
from typing import Final

from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar


class Place(Enum):
    """A kind of block; the value completes `… does not belong in`."""

    FILE = "at file level"
    STRUCT = "in a struct"
    ACTOR = "in an actor"
    BEHAVIOR = "in a scenario or action"
    MODIFIER = "in a modifier"
    EXTENSION = "in an extension"
    PRIMITIVE = "in the extension of a primitive type"
    FIELD_WITH = "in the `with` block of a field"
    DO = "inside `do`"
    WITH = "in the `with` block of a behavior"
    ON = "in an `on` block"
    NOWHERE = "here"


_TYPES = frozenset({Place.STRUCT, Place.ACTOR, Place.BEHAVIOR, Place.MODIFIER, Place.EXTENSION})
_FILE = frozenset({Place.FILE})
_CONSTRAINTS = _TYPES | {Place.FIELD_WITH, Place.WITH}
_DO = frozenset({Place.DO})

ALLOWED: Final[dict[type, frozenset[Place]]] = {
    Grammar.ImportStatementContext: _FILE,
    Grammar.NamespaceStatementContext: _FILE,
    Grammar.UseStatementContext: _FILE,
    Grammar.ExportStatementContext: _FILE,
    Grammar.PhysicalTypeDeclarationContext: _FILE,
    Grammar.UnitDeclarationContext: _FILE,
    Grammar.EnumDeclarationContext: _FILE,
    Grammar.StructDeclarationContext: _FILE,
    Grammar.ActorDeclarationContext: _FILE,
    Grammar.ScenarioDeclarationContext: _FILE,
    Grammar.ActionDeclarationContext: _FILE,
    Grammar.ModifierDeclarationContext: _FILE,
    Grammar.ExtensionContext: _FILE,
    Grammar.GlobalParameterContext: _FILE,
    Grammar.EventDeclarationContext: _TYPES,
    Grammar.VariableDeclarationContext: _TYPES,
    Grammar.MethodDeclarationContext: _TYPES | {Place.PRIMITIVE},
    Grammar.KeepConstraintContext: _CONSTRAINTS,
    Grammar.RemoveDefaultContext: _CONSTRAINTS,
    Grammar.CoverageDeclarationContext: _TYPES | {Place.FIELD_WITH},
    Grammar.OnDirectiveContext: frozenset({Place.BEHAVIOR, Place.MODIFIER, Place.EXTENSION}),
    Grammar.DoDirectiveContext: frozenset({Place.BEHAVIOR, Place.EXTENSION}),
    Grammar.CompositionContext: _DO,
    Grammar.WaitDirectiveContext: _DO,
    Grammar.EmitDirectiveContext: _DO | {Place.ON},
    Grammar.CallDirectiveContext: _DO | {Place.ON},
    Grammar.UntilDirectiveContext: frozenset({Place.WITH}),
}

_KEEP = "constraints belong in the body of a type or in a `with:` block"
_DO_FIRST = "begin the behavior of a scenario with `do`"
_HELP: Final[dict[type, str]] = {
    Grammar.ImportStatementContext: "imports come first in a file",
    Grammar.KeepConstraintContext: _KEEP,
    Grammar.RemoveDefaultContext: _KEEP,
    Grammar.UntilDirectiveContext: "`until` belongs in the `with:` block of its member",
    Grammar.OnDirectiveContext: "`on` belongs beside `do`, in the body of the scenario",
    Grammar.VariableDeclarationContext: "declare fields in the body of a type",
    Grammar.EventDeclarationContext: "declare events in the body of a type",
    Grammar.MethodDeclarationContext: "declare methods in the body of a type",
    Grammar.CoverageDeclarationContext: (
        "`cover` and `record` belong in the body of a type, beside `do`; `event: …` states when"
    ),
}


def help_for(kind: type, place: Place) -> str | None:
    """Return the help for a kind of statement in the wrong position."""
    if kind is Grammar.DoDirectiveContext:
        if place is Place.DO:
            return "nest with `serial`, `parallel` or `one_of`"
        return "scenarios and actions have a `do`, other types have none"
    if ALLOWED[kind] >= _DO and place in (Place.FILE, Place.BEHAVIOR, Place.EXTENSION):
        return _DO_FIRST
    if place is Place.ON:
        return "an `on` block holds `call …` and `emit …`"
    if ALLOWED[kind] == _FILE and place is not Place.FILE:
        return _HELP.get(kind, "declare it at file level, without indentation")
    return _HELP.get(kind)
