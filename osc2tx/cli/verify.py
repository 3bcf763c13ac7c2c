"""`osc2tx verify`: checks a finished trace against its scenario."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.cli.options import compile_options
from osc2tx.cli.reporting import Exit, Reporter, Session
from osc2tx.cli.run import choose_scenario
from osc2tx.compilation.inputs import InputError
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import GivenOptions
from osc2tx.module_loading import scenarios_of_file, scenarios_of_module
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.errors import InputError as UnreadableError
from osc2tx_runtime.errors import coded
from osc2tx_runtime.running.verification import RecordedRun, Verification, read_trace
from osc2tx_runtime.running.verification import verify as check
from osc2tx_shared.text import complain, put, say

if TYPE_CHECKING:
    from osc2tx_runtime import Scenario


@click.command()
@click.argument("trace", metavar="TRACE", type=click.Path(path_type=Path, dir_okay=False))
@click.argument(
    "file", metavar="[FILE]", required=False, type=click.Path(path_type=Path, dir_okay=False)
)
@click.option(
    "--map-path", type=Path, multiple=True, metavar="PATH", help="Folder with maps, or the map."
)
@click.option("--form", type=click.Choice(("text", "json")), default="text", help="What to print.")
@compile_options
def verify(
    trace: Path, file: Path | None, map_path: tuple[Path, ...], form: str, given: GivenOptions
) -> Exit:
    """Check whether the conditions of a scenario hold in a finished TRACE.

    Its modifiers are checked on the states of the trace, as in a run. FILE is the scenario or its
    module; by default the one that the trace names, beside the trace or in the current folder. The
    exit code is 5 if a condition fails its phase.
    """
    try:
        run = read_trace(trace)
        source = file or _find(trace, str(run.header.get("source", "")))
        found = _verified(run, source, (*map_path, source.parent), given)
    except UnreadableError as error:
        complain(f"osc2tx: error: {error}")
        return Exit.UNREADABLE
    if isinstance(found, Exit):
        return found
    if form == "json":
        _print_json(trace, run, found)
    else:
        _print_text(str(run.header.get("scenario", "")), run, found, source)
    return Exit.FAILED if found.fails else Exit.OK


def _find(trace: Path, name: str) -> Path:
    """Return the scenario file that a trace names.

    Raises:
        InputError: It is nowhere.
    """
    for folder in (trace.parent, Path()):
        for place in (folder / name, folder / Path(name).name):
            if name and place.is_file():
                return place
    raise InputError(f"{trace}: its scenario `{name}` is not found; name the file")


def _verified(
    run: RecordedRun, source: Path, map_path: Sequence[Path], given: GivenOptions
) -> Verification | Exit:
    """Check a trace; an exit code if there is no scenario to check it against."""
    try:
        if source.suffix == ".py":
            with scenarios_of_file(source, f"osc2tx_verify_{source.stem}") as scenarios:
                return check(run, _chosen(scenarios, run, source), map_path)
        (compilation,) = compile_all([source], given)
        bugs = run_all([compilation], lambda item: item.module)
        reporter = Reporter(Session(), is_quiet=True)
        code, _ = reporter.report([compilation], bugs)
        if code is not Exit.OK:
            return code
        if compilation.module is None:
            raise click.UsageError(f"{source} declares no scenario")
        with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
            return check(run, _chosen(scenarios, run, source), map_path)
    except UnreadableError:
        raise
    except ScenarioError as error:
        complain(error.report(str(run.header.get("source", "")), str(source)))
        return Exit(error.exit_code)


def _chosen(
    scenarios: Mapping[str, type[Scenario]], run: RecordedRun, source: Path
) -> type[Scenario]:
    return choose_scenario(scenarios, str(run.header.get("scenario")), source)


def _print_text(name: str, run: RecordedRun, found: Verification, source: Path) -> None:
    file, given = str(run.header.get("source", "")), str(source)
    for each in found.violations:
        say(coded(each.code, str(each), each.source, file, given))
    failures = sum(each.severity == "failure" for each in found.violations)
    warnings = len(found.violations) - failures
    verdict = "failure" if found.fails else "success"
    say(
        f"{name}: {verdict}: {found.phases} phase{'s' * (found.phases != 1)},"
        f" {failures} failure{'s' * (failures != 1)}, {warnings} warning{'s' * (warnings != 1)}"
    )


def _print_json(trace: Path, run: RecordedRun, found: Verification) -> None:
    document = {
        "version": 1,
        "trace": str(trace),
        "scenario": run.header.get("scenario"),
        "status": "failure" if found.fails else "success",
        "phases": found.phases,
        "violations": [{**each.words(), "source": each.source} for each in found.violations],
    }
    put(json.dumps(document, indent=2))
