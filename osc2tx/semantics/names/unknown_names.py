"""Names of the standard library that the program does not import."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx.diagnostics.fixes import Help, Remedy, write
from osc2tx.diagnostics.suggestions import name_meant, one_of
from osc2tx.semantics.dialects import LEFT_OUT, PRELUDE_PARAMETERS, PreludeHint
from osc2tx.semantics.names.aliases import standard_parameter, write_instead
from osc2tx.semantics.names.colloquial_names import fitting_word
from osc2tx.semantics.names.stray_modifiers import move_out
from osc2tx.semantics.resolution import Resolution, declared_here
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.semantics.symbols import (
    ActionSymbol,
    BehaviorSymbol,
    FieldSymbol,
    ModifierSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    Symbol,
)
from osc2tx.semantics.types import EnumType
from osc2tx.stdlib import NEWEST, newer_members
from osc2tx.syntax import ast


def report_unimported(r: Resolution, name: ast.Name) -> bool:
    """Whether a name only lacks the import of the library; that is reported once per file."""
    if r.unimported is None:
        return False
    library = r.unimported()
    text = name.text
    known = (
        library.types_named(text)
        or library.modifiers_named(text)
        or library.behaviors_named(text)
        or library.unit_named(text)
    )
    if not known:
        return False
    if r.relaxations.is_new("OSC205", name.span.source.name, ""):
        r.report(
            "OSC202",
            name.span,
            f"`{name}` belongs to the standard library, which is not imported",
            help="write `import osc.standard.all`, then `namespace null use std, stdtypes`",
        )
    return True


Parameters = Sequence[FieldSymbol | ParameterSymbol]


def report_unknown(
    r: Resolution,
    names: Mapping[ast.Name, ast.Expression],
    parameters: Parameters,
    callee: Symbol,
    node: ast.Node,
) -> None:
    """Report names that no parameter has; those of a prelude together, the others one by one.

    Args:
        r: The state of the pass.
        names: The names, with the values given.
        parameters: The declared parameters.
        callee: The owner of the parameters.
        node: The owner of the arguments.
    """
    hints = {n: PRELUDE_PARAMETERS.get((callee.name, n.text)) for n in names}
    foreign = [n for n in names if hints[n] is not None and callee.origin == "library"]
    for name, value in names.items():
        hint = hints[name]
        if hint is not None and name in foreign:
            if name is foreign[0]:
                _report_foreign(r, foreign, hint, callee)
            continue
        if (variable := _variable(callee, name)) is not None:
            r.report(
                "OSC402",
                name.span,
                f"`{name}` of `{callee.name}` is a variable, which takes no argument",
                help="declare it without `var` to make it a parameter",
                labels=declared_here(variable),
            )
            continue
        r.report(
            "OSC402",
            name.span,
            f"`{callee.name}` has no parameter `{name}`",
            help=_help(r, name, value, parameters, callee, node),
            labels=declared_here(callee),
        )


def _help(
    r: Resolution,
    name: ast.Name,
    value: ast.Expression,
    parameters: Parameters,
    callee: Symbol,
    node: ast.Node,
) -> Help:
    word, names = name.text, [p.name for p in parameters]
    whole = name.span.to(value.span)
    if (callee.name, word) in LEFT_OUT:
        return f"leave `{word}: {value.span.text}` out; {LEFT_OUT[callee.name, word]}"
    if alias := standard_parameter(callee, name):
        return Remedy(f"write `{alias.written_out}`")
    if callee.origin == "library" and (newer := in_newest_version(r, callee.name, name)):
        return newer
    for parameter in parameters:
        if isinstance(parameter.type, EnumType) and word in parameter.type.symbol.members:
            given = value.span.text
            member = given if given in parameter.type.symbol.members else word
            return write_instead(whole, f"{parameter.name}: {member}")
    if parameter_name := fitting_word(word, names):
        return write(name.span, parameter_name, f"write `{parameter_name}: …`")
    if _is_modified_by(r, callee, word):
        return move_out(node, value, word)
    return name_meant(name.span, names) or one_of("its parameters are", names)


def in_newest_version(r: Resolution, owner: str, name: ast.Name) -> str:
    """Return the help for a member that the library has in a newer version only; empty: none."""
    if name.text not in newer_members(owner, r.standard):
        return ""
    return f"OpenSCENARIO DSL {NEWEST} has it: check with `--std {NEWEST}`"


def _is_modified_by(r: Resolution, callee: Symbol, word: str) -> bool:
    """Whether a modifier has the name and applies to a behavior, or beside another modifier."""
    modified = callee.target if isinstance(callee, ModifierSymbol) else callee
    if not isinstance(modified, ScenarioSymbol | ActionSymbol):
        return False
    return any(
        isinstance(modifier, ModifierSymbol)
        and modifier.target is not None
        and is_subtype(modified, modifier.target)
        for modifier in r.scope.modifiers_named(word)
    )


def _variable(callee: Symbol, name: ast.Name) -> FieldSymbol | None:
    """Return the variable of a behavior that has the name of an argument."""
    types = supertypes(callee) if isinstance(callee, BehaviorSymbol) else ()
    found = next((t.members[name.text] for t in types if name.text in t.members), None)
    return found if isinstance(found, FieldSymbol) and found.is_variable else None


def _report_foreign(
    r: Resolution, names: Sequence[ast.Name], hint: PreludeHint, callee: Symbol
) -> None:
    """Report parameters that only the prelude of some dialect gives to a library modifier."""
    listed = ", ".join(f"`{name}`" for name in names)
    plural = "s" if len(names) > 1 else ""
    r.report(
        "OSC402",
        names[0].span,
        f"`{callee.name}` has no parameter{plural} {listed} in the standard library",
        notes=[f"{hint.instead}; dialect `{hint.dialect}` has {'them' if plural else 'it'}"],
        help=f"check with `--dialect {hint.dialect}`",
    )
