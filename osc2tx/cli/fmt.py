"""`osc2tx fmt`."""

from __future__ import annotations

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.building.write import replace_file
from osc2tx.cli.differences import print_diff
from osc2tx.cli.options import compile_options
from osc2tx.config import GivenOptions
from osc2tx.driver import Compilation
from osc2tx.reporting import Exit, Reporter, complain, count_of, report_options


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True, type=click.Path())
@click.option("--check", "check_only", is_flag=True, help="Write nothing; fail if a file differs.")
@click.option("--diff", "show_diff", is_flag=True, help="Write nothing; print what would change.")
@compile_options
@report_options
def fmt(
    paths: tuple[str, ...],
    check_only: bool,
    show_diff: bool,
    given: GivenOptions,
    reporter: Reporter,
) -> Exit:
    """Lay scenario files out in the style of the standard; folders are searched for .osc files.

    Tokens and comments stay what they are. Files with syntax errors are not touched.
    """
    if show_diff and reporter.form != "text":
        raise click.UsageError("--diff and --output-format both print to standard output")
    compilations = compile_all(paths, given)
    bugs = run_all(compilations, lambda compilation: compilation.formatted)
    code, _ = reporter.report(compilations, bugs)
    changed = [compilation for compilation in compilations if _changes(compilation)]
    for compilation in changed:
        if show_diff:
            text = compilation.path.read_bytes().decode("utf-8")
            print_diff(str(compilation.path), text, compilation.formatted)
        elif check_only:
            complain(f"{compilation.path}: is not formatted")
        else:
            code = max(code, _write(compilation))
    would = "would be " if check_only or show_diff else ""
    total = count_of(len(compilations), "file")
    say = complain if show_diff else reporter.say
    say(f"{len(changed)} of {total} {would}formatted")
    return max(code, Exit.STALE) if changed and (check_only or show_diff) else code


def _changes(compilation: Compilation) -> bool:
    if "formatted" not in vars(compilation) or compilation.formatted is None:
        return False
    return compilation.path.read_bytes() != compilation.formatted.encode()


def _write(compilation: Compilation) -> Exit:
    assert compilation.formatted is not None
    try:
        replace_file(compilation.path.resolve(), compilation.formatted.encode())
    except OSError as error:
        complain(f"{compilation.path}: cannot be written: {error.strerror}")
        return Exit.UNREADABLE
    return Exit.OK
