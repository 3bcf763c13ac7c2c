"""The command line: arguments, messages, exit codes; one module for each command.

Exit codes: 0 ok (warnings included), 1 outputs are stale, or warnings under --strict, 2 wrong usage
or settings, 3 errors in a source, 4 unreadable input or unwritable output, 5 the scenario ran and
failed, 70 a bug of ours.

`init`, `check`, `build`, `fmt`, `config` and `explain` hold the commands, each loaded when it is
asked for; `options` and `progress` are what they share.
"""

from __future__ import annotations

import gc
import os
import sys
import traceback
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import NoReturn

import click

from osc2tx.cli.reporting import BUG_REPORT, Exit, Session, complain, report_failure
from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigError
from osc2tx.version import __version__

# Command -> where it is, and its line in the help page.
COMMANDS: Mapping[str, tuple[str, str]] = {
    "init": ("osc2tx.cli.init:init", "Start a project with a scenario, settings and a test."),
    "check": ("osc2tx.cli.check:check", "Report what is wrong with scenario files."),
    "build": ("osc2tx.cli.build:build", "Write a py_trees module for every scenario file."),
    "run": ("osc2tx.cli.run:run", "Run a scenario in the embedded world."),
    "fmt": ("osc2tx.cli.fmt:fmt", "Lay scenario files out in the style of the standard."),
    "tree": ("osc2tx.cli.tree:tree", "Draw the behavior tree of a scenario."),
    "config": ("osc2tx.cli.config:config", "Show the settings in force, and where they are from."),
    "explain": ("osc2tx.cli.explain:explain", "Say what a diagnostic code means."),
}


class Commands(click.Group):
    """The group of commands; each is loaded when it is asked for."""

    def list_commands(self, context: click.Context) -> list[str]:
        """Return the names in the order of the help page."""
        return list(COMMANDS)

    def format_commands(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list of commands without loading them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, help) for name, (_, help) in COMMANDS.items()])

    def get_command(self, context: click.Context, name: str) -> click.Command | None:
        """Return a command by its name."""
        if name not in COMMANDS:
            return None
        module, _, attribute = COMMANDS[name][0].partition(":")
        command: click.Command = getattr(import_module(module), attribute)
        return command


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="osc2tx")
def cli() -> None:
    """Compile OpenSCENARIO DSL into readable py_trees modules, and run them."""


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and end the process."""
    gc.set_threshold(200_000, 30, 30)  # what a start makes is there to stay: look rarely
    code = _exit_code(sys.argv[1:] if arguments is None else arguments)
    gc.freeze()  # the process ends: nobody has to look for garbage in large trees
    sys.exit(code)


def _exit_code(arguments: Sequence[str]) -> int:
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a terminal may know fewer characters than a source
            stream.reconfigure(errors="backslashreplace")
    session = Session()
    try:
        code = cli.main(list(arguments), prog_name="osc2tx", standalone_mode=False, obj=session)
        sys.stdout.flush()
        return int(code or Exit.OK)
    except click.ClickException as error:
        error.show()
        report_failure(error.format_message(), arguments, session)
        return error.exit_code
    except click.Abort:
        return Exit.INTERRUPTED
    except (ConfigError, InputError) as error:
        complain(f"osc2tx: error: {error}")
        report_failure(str(error), arguments, session)
        unreadable = isinstance(error, InputError) and error.unreadable
        return Exit.UNREADABLE if unreadable else Exit.USAGE
    except SystemExit as end:  # click's answer to a reader of our output that has gone is 1
        return 141 if end.code == 1 else Exit.OK
    except BrokenPipeError:  # the same, noticed here
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except Exception:  # the edge of the process: a bug must not look like exit code 1, stale
        traceback.print_exc()
        complain(BUG_REPORT)
        report_failure("osc2tx failed; this is a bug of it", arguments, session)
        return Exit.BUG
