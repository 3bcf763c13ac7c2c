"""External methods (§7.3.7): user code that runs only if allowed by name."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

LANGUAGE = ("python",)
ARGUMENTS = ("module", "name")


def lower_external(
    ctx: LoweringContext, method: sym.MethodSymbol, body: ast.ExternalBody
) -> ir.External | None:
    """Lower `external python(module: "m", name: "f")`; the name may be left out."""
    where = ".".join(body.path)
    if tuple(body.path) != LANGUAGE:
        ctx.unsupported(
            "OSC512",
            body.span,
            f"external methods of `{where}` cannot be called",
            help='write `external python(module: "m", name: "f")`',
        )
        return None
    given: dict[str, str] = {}
    for argument, expected in zip(body.arguments, (*ARGUMENTS, None, None), strict=False):
        name = expected if argument.name is None else argument.name.text
        if name not in ARGUMENTS or not isinstance(argument.value, ast.StringLiteral):
            ctx.unsupported(
                "OSC512", argument.span, "`python` takes `module` and `name`, as plain strings"
            )
            return None
        given[name] = argument.value.value
    path = (given.get("module", ""), given.get("name", method.name))
    if not all(part.isidentifier() for text in path for part in text.split(".")):
        ctx.unsupported(
            "OSC512",
            body.span,
            f"`{path[0]}` is no module with a function `{path[1]}`",
            help='name both, as in `external python(module: "m", name: "f")`',
        )
        return None
    return ir.External(module=path[0], function=path[1])
