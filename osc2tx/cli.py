"""The command line: arguments, messages, exit codes.

Exit codes: 0 ok (warnings included), 1 outputs are stale, or warnings under --strict, 2 wrong usage
or settings, 3 errors in a source, 4 unreadable input or unwritable output, 5 the scenario ran and
failed, 70 a bug of ours.
"""

from __future__ import annotations

import gc
import os
import sys
import traceback
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import click

from osc2tx import __version__
from osc2tx.config import ConfigError, GivenOptions
from osc2tx.diagnostics.lookup import find_code, meant_code
from osc2tx.diagnostics.render import render_explanation
from osc2tx.inputs import InputError
from osc2tx.options import DIALECTS, ONE_OF_POLICIES, PRODUCT_NAMES, STANDARDS, ProductName
from osc2tx.reporting import (
    BUG_REPORT,
    Exit,
    Reporter,
    complain,
    count_of,
    found,
    report_options,
)

if TYPE_CHECKING:
    from osc2tx.driver import Compilation

COMMANDS = {
    "check": "Report what is wrong with scenario files.",
    "build": "Write a py_trees module for every scenario file.",
    "run": "Run a scenario in the embedded world.",
    "explain": "Say what a diagnostic code means.",
}

Command = TypeVar("Command", bound=Callable[..., Any])


class Commands(click.Group):
    """The group of commands; `run` is only loaded when it is asked for, with the runtime."""

    def list_commands(self, context: click.Context) -> list[str]:
        """Return the names in the order of the help page."""
        return list(COMMANDS)

    def format_commands(self, context: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list of commands without loading them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def get_command(self, context: click.Context, name: str) -> click.Command | None:
        """Return a command by its name."""
        if name == "run":
            command: click.Command = import_module("osc2tx.run_command").run
            return command
        return super().get_command(context, name)


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="osc2tx")
def cli() -> None:
    """Compile OpenSCENARIO DSL into readable py_trees modules, and run them."""


def compile_options(command: Command) -> Command:
    """Add the options that say how to compile."""
    options = (
        click.option("--std", type=click.Choice(STANDARDS), help="Version of the standard."),
        click.option("--dialect", type=click.Choice(DIALECTS), help="Dialect of the sources."),
        click.option("--one-of", type=click.Choice(ONE_OF_POLICIES), help="Meaning of `one_of`."),
    )
    for option in reversed(options):
        command = option(command)
    return command


@cli.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@compile_options
@report_options
def check(
    paths: tuple[str, ...],
    std: str | None,
    dialect: str | None,
    one_of: str | None,
    reporter: Reporter,
) -> Exit:
    """Report what is wrong with scenario files; folders are searched for .osc files."""
    from osc2tx.build import compile_all, run_all

    compilations = compile_all(paths, GivenOptions(std, dialect, one_of))
    bugs = run_all(compilations, lambda compilation: compilation.check())
    code, report = reporter.report(compilations, bugs)
    for compilation in compilations:
        for level in compilation.levels:
            reporter.say(f"{compilation.name}: {level}")
    reporter.say(f"checked {count_of(len(compilations), 'file')}: {found(report)}")
    return code


@cli.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("-o", "--out", "out_dir", type=click.Path(path_type=Path), help="Output folder.")
@compile_options
@click.option("--target", type=click.Choice(["py"]), default="py", help="What to make.")
@click.option(
    "--emit",
    type=click.Choice(PRODUCT_NAMES),
    help="Print this product of the compiler and write nothing.",
)
@click.option("--check", "check_only", is_flag=True, help="Write nothing; fail if outputs differ.")
@report_options
def build(
    paths: tuple[str, ...],
    out_dir: Path | None,
    std: str | None,
    dialect: str | None,
    one_of: str | None,
    target: str,
    emit: ProductName | None,
    check_only: bool,
    reporter: Reporter,
) -> Exit:
    """Write a py_trees module for every scenario file."""
    given = GivenOptions(std, dialect, one_of)
    if emit is not None:
        if out_dir is not None or check_only:
            raise click.UsageError("--emit prints to the terminal: leave out -o and --check")
        if reporter.form != "text":
            raise click.UsageError("--emit and --output-format both print to standard output")
        return _print_product(paths, given, emit, reporter)
    if out_dir is None:
        raise click.UsageError("say where the modules go, as in `-o generated`")
    return _build(paths, out_dir, given, check_only, reporter)


def _build(
    paths: Sequence[str], out_dir: Path, given: GivenOptions, check_only: bool, reporter: Reporter
) -> Exit:
    from osc2tx.build import build as build_files

    result = build_files(paths, out_dir, given, check_only=check_only)
    code, report = reporter.report(result.compilations, result.bugs)
    if check_only:
        for state, path in result.changed:
            complain(f"{path}: is {state}")
    for problem in (*result.collisions, *result.failures):
        complain(problem)
    changed = count_of(len(result.changed), "file")
    done = f"{changed} would change" if check_only else f"{changed} written"
    modules = count_of(result.modules, "module")
    reporter.say(f"{modules} in {out_dir}: {done}; {found(report)}")
    if check_only and result.changed:
        code = max(code, Exit.STALE)
    if result.collisions:
        code = max(code, Exit.USAGE)
    return max(code, Exit.UNREADABLE) if result.failures else code


def _print_product(
    paths: Sequence[str], given: GivenOptions, emit: ProductName, reporter: Reporter
) -> Exit:
    from osc2tx.build import compile_all, run_all

    compilations = compile_all(paths, given)

    texts: list[str] = []

    def dump(compilation: Compilation) -> None:
        text = compilation.dump(emit)
        if text is not None:
            texts.append(f"# {compilation.path}\n{text}" if len(compilations) > 1 else text)

    bugs = run_all(compilations, dump)
    for text in texts:
        click.echo(text, nl=not text.endswith("\n"))
    return reporter.report(compilations, bugs)[0]


@cli.command()
@click.argument("code")
def explain(code: str) -> None:
    """Say what a diagnostic code means."""
    entry = find_code(code)
    if entry is None:
        meant = meant_code(code)
        raise click.UsageError(f"there is no code `{code}`" + (f"; {meant}" if meant else ""))
    click.echo(render_explanation(entry))


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and end the process."""
    code = _exit_code(arguments)
    gc.freeze()  # the process ends: nobody has to look for garbage in large trees
    sys.exit(code)


def _exit_code(arguments: Sequence[str] | None) -> int:
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a terminal may know fewer characters than a source
            stream.reconfigure(errors="backslashreplace")
    try:
        code = cli.main(arguments, prog_name="osc2tx", standalone_mode=False)
        sys.stdout.flush()
        return int(code or Exit.OK)
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except click.Abort:
        return 130
    except (ConfigError, InputError) as error:
        complain(f"osc2tx: error: {error}")
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
        return Exit.BUG
