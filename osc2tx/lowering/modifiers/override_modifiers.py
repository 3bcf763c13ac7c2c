"""`override(overridden, by, mode)` (§7.3.12.1.1): a member of a scenario, or in a `with` block."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from osc2tx import ir
from osc2tx.analysis.tree_walk import do_members
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.modifiers.modifiers import is_override
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

Applied: TypeAlias = tuple[ast.ModifierApplication, ast.BehaviorMember | None]


def lower_overrides(
    ctx: LoweringContext, statements: Sequence[ast.Statement]
) -> tuple[ir.Override, ...]:
    """Lower the overrides of a scenario, in the order of the text."""
    found = (_override(ctx, *applied) for applied in _applied(statements))
    return present(list(found))


def _applied(statements: Iterable[ast.Statement]) -> Iterator[Applied]:
    """Yield modifiers with the member of the `do` tree to which each is applied, if any."""
    for statement in statements:
        match statement:
            case ast.ModifierApplication():
                yield statement, None
            case ast.DoDirective(member=root):
                for member in do_members(root):
                    if isinstance(member, ast.Invocation | ast.Composition):
                        for part in member.with_members:
                            if isinstance(part, ast.ModifierApplication):
                                yield part, member


def _override(
    ctx: LoweringContext, node: ast.ModifierApplication, around: ast.BehaviorMember | None
) -> ir.Override | None:
    """Lower one; in a `with` block it holds as long as the owner of the block.

    That makes no difference if one of the two is part of it: then it runs only meanwhile.
    """
    if not is_override(ctx, node):
        return None
    given = {p.name: value for p, value in ctx.model.binding_of(node).arguments}
    symbols = [ctx.model.symbol_of(given[name]) for name in ("overridden", "by") if name in given]
    labels = [symbol for symbol in symbols if isinstance(symbol, sym.LabelSymbol)]
    if len(labels) < 2:
        ctx.unsupported("OSC508", node.span, "`override` needs two labels")
        return None
    parts = () if around is None else tuple(do_members(around))
    if around is not None and not any(label.node in parts for label in labels):
        ctx.unsupported(
            "OSC508",
            node.span,
            f"`override` between others than parts of the `{_kind(around)}` it is applied to"
            " is not supported",
            help="write it as a member of the scenario",
        )
        return None
    mode = given["mode"].span.text if "mode" in given else "on_start"
    return ir.Override(
        span=node.span,
        overridden=labels[0].name,
        by=labels[1].name,
        mode=mode,
        comments=statement_comments(node),
    )


def _kind(node: ast.BehaviorMember) -> str:
    return node.operator.value if isinstance(node, ast.Composition) else "invocation"
