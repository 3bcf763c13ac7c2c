"""The command line: arguments, messages, exit codes; one module for each command.

Exit codes: 0 ok (warnings included), 1 outputs are stale, or warnings under --strict, 2 wrong usage
or settings, 3 errors in a source, 4 unreadable input or unwritable output, 5 the scenario ran and
failed, 70 an internal error.

`init`, `check`, `build`, `report`, `verify`, `fmt`, `map`, `config`, `reference` and `explain` hold
the commands, each loaded on first use; `options` and `progress` are shared by them.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import NoReturn

import click

from osc2tx.building.answers import Answer
from osc2tx.cli.reporting import BUG_REPORT, Exit, Session, report_failure
from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigError
from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.version import __version__
from osc2tx_shared.text import READER_HAS_GONE, OutputError, complain, expect_output, put
from osc2tx_shared.text import explain as explain_output

# Command -> where it is, and its line in the help page.
COMMANDS: Mapping[str, tuple[str, str]] = {
    "init": ("osc2tx.cli.init:init", "Start a project with a scenario, settings and a test."),
    "check": ("osc2tx.cli.check:check", "Report errors and warnings in scenario files."),
    "build": ("osc2tx.cli.build:build", "Write a py_trees module for every scenario file."),
    "run": ("osc2tx.cli.run:run", "Run a scenario in the embedded world."),
    "test": ("osc2tx.cli.test:test", "Run scenarios as tests."),
    "campaign": (
        "osc2tx.cli.campaign:campaign",
        "Run a scenario many times with different values.",
    ),
    "verify": ("osc2tx.cli.verify:verify", "Check a trace against the conditions of its scenario."),
    "report": ("osc2tx.cli.report:report", "Make pages of traces: one run, two, or a folder."),
    "import": ("osc2tx.cli.import_:import_", "Make scenarios of OpenSCENARIO XML documents."),
    "fmt": ("osc2tx.cli.fmt:fmt", "Format scenario files in the style of the standard."),
    "tree": ("osc2tx.cli.tree:tree", "Draw the behavior tree of a scenario."),
    "graph": ("osc2tx.cli.graph:graph", "Show the uses of declarations, files and maps."),
    "map": ("osc2tx.cli.map:map", "Describe a road map, and report its errors."),
    "world": ("osc2tx.cli.world:world", "Check a simulator against the requirements of runs."),
    "config": ("osc2tx.cli.config:config", "Show the effective settings and their origins."),
    "reference": ("osc2tx.cli.reference:reference", "Describe a name of the library."),
    "lsp": ("osc2tx.cli.lsp:lsp", "Serve editors: diagnostics, completion, fixes."),
    "mcp": ("osc2tx.cli.mcp:mcp", "Serve language models: check, build, run and look up."),
    "explain": ("osc2tx.cli.explain:explain", "Explain a diagnostic code."),
}

PRINTED_BY_CLICK = frozenset(["-h", "--help", "--version"])


class Commands(click.Group):
    """The group of commands; each is loaded on demand."""

    def list_commands(self, context: click.Context) -> list[str]:
        """Return the names in the order of the help page."""
        return list(COMMANDS)

    def format_commands(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list of commands without loading them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, help) for name, (_, help) in COMMANDS.items()])

    def resolve_command(
        self, context: click.Context, arguments: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that a command line names; offer the nearest if there is none."""
        name = arguments[0]
        if name not in COMMANDS and not name.startswith("-"):
            meant = did_you_mean(name, COMMANDS)
            context.fail(f"there is no command `{name}`" + (f"; {meant}" if meant else ""))
        return super().resolve_command(context, arguments)

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


def main(arguments: Sequence[str] | None = None, answer: Answer | None = None) -> NoReturn:
    """Run the command line and end the process.

    Args:
        arguments: The command line; that of the process if left out.
        answer: Where the answer to it is kept, if it is one to keep.
    """
    session = Session(answer=answer)
    code = _exit_code(sys.argv[1:] if arguments is None else arguments, session)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # nothing is left to interrupt
    sys.exit(code)


def _exit_code(arguments: Sequence[str], session: Session) -> int:
    try:
        if PRINTED_BY_CLICK.intersection(arguments):
            expect_output()
        return _run(arguments, session)
    except OutputError as error:
        return explain_output(error)


def _run(arguments: Sequence[str], session: Session) -> int:
    try:
        code = cli.main(list(arguments), prog_name="osc2tx", standalone_mode=False, obj=session)
        return int(code or Exit.OK)
    except click.ClickException as error:
        _explain_usage(error)
        return _fail(error.exit_code, error.format_message(), arguments, session)
    except click.Abort:
        return Exit.INTERRUPTED
    except (ConfigError, InputError) as error:
        complain(f"osc2tx: error: {error}")
        unreadable = isinstance(error, InputError) and error.unreadable
        code = Exit.UNREADABLE if unreadable else Exit.USAGE
        return _fail(code, str(error), arguments, session)
    except OutputError:
        raise
    except SystemExit as end:  # click's answer to a reader of its help page that has gone is 1
        return READER_HAS_GONE if end.code == 1 else Exit.OK
    except OSError as error:  # the folder that we work in is gone, the disk is full
        complain(f"osc2tx: error: {error}")
        return _fail(Exit.UNREADABLE, str(error), arguments, session)
    except Exception:  # the edge of the process: a bug must not look like exit code 1, stale
        from traceback import format_exc

        put(format_exc(), err=True)
        complain(BUG_REPORT)
        return _fail(Exit.BUG, "internal error of osc2tx", arguments, session)


def _explain_usage(error: click.ClickException) -> None:
    """Print the usage of a command, and the error in this use of it."""
    context = error.ctx if isinstance(error, click.UsageError) else None
    if context is not None:
        put(context.get_usage(), err=True)
        put(f"Try '{context.command_path} --help' for help.\n\n", err=True)
    complain(f"Error: {error.format_message()}")


def _fail(code: int, message: str, arguments: Sequence[str], session: Session) -> int:
    """Report to a program that expects a document why there is none; return the exit code."""
    report_failure(message, arguments, session)
    return code
