"""Writes docs/reference/cli.md from the commands themselves."""

from __future__ import annotations

import inspect
import re
from pathlib import Path

import click

from osc2tx.cli import COMMANDS, cli
from osc2tx.cli.reporting import Exit

PAGE = Path(__file__).parent.parent / "docs" / "reference" / "cli.md"
MEANINGS = {
    Exit.OK: "all is well; there may be warnings",
    Exit.STALE: "outputs are not as the sources make them (`--check`), a file is not "
    "formatted (`fmt --check`, `fmt --diff`), or there are warnings under `--strict`",
    Exit.USAGE: "wrong usage, or a wrong settings file",
    Exit.ERRORS: "errors in a source",
    Exit.UNREADABLE: "an input cannot be read, or an output not be written",
    Exit.FAILED: "the scenario failed, or cannot run as it is: the reason is printed",
    Exit.BUG: "a bug of osc2tx; please report it",
    Exit.INTERRUPTED: "interrupted",
}


def render() -> str:
    """Return the page."""
    lines = ["# Command line", "", "<!-- Made by tools/make_cli_doc.py: edit the commands. -->", ""]
    lines += ["| command | |", "|---|---|"]
    lines += [
        f"| [`osc2tx {name}`](#osc2tx-{name}) | {help} |" for name, (_, help) in COMMANDS.items()
    ]
    for name in COMMANDS:
        lines += _section(name)
    lines += ["", "## Exit codes", "", "| code | |", "|---|---|"]
    lines += [f"| {int(code)} | {meaning} |" for code, meaning in MEANINGS.items()]
    return "\n".join([*lines, *_COMPLETION.splitlines()]) + "\n"


def _section(name: str) -> list[str]:
    context = click.Context(cli, info_name="osc2tx", max_content_width=100)
    command = cli.get_command(context, name)
    assert command is not None
    return _described(command, click.Context(command, info_name=name, parent=context), "##")


def _described(command: click.Command, inner: click.Context, heading: str) -> list[str]:
    usage = command.get_usage(inner).removeprefix("Usage: ")
    lines = ["", f"{heading} {inner.command_path}", "", "```", usage, "```", ""]
    lines += inspect.cleandoc(command.help or "").split("\n")
    rows = [
        record
        for parameter in command.get_params(inner)
        if isinstance(parameter, click.Option)
        and "--help" not in parameter.opts
        and (record := parameter.get_help_record(inner))
    ]
    lines += ["", "| option | |", "|---|---|"] if rows else []
    lines += [f"| `{_code(option)}` | {_words(help)} |" for option, help in rows]
    for name, each in command.commands.items() if isinstance(command, click.Group) else ():
        below = click.Context(each, info_name=name, parent=inner)
        lines += _described(each, below, f"{heading}#")
    return [line.rstrip() for line in lines]


def _code(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def _words(text: str) -> str:
    return re.sub(r"([|\[\]<>])", r"\\\1", " ".join(text.split()))


_COMPLETION = """
## Completion in the shell

For bash, in `~/.bashrc`; zsh and fish work the same way with their names:

```
eval "$(_OSC2TX_COMPLETE=bash_source osc2tx)"
```
"""

if __name__ == "__main__":
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(render(), encoding="utf-8")
