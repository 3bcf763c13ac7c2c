"""`osc2tx reference`."""

from __future__ import annotations

import json

import click

from osc2tx.cli.explain import put_explanations
from osc2tx.diagnostics.codes import find_code
from osc2tx.diagnostics.render import explanation_data
from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.reference import (
    Topic,
    as_data,
    as_text,
    entries,
    find,
    find_topics,
    topic_as_data,
    topic_as_text,
    topics,
)
from osc2tx_shared.text import in_json, put

MOST_MEMBERS = 5  # that are described one by one


def _complete(context: click.Context, parameter: click.Parameter, incomplete: str) -> list[str]:
    names = dict.fromkeys(each.declaration.name for each in entries())
    names |= dict.fromkeys(name for topic in topics() for name in topic.names)
    return [name for name in names if name.startswith(incomplete)]


def _told(found: list[Topic], *, is_long: bool) -> list[str]:
    """Return the texts of topics; members that many types have, or beside pages, by name alone."""
    members = [topic for topic in found if "." in topic.name]
    if is_long and len(members) <= MOST_MEMBERS:
        return list(map(topic_as_text, found))
    told = [topic_as_text(topic) for topic in found if topic not in members]
    names = ", ".join(f"{topic.kind} {topic.name}" for topic in members)
    return [*told, *([f"Also: {names}"] if names else [])]


@click.command()
@click.argument("words", nargs=-1, metavar="[NAME]", shell_complete=_complete)
@click.option("--json", "as_json", is_flag=True, help="Print plain data.")
def reference(words: tuple[str, ...], as_json: bool) -> None:
    """Describe a name of the library or a construct of the language.

    NAME is `drive`, `vehicle.drive`, `action vehicle.drive`, a method such as `space_gap`, a word
    of the language such as `until`, a unit, or the code of a diagnostic. Without it, the
    declarations of the library and the constructs of the language are listed.
    """
    name = " ".join(words) or None
    code = None if name is None else find_code(name)
    if code is not None:
        if as_json:
            put(in_json(json.dumps([explanation_data(code)], indent=2)))
        else:
            put_explanations([code])
        return
    if name is None:
        found, more = list(entries()), [topic for topic in topics() if topic.is_of_language]
        text = "\n".join([*(each.key for each in found), *(f"{t.kind} {t.name}" for t in more)])
    else:
        found, more = find(name), find_topics(name)
        if not found and not more:
            names = [part for each in entries() for part in (each.declaration.name, each.own_name)]
            meant = did_you_mean(name, [*names, *(n for topic in topics() for n in topic.names)])
            raise click.UsageError(f"there is no `{name}`" + (f"; {meant}" if meant else ""))
        text = "\n\n\n".join([*map(as_text, found), *_told(more, is_long=not found)])
    data = [*map(as_data, found), *map(topic_as_data, more)]
    put(json.dumps(data, indent=2) + "\n" if as_json else text + "\n")
