"""Result of compiling one file, as plain data for processes and the cache."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from functools import partial
from pathlib import Path, PurePath
from typing import TYPE_CHECKING

from osc2tx.building.jobs import Job, RunTexts, find_bug
from osc2tx.building.severities import Severities
from osc2tx.compilation.file_reports import LossEntry
from osc2tx.diagnostics import Diagnostic, SourceFile, Span
from osc2tx.diagnostics.report import ScenarioEntry
from osc2tx.support.records import digest
from osc2tx_shared.classes import dataclass, replace

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Compilation, Memory, Output
    from osc2tx.compilation.imports import Lookup
    from osc2tx.compilation.uses import UsedFile
    from osc2tx.config import ConfigFiles
    from osc2tx.options import CompileOptions
    from osc2tx.support.records import Records

SUFFIX = ".osc"
GRADING = "OSC518"  # code of errors about documents that were played


@dataclass(frozen=True, slots=True)
class OutputRecord:
    """An output as far as it is known.

    Attributes:
        suffix: What follows the stem of the source.
        digest: Digest of the text.
        text: The text; `None` if only an earlier build had it in hand.
    """

    suffix: str
    digest: str
    text: str | None


class Detail(StrEnum):
    """What of an imported file a result depends on."""

    TEXT = "text"  # all, as it is copied or reported on
    USES = "uses"  # the declarations that are used


@dataclass(frozen=True, slots=True)
class Dependency:
    """A place where an imported file was looked for.

    Attributes:
        asked: The place.
        found: The same with links followed; empty if no file can have such a name.
        digest: Digest of the text there; `None` if there was no file.
        detail: What of the text counts.
    """

    asked: str
    found: str
    digest: str | None
    detail: Detail


@dataclass(frozen=True, slots=True)
class ImportedFile:
    """A file that was compiled by itself, because another one imports its declarations.

    Attributes:
        path: The file.
        name: Its name.
        options: The options it was compiled with.
        is_needed: Whether its module is needed.
    """

    path: str
    name: str
    options: CompileOptions
    is_needed: bool


@dataclass(frozen=True, slots=True)
class FileResult:
    """The outcome of one source file.

    Attributes:
        job: The task.
        source: The text; `None` if it could not be read.
        reports: The diagnostics of the stages.
        is_complete: Whether all stages that can report something ran and found no error.
        scenarios: The scenarios, with their levels.
        stem: The common prefix of the names of the outputs.
        outputs: The files that the source makes.
        losses: Grades of the scenarios in OpenSCENARIO XML.
        dependencies: Where imports were looked for; `None` if the result depends on more than
            that, so that it must not be used again.
        bug: An internal error of osc2tx.
        imported: The files that the module imports from, or would import from if it could.
        uses: Digest of the parts of imported files that the source uses.
    """

    job: Job
    source: SourceFile | None
    reports: tuple[Diagnostic, ...]
    is_complete: bool
    scenarios: tuple[ScenarioEntry, ...]
    stem: str
    outputs: tuple[OutputRecord, ...]
    losses: tuple[LossEntry, ...]
    dependencies: tuple[Dependency, ...] | None
    bug: str = ""
    imported: tuple[ImportedFile, ...] = ()
    uses: str = ""

    @property
    def start(self) -> Span:
        """The place of what concerns the file as a whole, even if there is no text."""
        return Span(self.source or SourceFile(self.job.name, "", self.job.path), 0, 0)


def compile_job(
    job: Job, memory: Memory | None = None, findings: Records | None = None
) -> FileResult:
    """Compile a file to its outputs; a mistake of one back end costs only what that one makes.

    Args:
        job: What to compile.
        memory: What other jobs found out about imported files; it grows.
        findings: Findings of earlier builds about documents.
    """
    compilation = job.compilation(memory, findings=findings)
    bug = find_bug(compilation, lambda item: item.is_supported)
    if bug:
        return _result(job, compilation, bug)
    outputs: list[Output] = []
    losses: list[LossEntry] = []

    def write_xml(item: Compilation) -> None:
        outputs.extend(item.xml_outputs())
        losses.extend(item.losses)

    bugs = (
        find_bug(compilation, lambda item: outputs.extend(item.module_outputs()), "the module"),
        find_bug(compilation, write_xml, "OpenSCENARIO XML"),
    )
    bug = "\n".join(filter(None, bugs))
    return _result(job, compilation, bug, outputs=outputs, losses=tuple(losses))


def check_job(job: Job, memory: Memory | None = None) -> FileResult:
    """Run all stages on a file that can report something; it makes no outputs."""
    compilation = job.compilation(memory)
    return _result(job, compilation, find_bug(compilation, partial(check, run=job.run)))


def check(compilation: Compilation, run: RunTexts = ()) -> None:
    """Run all stages that can report something, and prepare runs of what has no errors.

    Args:
        compilation: The file.
        run: The options of runs that are stated for it.
    """
    if compilation.check():
        from osc2tx.building.refused_starts import report_refused_starts

        report_refused_starts(compilation, run)


def failed_job(job: Job, bug: str) -> FileResult:
    """Return the result of a compilation that never came to its end."""
    source = job.compilation().source
    return FileResult(job, source, (), False, (), "", (), (), None, bug)


def _result(
    job: Job,
    compilation: Compilation,
    bug: str,
    *,
    outputs: Sequence[Output] = (),
    losses: tuple[LossEntry, ...] = (),
) -> FileResult:
    dependencies = None if bug else _dependencies(compilation)
    return FileResult(
        job=job,
        source=compilation.source,
        reports=compilation.reports,
        is_complete=compilation.is_complete,
        scenarios=compilation.scenarios,
        stem=compilation.stem if outputs else "",
        outputs=tuple(
            OutputRecord(output.suffix, digest(output.text.encode()), output.text)
            for output in outputs
        ),
        losses=losses,
        dependencies=dependencies,
        bug=bug,
        imported=() if bug else _imported(compilation),
        uses=_uses(compilation, dependencies or ()),
    )


def _imported(compilation: Compilation) -> tuple[ImportedFile, ...]:
    from osc2tx.compilation.needed_modules import all_compiled_alone, siblings_of

    alone = all_compiled_alone(compilation)
    needed = {each.name for each in siblings_of(compilation)} if alone else set()
    return tuple(
        ImportedFile(str(each.path), each.name, each.options, each.name in needed) for each in alone
    )


def _lookups(compilation: Compilation) -> Mapping[Path, Lookup]:
    lookups = dict(compilation.lookups)
    for alone in compilation.compiled_alone.values():
        lookups |= alone.lookups
    return lookups


def _dependencies(compilation: Compilation) -> tuple[Dependency, ...] | None:
    lookups = _lookups(compilation)
    is_refused = any(lookup.is_refused for lookup in lookups.values())
    if compilation.source is None or compilation.depends_on_packages or is_refused:
        return None
    if not lookups:
        return ()  # which needs none of the modules that find out what is used
    from osc2tx.compilation.uses import whole_files

    exact = {str(path) for path in whole_files(compilation)}
    is_partial = compilation.is_complete and all(not r.help for r in compilation.reports)
    return tuple(
        Dependency(
            str(asked),
            lookup.path,
            None if lookup.text is None else digest(lookup.text.encode()),
            (
                Detail.USES
                if is_partial and asked.suffix == SUFFIX and lookup.path not in exact
                else Detail.TEXT
            ),
        )
        for asked, lookup in lookups.items()
    )


def _uses(compilation: Compilation, dependencies: Sequence[Dependency]) -> str:
    if compilation.source is None or not any(d.detail is Detail.USES for d in dependencies):
        return ""
    from osc2tx.compilation.uses import used_digest

    texts = {lookup.path: lookup.text or "" for lookup in _lookups(compilation).values()}
    files = used_files(dependencies, texts.__getitem__)
    return used_digest(compilation.source.text, files, compilation.options.dialect)


def used_files(dependencies: Iterable[Dependency], text_of: Callable[[str], str]) -> list[UsedFile]:
    """Return the files on whose used parts a result depends.

    Args:
        dependencies: All places that were looked at.
        text_of: Returns the text of a file, links followed.
    """
    from osc2tx.compilation.uses import UsedFile

    wanted = (d for d in dependencies if d.detail is Detail.USES and d.digest is not None)
    paths = dict.fromkeys(each.found for each in wanted)
    return [UsedFile(PurePath(path).name, text_of(path)) for path in paths]


def with_severities(results: Sequence[FileResult], configs: ConfigFiles) -> list[FileResult]:
    """Return results with the warnings that settings ignore left out, or made errors."""
    judged = Severities(configs)
    return [
        replace(result, reports=tuple(filter(None, map(judged, result.reports))))
        for result in results
    ]


def without_grading(result: FileResult) -> FileResult:
    """Return a result without what only a build finds out, as it plays documents."""
    return replace(result, reports=tuple(r for r in result.reports if r.code != GRADING))
