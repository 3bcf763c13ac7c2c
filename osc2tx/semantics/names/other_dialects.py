"""Names that only the prelude of another dialect declares."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TypedDict

from osc2tx.diagnostics.fixes import Help
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.dialects import DIALECTS
from osc2tx.semantics.resolution import Resolution
from osc2tx.stdlib import library_file
from osc2tx.syntax import ast


class Advice(TypedDict):
    """The further lines of a report."""

    notes: list[str]
    help: Help


def advise(r: Resolution, kind: str, name: ast.Name, known: list[str]) -> Advice:
    """Return the dialect that has a name, otherwise a similar known name.

    Args:
        r: The state of the pass.
        kind: `"type"` or `"modifier"`.
        name: The unknown name.
        known: The known names.
    """
    dialect = _declared_by_preludes().get((kind, name.text))
    if dialect is None or dialect == r.relaxations.dialect.name:
        return Advice(notes=[], help=name_meant(name.span, known))
    return Advice(notes=[f"dialect `{dialect}` has it"], help=f"check with `--dialect {dialect}`")


@cache
def _declared_by_preludes() -> Mapping[tuple[str, str], str]:
    found: dict[tuple[str, str], str] = {}
    for dialect in DIALECTS.values():
        if dialect.prelude is None:
            continue
        for statement in library_file(dialect.prelude, "2.2").statements:
            match statement:
                case (
                    ast.ActorDeclaration(name=name)
                    | ast.StructDeclaration(name=name)
                    | ast.EnumDeclaration(name=name)
                ):
                    found["type", name.text] = dialect.name
                case ast.ModifierDeclaration(name=behavior):
                    found["modifier", behavior.name.text] = dialect.name
                case _:
                    pass
    return found
