"""Physical types, units and enumerations (§7.3.3, §7.3.4)."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.syntax import ast
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Builder, StatementBuilder, Tree
from osc2tx.syntax.ast_builder.expressions import build_arguments, build_expression
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head, refuse_block
from osc2tx.syntax.tokens import Comment

PRIMITIVES = frozenset({"int", "uint", "float", "bool", "string"})
SI_ORDER = "exponents come first, then `factor`, then `offset`"
SI_BASES = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


def _physical_type(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    exponents, numbers = _si(b, tree.children[3])
    for word in numbers:
        b.report("OSC100", head.span, f"`{word}` belongs to a unit, not to a type")
    refuse_block(b, tree)
    name = b.name(tree.children[1])
    return ast.PhysicalTypeDeclaration(**head.fields(), name=name, exponents=exponents)


def _unit(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    exponents, numbers = _si(b, tree.children[5])
    refuse_block(b, tree)
    return ast.UnitDeclaration(
        **head.fields(),
        name=b.name(tree.children[1]),
        physical_type=b.name(tree.children[3]),
        exponents=exponents,
        factor=numbers.get("factor", 1.0),
        offset=numbers.get("offset", 0.0),
    )


def _si(b: Builder, tree: Tree) -> tuple[tuple[ast.SiExponent, ...], dict[str, float]]:
    """Build `SI(m: 1, s: -1, factor: 3.6)`."""
    word = tree.children[0]
    if b.text_of(word) != "SI":
        message = f"expected `SI(…)`, found `{b.text_of(word)}`"
        b.report("OSC100", b.span(word, word), message)
    exponents: list[ast.SiExponent] = []
    numbers: dict[str, float] = {}
    arguments = build_arguments(b, tree.children[2]) if len(tree.children) == 4 else ()
    for argument in arguments:
        name = argument.name.text if argument.name is not None else None
        value = constant(argument.value)
        if name in numbers:
            b.report("OSC100", argument.span, f"`{name}` is given twice")
        elif "offset" in numbers or ("factor" in numbers and name != "offset"):
            message = f"`{argument.span.text}` is in the wrong order: {SI_ORDER}"
            b.report("OSC100", argument.span, message, "`SI(K: 1, factor: 0.5, offset: 200.0)`")
        elif name in ("factor", "offset") and value is not None:
            numbers[name] = float(value)
        elif name in SI_BASES and isinstance(value, int):
            exponents.append(ast.SiExponent(span=argument.span, base=name, exponent=value))
        else:
            _report_si(b, argument, name)
    if not arguments:
        message = "`SI(…)` needs at least one base unit with its exponent"
        b.report("OSC100", b.tree_span(tree), message, "`SI(m: 1, s: -1)`")
    return tuple(exponents), numbers


def _report_si(b: Builder, argument: ast.Argument, name: str | None) -> None:
    if name in SI_BASES:
        message = f"the exponent of `{name}` is an integer"
    elif name in ("factor", "offset"):
        message = f"`{name}` is a number"
    else:
        message = f"expected one of {', '.join(SI_BASES)}, `factor` or `offset`"
    b.report("OSC100", argument.span, message, "`SI(m: 1, s: -1, factor: 0.1)`")


# --- Enumerations ---------------------------------------------------------------------------


def _enum(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    members, head = build_enum_members(b, tree.children[3], head)
    refuse_block(b, tree)
    name = b.name(tree.children[1])
    return ast.EnumDeclaration(**head.fields(), name=name, members=members)


def build_enum_members(
    b: Builder, tree: Tree, head: Head
) -> tuple[tuple[ast.EnumMember, ...], Head]:
    """Build the members of an enumeration; the comments between them are theirs.

    Those behind the last one are comments of the statement.
    """
    trees = [c for c in tree.children if c.__class__ is Grammar.EnumMemberContext]
    members: list[ast.EnumMember] = []
    waiting = list(head.inside)
    for number, child in enumerate(trees):
        end = trees[number + 1].start if number + 1 < len(trees) else tree.stop
        above = [c for c in waiting if c.before <= child.start]
        behind = [c for c in waiting if child.start < c.before <= end and not c.alone]
        waiting = [c for c in waiting if c not in above and c not in behind]
        members.append(_enum_member(b, child, above, behind))
    left = [comment.text for comment in waiting]
    if head.trailing is None and waiting and not waiting[0].alone:
        head = head._replace(trailing=left.pop(0))
    return tuple(members), head._replace(below=(*left, *head.below))


def _enum_member(
    b: Builder, tree: Tree, above: list[Comment], behind: list[Comment]
) -> ast.EnumMember:
    children = tree.children
    return ast.EnumMember(
        span=b.tree_span(tree),
        comments=tuple(comment.text for comment in above),
        trailing_comment=behind[0].text if behind else None,
        name=b.name(children[0]),
        value=_enum_value(b, children[2]) if len(children) > 1 else None,
    )


def _enum_value(b: Builder, tree: Tree) -> int | ast.EnumLiteral | ast.NameExpression | None:
    value = build_expression(b, tree)
    if isinstance(value, ast.IntegerLiteral):
        return value.value
    if isinstance(value, (ast.EnumLiteral, ast.NameExpression)):
        return value
    message = "the value of an enumeration member is an unsigned integer or another member"
    b.report("OSC100", b.tree_span(tree), message)
    return None


def constant(value: ast.Expression) -> int | float | None:
    """Return the value of a number, a sign included; `None` for anything else."""
    match value:
        case ast.IntegerLiteral() | ast.FloatLiteral():
            return value.value
        case ast.Unary(
            operator=ast.UnaryOperator.NEGATE,
            operand=(ast.IntegerLiteral() | ast.FloatLiteral()) as number,
        ):
            return -number.value
    return None


BUILDERS: Mapping[type, StatementBuilder] = {
    Grammar.PhysicalTypeDeclarationContext: _physical_type,
    Grammar.UnitDeclarationContext: _unit,
    Grammar.EnumDeclarationContext: _enum,
}
