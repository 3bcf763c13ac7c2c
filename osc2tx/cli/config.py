"""`osc2tx config`."""

from __future__ import annotations

import json
from pathlib import Path

import click

from osc2tx.cli.options import seen_from, target_options
from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigFiles, GivenOptions, InForce, Origin
from osc2tx.support.paths import real_path
from osc2tx_shared.text import in_json, say


@click.command()
@click.argument("path", metavar="[PATH]", default=".", type=click.Path(path_type=Path))
@target_options
def config(path: Path, given: GivenOptions) -> None:
    """Show the effective settings for a scenario file or a folder, and their origins."""
    if not path.exists():
        raise InputError(f"{path}: no such file or folder")
    configs = ConfigFiles()
    found = configs.for_folder(path) if path.is_dir() else configs.for_source(path)
    rows = [
        (f"{entry.name} = {_json(_value(entry))}", _place(entry.origin))
        for entry in found.settings_in_force(None if path.is_dir() else path, given)
    ]
    width = max(len(setting) for setting, _ in rows)
    for setting, origin in rows:
        say(f"{setting:{width}}  # {origin}")


def _json(value: object) -> str:
    return in_json(json.dumps(value, ensure_ascii=False))


def _value(entry: InForce) -> object:
    if not entry.is_path or isinstance(entry.value, bool):
        return entry.value
    if isinstance(entry.value, str):
        return _path(Path(entry.value))
    return [_path(Path(value)) for value in entry.value]


def _place(origin: Origin) -> str:
    if origin.path is None:
        return origin.place
    name = _path(real_path(origin.path))
    return f"{name}, [{origin.place}]" if origin.place else name


def _path(path: Path) -> str:
    return seen_from(path, Path.cwd()).as_posix()
