"""`osc2tx explain`."""

from __future__ import annotations

import json

import click
from click.shell_completion import CompletionItem

from osc2tx.cli.reporting import columns, wants_color
from osc2tx.diagnostics import CODES, Code
from osc2tx.diagnostics.codes import find_code, meant_code
from osc2tx.diagnostics.render import explanation_data, render_explanation
from osc2tx_shared.text import in_json, put


def _complete(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> list[CompletionItem]:
    return [
        CompletionItem(code.code, help=code.slug)
        for code in CODES.values()
        if code.code.startswith(incomplete.upper())
    ]


@click.command()
@click.argument("code", metavar="[CODE]", required=False, shell_complete=_complete)
@click.option("--all", "everything", is_flag=True, help="Explain every code.")
@click.option("--json", "as_json", is_flag=True, help="Print data for other programs.")
def explain(code: str | None, everything: bool, as_json: bool) -> None:
    """Explain a diagnostic code; without CODE list all codes.

    CODE is written `OSC302`, `302` or by its name, `dimension-mismatch`.
    """
    if code is not None and everything:
        raise click.UsageError("--all explains every code: leave the code out")
    entries = list(CODES.values()) if code is None else [_find(code)]
    if as_json:
        document = [explanation_data(entry) for entry in entries]
        put(in_json(json.dumps(document if code is None else document[0], indent=2)))
    elif code is None and not everything:
        put("\n".join(f"{entry.code}  {entry.slug:28}  {entry.summary}" for entry in entries))
    else:
        put_explanations(entries)


def put_explanations(entries: list[Code]) -> None:
    """Print explanations of codes, formatted for the terminal."""
    color, width = wants_color(), columns()
    texts = [render_explanation(entry, width=width, color=color) for entry in entries]
    put("\n\n\n".join(texts), colored=color)


def _find(code: str) -> Code:
    entry = find_code(code)
    if entry is None:
        meant = meant_code(code)
        hint = f"; did you mean `{meant}`?" if meant else ""
        raise click.UsageError(f"there is no code `{code}`{hint}")
    return entry
