"""`osc2tx explain`."""

from __future__ import annotations

import click
from click.shell_completion import CompletionItem

from osc2tx.diagnostics.code_lookup import find_code, meant_code
from osc2tx.diagnostics.render import render_explanation
from osc2tx_text import put


def _complete(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> list[CompletionItem]:
    from osc2tx.diagnostics import CODES

    return [
        CompletionItem(code.code, help=code.slug)
        for code in CODES.values()
        if code.code.startswith(incomplete.upper())
    ]


@click.command()
@click.argument("code", shell_complete=_complete)
def explain(code: str) -> None:
    """Say what a diagnostic code means."""
    entry = find_code(code)
    if entry is None:
        meant = meant_code(code)
        raise click.UsageError(f"there is no code `{code}`" + (f"; {meant}" if meant else ""))
    put(render_explanation(entry))
