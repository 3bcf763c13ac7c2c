"""`osc2tx reference`."""

from __future__ import annotations

import json

import click

from osc2tx.cli.explain import put_explanations
from osc2tx.diagnostics.codes import find_code
from osc2tx.diagnostics.render import explanation_data
from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.reference import as_data, as_text, entries, find
from osc2tx_shared.text import in_json, put


def _complete(context: click.Context, parameter: click.Parameter, incomplete: str) -> list[str]:
    names = dict.fromkeys(each.declaration.name for each in entries())
    return [name for name in names if name.startswith(incomplete)]


@click.command()
@click.argument("name", required=False, shell_complete=_complete)
@click.option("--json", "as_json", is_flag=True, help="Print plain data.")
def reference(name: str | None, as_json: bool) -> None:
    """Describe an actor, action, modifier, struct, enum or physical type of the library.

    NAME is `drive`, `vehicle.drive`, `action vehicle.drive` or the code of a diagnostic. Without
    it, all names are listed.
    """
    code = None if name is None else find_code(name)
    if code is not None:
        if as_json:
            put(in_json(json.dumps([explanation_data(code)], indent=2)))
        else:
            put_explanations([code])
        return
    if name is None:
        found = list(entries())
        text = "\n".join(each.key for each in found)
    else:
        found = find(name)
        if not found:
            names = [part for each in entries() for part in (each.declaration.name, each.own_name)]
            meant = did_you_mean(name, names)
            raise click.UsageError(f"there is no `{name}`" + (f"; {meant}" if meant else ""))
        text = "\n\n\n".join(map(as_text, found))
    put(json.dumps(list(map(as_data, found)), indent=2) + "\n" if as_json else text + "\n")
