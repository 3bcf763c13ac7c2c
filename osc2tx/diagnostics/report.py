"""Report of a run: its diagnostics in the order and number in which they are shown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from pathlib import Path

from osc2tx.diagnostics.model import Diagnostic, Severity
from osc2tx.diagnostics.source import SourceFile
from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass, replace

LEVELS = ("concrete", "logical", "abstract")  # of scenarios (§6.3)
MOST_FILES_APART = 5  # with the same diagnostic; of more, it is shown once


@dataclass(frozen=True, slots=True)
class ScenarioEntry:
    """A scenario of a file.

    Attributes:
        source: The file.
        name: Its name.
        level: Its level (§6.3).
        open: Its open choices.
        summary: All this in one line.
        is_runnable: Whether it can run by itself and no other one of the file invokes it.
        values: The values that it fixes, by path, as in the source.
    """

    source: SourceFile
    name: str
    level: str
    open: tuple[str, ...]
    summary: str = ""
    is_runnable: bool = False
    values: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class FileFault:
    """A finding about a file as a whole, such as a stale output.

    Attributes:
        file: The file, relative to the folder of the reader.
        rule: The check that found it: `stale-output`, `changed-output` or `not-formatted`.
        message: Description.
        diff: The correction as a diff, if requested.
    """

    file: str
    rule: str
    message: str
    diff: str | None = None

    @property
    def is_error(self) -> bool:
        """Whether it is an error: a difference from a revision is none."""
        return self.rule != "changed-output"


@dataclass(frozen=True, slots=True)
class Report:
    """The diagnostics to show, and their number.

    Attributes:
        diagnostics: The diagnostics to show, by file and position.
        hidden: For each file with more than is shown, the number of the others.
        files: Number of requested source files.
        errors: How many errors there are, shown or not.
        warnings: The same for warnings.
        suppressed: How many warnings are kept back by comments.
        folder: Where the reader works; files below it are cited relative to it.
        scenarios: The scenarios of these files, with their levels.
        failure: Why osc2tx did not begin, if it did not.
        faults: Errors of files as a whole.
    """

    diagnostics: tuple[Diagnostic, ...] = ()
    hidden: Mapping[str, int] = field(default_factory=dict)
    files: int = 0
    errors: int = 0
    warnings: int = 0
    suppressed: int = 0
    folder: Path | None = None
    scenarios: tuple[ScenarioEntry, ...] = ()
    failure: str | None = None
    faults: tuple[FileFault, ...] = ()


def make_report(
    found: Iterable[Diagnostic],
    *,
    files: int,
    suppressed: int = 0,
    folder: Path | None = None,
    most_shown: int = 0,
    is_for_readers: bool = False,
) -> Report:
    """Order diagnostics and keep the first of each file.

    Args:
        found: All diagnostics.
        files: Number of requested source files.
        suppressed: Number of suppressed warnings.
        folder: Where the reader works.
        most_shown: How many diagnostics of one file are shown; 0 shows all.
        is_for_readers: Whether a diagnostic that many files have is shown once.
    """
    names: dict[SourceFile, str] = {}

    def file_of(diagnostic: Diagnostic) -> str:
        if diagnostic.primary is None:
            return ""
        source = diagnostic.primary.source
        if source not in names:
            names[source] = display_name(source, folder)
        return names[source]

    def place(diagnostic: Diagnostic) -> tuple[str, int, bool, str]:
        start = diagnostic.primary.start if diagnostic.primary else 0
        is_warning = diagnostic.severity is Severity.WARNING
        return file_of(diagnostic), start, is_warning, diagnostic.code

    ordered = sorted(found, key=place)
    counts: Counter[str] = Counter()
    shown: list[Diagnostic] = []
    candidates = _with_one_cause(ordered, file_of) if is_for_readers else ordered
    for diagnostic in candidates:
        file = file_of(diagnostic)
        counts[file] += 1
        if not most_shown or counts[file] <= most_shown:
            shown.append(diagnostic)
    severities = Counter(diagnostic.severity for diagnostic in ordered)
    return Report(
        diagnostics=tuple(shown),
        hidden={
            file: count - most_shown
            for file, count in counts.items()
            if most_shown and count > most_shown
        },
        files=files,
        errors=severities[Severity.ERROR],
        warnings=severities[Severity.WARNING],
        suppressed=suppressed,
        folder=folder,
    )


def _with_one_cause(
    ordered: Sequence[Diagnostic], file_of: Callable[[Diagnostic], str]
) -> Iterator[Diagnostic]:
    """Yield diagnostics; one that many files have comes once, with the first places of others."""
    groups: dict[tuple[str, str], list[Diagnostic]] = {}
    for diagnostic in ordered:
        groups.setdefault((diagnostic.code, diagnostic.message), []).append(diagnostic)
    files_of = {key: frozenset(map(file_of, group)) for key, group in groups.items()}
    for diagnostic in ordered:
        group = groups[diagnostic.code, diagnostic.message]
        files = files_of[diagnostic.code, diagnostic.message]
        if len(files) <= MOST_FILES_APART:
            yield diagnostic
        elif diagnostic is group[0]:
            others: dict[str, int] = {}
            for each in group:
                if each.primary is not None and file_of(each) != file_of(diagnostic):
                    others.setdefault(file_of(each), each.primary.line)
            places = [f"{file}:{line}" for file, line in others.items()]
            first = ", ".join(places[:MOST_FILES_APART])
            note = f"the same {len(group)} times in {len(files)} files: also {first}, …"
            yield replace(diagnostic, notes=(*diagnostic.notes, note))


def display_name(source: SourceFile, folder: Path | None) -> str:
    """Return how to cite a file to a reader in `folder`."""
    if folder is None or source.path is None:
        return source.name
    path = real_path(source.path.parent) / source.path.name  # a link is cited, not its goal
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else str(path)
