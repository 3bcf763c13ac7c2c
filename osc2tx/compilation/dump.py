"""Products of a compilation as text (`--emit`)."""

from __future__ import annotations

from typing import assert_never

from osc2tx.compilation.driver import Compilation
from osc2tx.options import ProductName
from osc2tx.syntax.dump import dump_ast


def dump_product(compilation: Compilation, product: ProductName) -> str | None:
    """Return a product as text; `None` where it does not exist."""
    match product:
        case "ast":
            return None if compilation.ast is None else dump_ast(compilation.ast)
        case "model":
            return _dump_model(compilation)
        case "ir":
            return _dump_ir(compilation)
        case "py":
            return None if compilation.module is None else compilation.module.python
        case "xosc":
            written = [scenario.xml for scenario in compilation.xml if scenario.xml is not None]
            return "\n".join(written) if written else None
        case _:
            assert_never(product)


def _dump_model(compilation: Compilation) -> str | None:
    from osc2tx.semantics.dump import dump_model

    return None if compilation.model is None else dump_model(compilation.model)


def _dump_ir(compilation: Compilation) -> str | None:
    from osc2tx.ir.dump import dump_ir

    return None if compilation.ir is None else dump_ir(compilation.ir)
