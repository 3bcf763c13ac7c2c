"""Cache of results of builds and checks, in the user's cache folder.

There is one file for each output folder, and one for each folder in which somebody checks. A result
holds as long as the text of the source, the texts of all files that it imports, the places where
those would be found first, the options and osc2tx itself are the same. Contents count, never times,
but for the files of osc2tx: reading those would take longer than a check. Texts of outputs are not
kept, only their digests: they are in the output folder.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from osc2tx.building.fingerprint import digest, tool_stamp
from osc2tx.building.jobs import Job, options_of
from osc2tx.building.results import Dependency, FileResult, ImportedFile, OutputRecord, check_job
from osc2tx.building.stored_reports import ReportReader, ReportWriter
from osc2tx.compilation.file_reports import LossEntry
from osc2tx.diagnostics import SourceFile
from osc2tx_shared.cache import cache_folder, forget_the_oldest, read_own, write_own

FORMAT = 3
MOST_KEPT = 64  # folders that are remembered, of each kind
BYTE_ORDER_MARK = b"\xef\xbb\xbf"


class ResultCache:
    """What is remembered of the builds into one output folder, or of the checks in one folder."""

    def __init__(self, kind: Literal["builds", "checks"], place: Path) -> None:
        """Read what there is about a folder; nothing is as good as all."""
        folder = cache_folder()
        self._stamp = tool_stamp() if folder else None
        name = digest(os.path.realpath(place).encode("utf-8", "surrogateescape"))[:32]
        self._path = folder / kind / f"{name}.json" if folder and self._stamp else None
        self._library: dict[str, str] = {}
        self._records = self._read()
        self._texts: dict[str, bytes | None] = {}
        self._real: dict[str, str] = {}

    def load(self, job: Job) -> FileResult | None:
        """Return the result of a job if there is one that holds."""
        record = self._records.get(self._real_path(job.path))
        try:
            if record is None or record["job"] != self._key(job):
                return None
            return self._restore(job, record)
        except (KeyError, IndexError, TypeError, ValueError):  # damaged: as if there were none
            return None

    def keep(self, results: Iterable[FileResult]) -> None:
        """Remember results; not being able to is no problem."""
        if self._path is None:
            return
        records = {key: value for key, value in self._records.items() if os.path.exists(key)}
        for result in results:
            key = self._real_path(result.job.path)
            records.pop(key, None)
            if result.dependencies is not None:
                records[key] = self._record(result)
        if records != self._records:
            self._records = records
            document = {
                "format": FORMAT,
                "stamp": self._stamp,
                "library": self._library,
                "results": records,
            }
            if write_own(self._path, json.dumps(document).encode()):
                forget_the_oldest(self._path.parent, MOST_KEPT)

    def _read(self) -> dict[str, Any]:
        data = read_own(self._path) if self._path else None
        try:
            document = json.loads(data or b"{}")
            is_known = document.get("format") == FORMAT and document.get("stamp") == self._stamp
            if not is_known:
                return {}
            self._library = dict(document["library"])
            return dict(document["results"])
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return {}

    def _key(self, job: Job) -> list[Any]:
        roots = [self._real_path(root) for root in job.roots]
        return [job.name, roots, len(job.roots.sources), repr(job.options), job.is_asked]

    def _record(self, result: FileResult) -> Mapping[str, Any]:
        assert result.source is not None and result.dependencies is not None, "it is to last"
        writer = ReportWriter(result.source, self._library)
        return {
            "job": self._key(result.job),
            "text": digest(result.source.text.encode()),
            "dependencies": [[d.asked, d.found, d.digest] for d in result.dependencies],
            "imported": [[i.path, i.name, i.options, i.is_needed] for i in result.imported],
            "is_complete": result.is_complete,
            "stem": result.stem,
            "outputs": [[made.suffix, made.digest] for made in result.outputs],
            "losses": [[loss.scenario, loss.is_written, loss.summary] for loss in result.losses],
            "reports": [writer.report(report) for report in result.reports],
            "scenarios": [writer.scenario(entry) for entry in result.scenarios],
            "sources": writer.sources(),
        }

    def _restore(self, job: Job, record: Mapping[str, Any]) -> FileResult | None:
        text = self._text(str(job.path))
        if text is None or digest(text) != record["text"]:
            return None
        dependencies = tuple(Dependency(*entry) for entry in record["dependencies"])
        if not all(self._holds(dependency) for dependency in dependencies):
            return None
        imported = tuple(ImportedFile(*entry) for entry in record["imported"])
        project = job.roots.settings
        if any(
            repr(options_of(Path(i.path), given=job.given, project=project)) != i.options
            for i in imported
        ):
            return None
        source = SourceFile(job.name, text.decode(), job.path)
        reader = ReportReader(source, record["sources"], self._text, self._library)
        return FileResult(
            job=job,
            source=source,
            reports=tuple(reader.report(entry) for entry in record["reports"]),
            is_complete=record["is_complete"],
            scenarios=tuple(reader.scenario(entry) for entry in record["scenarios"]),
            stem=record["stem"],
            outputs=tuple(OutputRecord(suffix, found, None) for suffix, found in record["outputs"]),
            losses=tuple(LossEntry(*entry) for entry in record["losses"]),
            dependencies=dependencies,
            imported=imported,
        )

    def _holds(self, dependency: Dependency) -> bool:
        if not dependency.found:
            return True  # no file can have such a name
        if self._real_path(dependency.asked) != dependency.found:
            return False
        if dependency.digest is None:
            return not os.path.exists(dependency.asked)
        text = self._text(dependency.asked)
        return text is not None and digest(text) == dependency.digest

    def _text(self, path: str) -> bytes | None:
        """Return the text of a file without its byte order mark; every file is read once."""
        if path not in self._texts:
            try:
                is_file = os.path.isfile(path)
                data = Path(path).read_bytes() if is_file else None
            except OSError:
                data = None
            self._texts[path] = data.removeprefix(BYTE_ORDER_MARK) if data is not None else None
        return self._texts[path]

    def _real_path(self, path: str | Path) -> str:
        """Return the path with links followed; every folder is looked at once."""
        path = os.path.abspath(path)
        if path not in self._real:
            folder, name = os.path.split(path)
            is_plain = name and not os.path.islink(path)
            self._real[path] = (
                os.path.join(self._real_path(folder), name) if is_plain else os.path.realpath(path)
            )
        return self._real[path]


def check_jobs(jobs: Sequence[Job], *, remember: bool = True) -> list[FileResult]:
    """Return what there is to report on each file, in the order of the jobs.

    Args:
        jobs: What to check.
        remember: Whether results of earlier checks in this folder count, and these are kept.
    """
    if not remember:
        return [check_job(job) for job in jobs]
    memory = ResultCache("checks", Path.cwd())
    known = {job: result for job in jobs if (result := memory.load(job)) is not None}
    made = {job: check_job(job) for job in jobs if job not in known}
    if made:
        memory.keep(made.values())
    known |= made
    return [known[job] for job in jobs]
