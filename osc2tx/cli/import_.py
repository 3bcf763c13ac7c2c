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
from osc2tx.importing.batch import Batch
from osc2tx.importing.document import Folders, Refused
from osc2tx.importing.importer import Imported
from osc2tx.importing.libraries import COMMON, Library
from osc2tx.importing.parameters import Parameter
from osc2tx.importing.report import ImportReport, Measured
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx_runtime import ScenarioError
from osc2tx_shared.classes import dataclass, replace
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
    """

    imported: Imported
    text: str
    faults: tuple[str, ...] = ()


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

    Each document becomes NAME.osc, with a report of exactness, NAME.import.json; what it takes from
    catalogs is in common.osc, which all scenarios share. `-` is standard input. An existing
    scenario or library with another text is only replaced with --force.

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

    The scenarios that distributions name are written as well.

    Args:
        sources: The documents; `None` for standard input.
        out: Folder of the scenarios.
        folders: Where maps and catalogs are.
        name: The name of the only scenario.
        force: Whether to replace scenarios and libraries that have another text.
    """
    batch = Batch(folders)
    results: list[Result] = []
    refused = 0
    for found in batch.run(sources, name):
        if isinstance(found, Refused):
            where = f"{found.source or 'standard input'}:{found.place or ''}".rstrip(":")
            complain(f"{where}: {found.reason}")
            refused += 1
        else:
            results.append(Result(found, found.text))
    out.mkdir(parents=True, exist_ok=True)
    kept = [] if _put_library(batch.library, out, force=force) else [out]
    for base in batch.bases:
        if not _put(path := out / f"{base.name}.osc", base.text, force=force):
            kept.append(path)
    for number, result in enumerate(results):  # each beside what it imports
        results[number] = each = _checked(result, out)
        path = out / f"{each.imported.name}.osc"
        if _put(path, each.text, force=force):
            write_text(out / f"{each.imported.name}.import.json", each.imported.report.to_json())
        else:
            kept.append(path)
    write_settings([each.imported for each in results], out)
    return results, refused + len(kept)


def _put_library(library: Library, out: Path, *, force: bool) -> bool:
    """Write the library with what its file has of other documents; return whether it has all."""
    if not library.lines:
        return True
    path = out / f"{COMMON}.osc"
    before = path.read_text(encoding="utf-8") if path.is_file() else library.text
    beside = library.beside(before)
    return _put(path, beside or library.text, force=force or beside is not None)


def _put(path: Path, text: str, *, force: bool) -> bool:
    """Write a file unless it exists with another text; return whether it has the text."""
    if force or not path.exists() or path.read_bytes() == text.encode():
        write_text(path, text)
        return True
    complain(f"{path}: exists with another text and is kept; --force replaces it")
    return False


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
    return replace(result, text=text, faults=faults)


def _measure(result: Result, compilation: Compilation) -> None:
    """Add the deviation of a run of the scenario from its document to the report."""
    imported, given, drawn = result.imported, {}, {}
    if (values := imported.distribution) is not None:
        given = drawn = values.first
        if imported.program.base:  # which a value that is the only one is a constant of
            drawn = {said: text for said, text in given.items() if values.open[said].is_open}
    try:
        with scenarios_of_module(compilation.whole_module()) as scenarios:
            found = import_deviation(
                imported.document.resolved_with(given),
                imported.document.map_file,
                scenarios[imported.name],
                imported.actors,
                _in_si_units(drawn, imported.parameters),
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


# --- the summary ----------------------------------------------------------------------------------


def _sum_up(results: Sequence[Result], form: str) -> None:
    if form == "json":
        documents = [json.loads(each.imported.report.to_json()) for each in results]
        put_document(json.dumps(documents, indent=1, ensure_ascii=False) + "\n")
        return
    grades: Counter[str] = Counter()
    told: set[str] = set()
    for each in results:
        report = each.imported.report
        grades[report.grade] += 1
        name = f"{each.imported.name}.osc"
        # what a scenario inherits has been told of the one that it is in
        findings = [text for text in _findings(report) if text not in told]
        told.update(findings)
        for text in findings[:MOST_SHOWN]:
            say(text)
        if (more := len(findings) - MOST_SHOWN) > 0:
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


def _findings(report: ImportReport) -> Iterator[str]:
    """Yield the findings of a document as lines."""
    for finding in report.ordered:
        what = f"{finding.grade}: {finding.construct}: {finding.reason}"
        at = (finding.file or report.source, str(finding.place or ""))
        yield f"{':'.join(filter(None, at))}: {what}"


def _sum_up_runs(reports: Sequence[ImportReport]) -> None:
    """Print the number of runs that equal their documents, and why others were not compared."""
    runs = [each.measured for each in reports if each.measured is not None]
    same = sum(1 for each in runs if each.is_exact)
    for each in reports:
        if each.measured is None:
            say(f"{each.source}: not run against the document: {each.unmeasured}")
    if runs:
        say(f"{count_of(len(runs), 'scenario')} run against the documents: {same} the same")
