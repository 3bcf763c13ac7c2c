"""The command line: arguments, messages, exit codes.

Exit codes: 0 ok (warnings included), 1 outputs are stale, 2 wrong usage or settings, 3 errors in
a source, 4 unreadable input or unwritable output, 5 the scenario ran and failed, 70 a bug of ours.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from enum import IntEnum
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import click

from osc2tx import __version__
from osc2tx.config import ConfigError, GivenOptions
from osc2tx.diagnostics import CODES, Code, Diagnostic, Severity
from osc2tx.diagnostics.render import render_all
from osc2tx.inputs import InputError
from osc2tx.options import DIALECTS, ONE_OF_POLICIES, PRODUCT_NAMES, STANDARDS, ProductName

if TYPE_CHECKING:
    from osc2tx.driver import Compilation

MOST_SHOWN = 100  # diagnostics of one file
BUG_REPORT = "osc2tx: this is a bug of osc2tx; please report it with the lines above"

COMMANDS = {
    "check": "Report what is wrong with scenario files.",
    "build": "Write a py_trees module for every scenario file.",
    "run": "Run a scenario in the embedded world.",
    "explain": "Say what a diagnostic code means.",
}

Command = TypeVar("Command", bound=Callable[..., Any])


class Exit(IntEnum):
    """What the process returns."""

    OK = 0
    STALE = 1
    USAGE = 2
    ERRORS = 3
    UNREADABLE = 4
    FAILED = 5
    BUG = 70


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
def check(paths: tuple[str, ...], std: str | None, dialect: str | None, one_of: str | None) -> Exit:
    """Report what is wrong with scenario files; folders are searched for .osc files."""
    from osc2tx.build import compile_all, run_all

    compilations = compile_all(paths, GivenOptions(std, dialect, one_of))
    bugs = run_all(compilations, lambda compilation: compilation.check())
    code = report(compilations, bugs)
    click.echo(f"checked {_count(len(compilations), 'file')}: {_found(compilations)}")
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
def build(
    paths: tuple[str, ...],
    out_dir: Path | None,
    std: str | None,
    dialect: str | None,
    one_of: str | None,
    target: str,
    emit: ProductName | None,
    check_only: bool,
) -> Exit:
    """Write a py_trees module for every scenario file."""
    given = GivenOptions(std, dialect, one_of)
    if emit is not None:
        if out_dir is not None or check_only:
            raise click.UsageError("--emit prints to the terminal: leave out -o and --check")
        return _print_product(paths, given, emit)
    if out_dir is None:
        raise click.UsageError("say where the modules go, as in `-o generated`")
    return _build(paths, out_dir, given, check_only)


def _build(paths: Sequence[str], out_dir: Path, given: GivenOptions, check_only: bool) -> Exit:
    from osc2tx.build import build as build_files

    result = build_files(paths, out_dir, given, check_only=check_only)
    code = report(result.compilations, result.bugs)
    if check_only:
        for state, path in result.changed:
            complain(f"{path}: is {state}")
    for problem in (*result.collisions, *result.failures):
        complain(problem)
    changed = _count(len(result.changed), "file")
    done = f"{changed} would change" if check_only else f"{changed} written"
    modules = _count(result.modules, "module")
    click.echo(f"{modules} in {out_dir}: {done}; {_found(result.compilations)}")
    if check_only and result.changed:
        code = max(code, Exit.STALE)
    if result.collisions:
        code = max(code, Exit.USAGE)
    return max(code, Exit.UNREADABLE) if result.failures else code


def _print_product(paths: Sequence[str], given: GivenOptions, emit: ProductName) -> Exit:
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
    return report(compilations, bugs)


@cli.command()
@click.argument("code")
def explain(code: str) -> None:
    """Say what a diagnostic code means."""
    slugs = {entry.slug: name for name, entry in CODES.items()}
    wanted = slugs.get(code.lower(), code.upper())
    if wanted not in CODES:
        near = get_close_matches(wanted, CODES, 1) or get_close_matches(code.lower(), slugs, 1)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise click.UsageError(f"there is no code {code}{hint}")
    click.echo(_explanation(CODES[wanted]))


def _explanation(entry: Code) -> str:
    lines = [f"{entry.code} {entry.slug} ({entry.severity.value})", "", entry.summary]
    if entry.section:
        lines.append(f"See OpenSCENARIO DSL 2.2, section {entry.section}.")
    if entry.example:
        lines += ["", "For example:", ""]
        lines += [f"    {line}" for line in entry.example.splitlines()]
    return "\n".join(lines)


def report(compilations: Sequence[Compilation], bugs: Sequence[str] = ()) -> Exit:
    """Print all diagnostics, and bugs of ours, and return the exit code they call for."""
    found = _distinct(compilations)
    counts: Counter[Path | str] = Counter()
    shown = []
    for diagnostic in found:
        file = _file_of(diagnostic)
        counts[file] += 1
        if counts[file] <= MOST_SHOWN:
            shown.append(diagnostic)
    if shown:
        color = sys.stderr.isatty() and "NO_COLOR" not in os.environ
        click.echo(render_all(shown, color=color, folder=Path.cwd()), err=True, color=color)
        for file, count in counts.items():
            if count > MOST_SHOWN:
                complain(f"{file}: {count - MOST_SHOWN} more not shown")
        click.echo(f"`osc2tx explain {shown[0].code}` says more about a code.", err=True)
    for bug in bugs:
        complain(bug)
    if bugs:
        complain(BUG_REPORT)
        return Exit.BUG
    if not all(compilation.is_readable for compilation in compilations):
        return Exit.UNREADABLE
    failed = any(compilation.sink.has_errors for compilation in compilations)
    return Exit.ERRORS if failed else Exit.OK


def _distinct(compilations: Sequence[Compilation]) -> list[Diagnostic]:
    """Return all diagnostics; one in a file that several others import counts once."""
    found: dict[tuple[object, ...], Diagnostic] = {}
    for compilation in compilations:
        for diagnostic in compilation.diagnostics:
            start = diagnostic.primary.start if diagnostic.primary else None
            key = (_file_of(diagnostic), start, diagnostic.code, diagnostic.message)
            found.setdefault(key, diagnostic)
    return list(found.values())


def _file_of(diagnostic: Diagnostic) -> Path | str:
    if diagnostic.primary is None:
        return ""
    source = diagnostic.primary.source
    return source.path.resolve() if source.path else source.name


def complain(message: str) -> None:
    """Print a message that belongs to no place in a source."""
    click.echo(message, err=True)


def _found(compilations: Sequence[Compilation]) -> str:
    severities = [diagnostic.severity for diagnostic in _distinct(compilations)]
    errors = severities.count(Severity.ERROR)
    warnings = severities.count(Severity.WARNING)
    return f"{_count(errors, 'error')}, {_count(warnings, 'warning')}"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and end the process."""
    sys.exit(_exit_code(arguments))


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
