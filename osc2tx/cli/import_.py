"""`osc2tx import`."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import click

from osc2tx.cli.import_settings import write_settings, write_text
from osc2tx.cli.reporting import Exit, count_of
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Severity
from osc2tx.grading.imports import import_deviation
from osc2tx.grading.runs import NoEvidence
from osc2tx.importing.distributions import Distribution
from osc2tx.importing.document import Folders, Refused
from osc2tx.importing.importer import Imported
from osc2tx.importing.libraries import Libraries
from osc2tx.importing.names import snake
from osc2tx.importing.parameters import Parameter
from osc2tx.importing.reading import import_file
from osc2tx.importing.report import ImportReport, Measured
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx_runtime import ScenarioError
from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import complain, put_document, say

INPUT = "-"
SUFFIX = ".xosc"
MOST_SHOWN = 10


@dataclass(frozen=True, slots=True)
class Result:
    """A document that was imported.

    Attributes:
        imported: The scenario.
        text: Its text, formatted.
        faults: Errors that a check of it finds.
        distribution: Values for its runs.
    """

    imported: Imported
    text: str
    faults: tuple[str, ...]
    distribution: Distribution | None = None


@click.command(name="import")
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option(
    "-o",
    "--out",
    metavar="DIR",
    type=click.Path(path_type=Path, file_okay=False),
    required=True,
    help="Folder of the scenarios.",
)
@click.option(
    "--map-path",
    "maps",
    metavar="DIR",
    multiple=True,
    type=click.Path(path_type=Path),
    help="Folder with maps, besides those of the documents.",
)
@click.option(
    "--catalog-path",
    "catalogs",
    metavar="DIR",
    multiple=True,
    type=click.Path(path_type=Path),
    help="Folder of catalogs, besides those of the documents.",
)
@click.option(
    "--scenario-name", metavar="NAME", help="Name of the scenario; for a single document."
)
@click.option("--force", is_flag=True, help="Replace scenarios and libraries that were changed.")
@click.option("--allow-approx", is_flag=True, help="Accept approximations and omissions.")
@click.option(
    "--output-format",
    "form",
    type=click.Choice(("text", "json")),
    default="text",
    show_default=True,
    help="Form of the summary.",
)
def import_(
    paths: tuple[str, ...],
    out: Path,
    maps: tuple[Path, ...],
    catalogs: tuple[Path, ...],
    scenario_name: str | None,
    force: bool,
    allow_approx: bool,
    form: str,
) -> Exit:
    """Make scenarios of OpenSCENARIO XML documents; folders are searched for .xosc files.

    Each document becomes NAME.osc, with a report of exactness, NAME.import.json; each catalog that
    is used becomes a library file. `-` is standard input. An existing scenario or library with
    another text is only replaced with --force.

    The exit code is 0 if all is exact, 3 if not (0 with --allow-approx), 4 if a document cannot be
    read.
    """
    sources = list(_sources(paths))
    if scenario_name is not None and len(sources) != 1:
        raise click.UsageError("--scenario-name is for one document")
    found = Folders(maps, catalogs)
    results, refused = import_all(sources, out, found, scenario_name, force=force)
    _sum_up(results, form)
    if refused:
        return Exit.UNREADABLE
    inexact = any(each.imported.report.grade != "exact" for each in results)
    if any(each.faults for each in results) or (inexact and not allow_approx):
        return Exit.ERRORS
    return Exit.OK


def import_all(
    sources: Sequence[Path | None],
    out: Path,
    folders: Folders,
    name: str | None = None,
    *,
    force: bool = False,
) -> tuple[list[Result], int]:
    """Write the scenarios of documents; return them, and how many documents were refused.

    Args:
        sources: The documents; `None` for standard input.
        out: Folder of the scenarios.
        folders: Where maps and catalogs are.
        name: The name of the only scenario.
        force: Whether to replace scenarios and libraries that have another text.
    """
    libraries: Libraries = {}
    results: list[Result] = []
    refused = 0
    names: set[str] = set()
    for source in sources:
        said = name or ("scenario" if source is None else source.stem)
        while snake(said) in names:
            said += "_2"
        names.add(snake(said))
        try:
            found = import_file(source, said, libraries, folders)
        except Refused as error:
            where = f"{source or 'standard input'}:{error.place or ''}".rstrip(":")
            complain(f"{where}: {error.reason}")
            refused += 1
            continue
        if found is not None:
            results.append(Result(found[0], found[0].text, (), found[1]))
    out.mkdir(parents=True, exist_ok=True)
    written = {out / f"{library.name}.osc": library.text for library in libraries.values()}
    kept = {} if force else _texts_of_others(written)
    for path in written.keys() - kept.keys():
        write_text(path, written[path])
    checked = [_checked(each, out) for each in results]
    scenarios = {out / f"{each.imported.name}.osc": each.text for each in checked}
    kept |= {} if force else _texts_of_others(scenarios)
    for path in kept:
        complain(f"{path}: exists with another text and is kept; --force replaces it")
    for each in checked:
        path = out / f"{each.imported.name}.osc"
        if path in kept:
            continue
        write_text(path, each.text)
        write_text(out / f"{each.imported.name}.import.json", each.imported.report.to_json())
    write_settings([(each.imported, each.distribution) for each in checked], out)
    return checked, refused + len(kept)


def import_folder(folder: Path, out: Path) -> Exit:
    """Import the documents of a folder into a new project; inexact ones are reported only."""
    results, refused = import_all(list(_sources((str(folder),))), out, Folders())
    _sum_up(results, "text")
    return Exit.UNREADABLE if refused else Exit.OK


def _sources(paths: Sequence[str]) -> Iterator[Path | None]:
    for path in paths:
        if path == INPUT:
            yield None
        elif Path(path).is_dir():
            found = sorted(Path(path).rglob(f"*{SUFFIX}"))
            if not found:
                raise click.UsageError(f"there is no {SUFFIX} file in {path}")
            yield from found
        else:
            yield Path(path)


def _checked(result: Result, out: Path) -> Result:
    """Return a result with its text formatted and checked beside the libraries."""
    place = out / f"{result.imported.name}.osc"
    first = Compilation(place, place.name, CompileOptions(), text=result.text)
    text = first.formatted or result.text
    compilation = Compilation(place, place.name, CompileOptions(), text=text)
    compilation.module  # noqa: B018 - the stages report to the sink
    faults = tuple(
        f"{each.code}: {each.message}"
        for each in compilation.sink.sorted()
        if each.severity is Severity.ERROR
    )
    if faults or compilation.ir is None:
        result.imported.report.measure(None, "the check of the scenario reports errors")
    else:
        _measure(result, compilation)
    return Result(result.imported, text, faults, result.distribution)


def _measure(result: Result, compilation: Compilation) -> None:
    """Add the deviation of a run of the scenario from its document to the report."""
    imported, given = result.imported, {}
    if result.distribution is not None:
        given = result.distribution.first
    try:
        with scenarios_of_module(compilation.whole_module()) as scenarios:
            found = import_deviation(
                imported.document.resolved_with(given),
                imported.document.map_file,
                scenarios[imported.name],
                imported.actors,
                _in_si_units(given, imported.parameters),
                imported.starts,
                is_endless=imported.is_endless,
            )
    except (NoEvidence, ScenarioError) as error:
        imported.report.measure(None, str(error))
        return
    measured = Measured(
        found.place, found.actor, found.at, found.time, found.is_exact, found.off_road
    )
    imported.report.measure(measured)


def _in_si_units(
    given: Mapping[str, str], parameters: Mapping[str, Parameter]
) -> dict[str, float | str]:
    """Return values of the document for the open parameters of the scenario."""
    return {
        parameters[said].name: float(text) * parameters[said].unit[1]
        for said, text in given.items()
        if said in parameters and parameters[said].is_used
    }


def _texts_of_others(files: Mapping[Path, str]) -> dict[Path, str]:
    """Return the files that exist with another text than the one to write."""
    found = {path: text for path, text in files.items() if path.exists()}
    return {path: text for path, text in found.items() if path.read_bytes() != text.encode()}


# --- the summary ----------------------------------------------------------------------------------


def _sum_up(results: Sequence[Result], form: str) -> None:
    if form == "json":
        documents = [json.loads(each.imported.report.to_json()) for each in results]
        put_document(json.dumps(documents, indent=1, ensure_ascii=False) + "\n")
        return
    grades: Counter[str] = Counter()
    for each in results:
        report = each.imported.report
        grades[report.grade] += 1
        name = f"{each.imported.name}.osc"
        for finding in report.ordered[:MOST_SHOWN]:
            what = f"{finding.grade}: {finding.construct}: {finding.reason}"
            at = (finding.file or report.source, str(finding.place or ""))
            say(f"{':'.join(filter(None, at))}: {what}")
        if (more := len(report.findings) - MOST_SHOWN) > 0:
            say(f"{report.source}: {more} more in {each.imported.name}.import.json")
        for fault in each.faults:
            complain(f"{name}: {fault}")
        if report.under_test:
            driven, one = ", ".join(report.under_test), report.under_test[0]
            hint = f"`osc2tx run --expect --ego {one}=MODULE:CLASS` drives it"
            say(f"{name}: under test: {driven} ({hint})")
    _sum_up_runs([each.imported.report for each in results])
    parts = ", ".join(f"{count} {grade}" for grade, count in sorted(grades.items()))
    say(f"{count_of(len(results), 'scenario')} imported" + (f": {parts}" if parts else ""))


def _sum_up_runs(reports: Sequence[ImportReport]) -> None:
    """Print the number of runs that equal their documents, and why others were not compared."""
    runs = [each.measured for each in reports if each.measured is not None]
    same = sum(1 for each in runs if each.is_exact)
    for each in reports:
        if each.measured is None:
            say(f"{each.source}: not run against the document: {each.unmeasured}")
    if runs:
        say(f"{count_of(len(runs), 'scenario')} run against the documents: {same} the same")
