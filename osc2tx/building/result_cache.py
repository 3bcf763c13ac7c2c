"""Cache of results of builds and checks, addressed by content.

A result is found by the text of its source, its settings and osc2tx itself, and holds as long as
imports find the same files and what the source uses of them is the same (`uses`). Keys and records
hold no absolute path, so that another folder, branch or machine finds the same results; a folder of
CI may hold the cache (`OSC2TX_CACHE_DIR`, `--cache-dir`). Each result is stored as soon as there is
one. Contents count, never times, but for the files of osc2tx: reading those would take longer than
a check.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from osc2tx.building.fingerprint import tool_stamp
from osc2tx.building.jobs import Job
from osc2tx.building.places import Places
from osc2tx.building.present_files import PresentFiles
from osc2tx.building.result_store import ResultStore
from osc2tx.building.results import (
    Dependency,
    Detail,
    FileResult,
    ImportedFile,
    check_job,
    used_files,
    without_grading,
)
from osc2tx.building.stored_reports import StoredTexts
from osc2tx.compilation.roots import innermost
from osc2tx.config import ConfigFiles
from osc2tx.diagnostics import SourceFile
from osc2tx.support.records import Records, digest
from osc2tx_shared.cache import cache_folder
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx.options import CompileOptions

Kind = Literal["build", "check"]

STORED = ("reports", "is_complete", "scenarios", "stem", "outputs", "losses", "uses")
"""Parts of a result that are stored as they are."""


class ResultCache:
    """Results of builds and checks; a check reuses those of a build that has nothing to run."""

    def __init__(
        self, kind: Kind, configs: ConfigFiles | None = None, folder: Path | None = None
    ) -> None:
        """Take the folder; without one nothing is remembered.

        Args:
            kind: The activity on the files.
            configs: The settings files.
            folder: Folder of the results; in the user's cache if left out.
        """
        folder = cache_folder(folder)
        stamp = tool_stamp(folder) if folder else None
        self._kinds: tuple[Kind, ...] = ("check", "build") if kind == "check" else ("build",)
        self._folder = folder if stamp else None
        self._store = ResultStore(folder) if folder and stamp else None
        self._stamp = stamp
        self._configs = configs or ConfigFiles()
        self._files = PresentFiles()
        self._clean: dict[str, bool] = {}
        self._options: dict[tuple[object, ...], tuple[CompileOptions, str]] = {}
        self._places: dict[tuple[object, ...], Places] = {}

    @property
    def findings(self) -> Records | None:
        """Findings of earlier builds about documents."""
        if self._folder is None or self._stamp is None:
            return None
        return Records(self._folder / "findings", self._stamp)

    @property
    def is_kept(self) -> bool:
        """Whether results are stored."""
        return self._folder is not None

    def load(self, job: Job) -> FileResult | None:
        """Return the result of a job if there is one that holds; without texts of outputs."""
        text = self._files.text(str(job.path)) if self._store else None
        if self._store is None or text is None:
            return None
        places = self._places_of(job)
        for kind in self._kinds:
            for record in self._store.records(self._key(kind, job, places, text)):
                try:
                    result = self._restore(job, record, places, text, self._store)
                except (KeyError, IndexError, TypeError, ValueError):  # damaged: as missing
                    continue
                if result is not None and not self._lacks_starts(kind, result):
                    return result if self._kinds == ("build",) else without_grading(result)
        return None

    def _lacks_starts(self, kind: Kind, result: FileResult) -> bool:
        """Whether a check has to prepare runs, which the build did not that made a result."""
        is_asked = kind not in self._kinds[:1] and result.is_complete
        return is_asked and any(entry.is_runnable for entry in result.scenarios)

    def load_all(self, jobs: Iterable[Job]) -> dict[Job, FileResult]:
        """Return the results of those jobs that have one."""
        return {job: result for job in jobs if (result := self.load(job)) is not None}

    def with_texts(self, result: FileResult) -> FileResult | None:
        """Return a result with the texts of its outputs; `None` if those are not stored."""
        outputs = self._store.with_texts(result.outputs) if self._store else None
        return None if outputs is None else replace(result, outputs=outputs)

    def keep(self, result: FileResult) -> None:
        """Store a result; not being able to is no problem."""
        if self._store is None or result.dependencies is None or result.source is None:
            return
        places = self._places_of(result.job)
        if any(places.are_in(text) for text in _messages(result)):
            return  # its content is not valid elsewhere
        key = self._key(self._kinds[0], result.job, places, result.source.text.encode())
        self._store.keep_texts(result.outputs)
        self._store.put(key, self._record(result, places, self._store))

    def close(self) -> None:
        """Remove what has not been written for the longest time, where there is too much."""
        if self._store is not None:
            self._store.evict_oldest()

    def _key(self, kind: Kind, job: Job, places: Places, text: bytes) -> str:
        is_link = not job.is_asked and job.path.is_symlink()
        options = [places.options(job.options), job.run if kind == "check" else ()]
        parts = [kind, self._stamp, job.name, places.roots, *options, is_link]
        return digest(json.dumps([*parts, digest(text)]).encode())

    # --- Records ----------------------------------------------------------------------------------

    def _record(self, result: FileResult, places: Places, store: ResultStore) -> Mapping[str, Any]:
        assert result.source is not None and result.dependencies is not None, "it is to last"
        texts = StoredTexts(result.source, places)
        kept = replace(result, outputs=tuple(replace(o, text=None) for o in result.outputs))
        return {
            "dependencies": [
                [places.write(d.asked), d.found and places.write(d.found), d.digest, d.detail]
                for d in result.dependencies
            ],
            "imported": [
                [places.write(i.path), i.name, places.options(i.options), i.is_needed]
                for i in result.imported
            ],
            **{name: texts.write(getattr(kept, name)) for name in STORED},
            "sources": texts.write_others(store.keep_library),
        }

    def _restore(
        self,
        job: Job,
        record: Mapping[str, Any],
        places: Places,
        text: bytes,
        store: ResultStore,
    ) -> FileResult | None:
        dependencies = tuple(
            Dependency(places.read(asked), found and places.read(found), known, Detail(detail))
            for asked, found, known, detail in record["dependencies"]
        )
        present = [self._files.now(each) for each in dependencies]
        if None in present:
            return None
        imported = []
        for path, name, options, is_needed in record["imported"]:
            place = places.read(path)
            now, stated = self._options_of(place, job, places)
            if stated != options:
                return None
            imported.append(ImportedFile(place, name, now, is_needed))
        source = SourceFile(job.name, text.decode(), job.path)
        pairs = zip(dependencies, present, strict=True)
        changed = [now for known, now in pairs if now is not None and now is not known]
        if changed and not self._is_used_alike(job, source, record, changed, present):
            return None
        texts = StoredTexts(source, places)
        texts.read_others(record["sources"], self._files.text, store.library)
        result = FileResult(
            job=job,
            source=source,
            dependencies=tuple(each for each in present if each is not None),
            imported=tuple(imported),
            **{name: texts.read(record[name]) for name in STORED},
        )
        if changed:  # found at once the next time
            digests = (each.digest for each in result.dependencies or ())
            entries = zip(record["dependencies"], digests, strict=True)
            new = [[asked, found, known, detail] for (asked, found, _, detail), known in entries]
            store.put(self._key(self._kinds[0], job, places, text), {**record, "dependencies": new})
        return result

    def _is_used_alike(
        self,
        job: Job,
        source: SourceFile,
        record: Mapping[str, Any],
        changed: Sequence[Dependency],
        present: Sequence[Dependency | None],
    ) -> bool:
        """Whether imported files changed only in what the source does not use."""
        from osc2tx.compilation.uses import used_digest

        if not record["is_complete"] or not all(self._is_clean(job, each) for each in changed):
            return False
        files = used_files((each for each in present if each is not None), self._files.decoded)
        uses: str = record["uses"]
        return used_digest(source.text, files, job.options.dialect) == uses

    def _is_clean(self, job: Job, changed: Dependency) -> bool:
        """Whether there is nothing to report on a library by itself; on a source, no errors.

        Warnings of a source are reported for the source itself.
        """
        if changed.found not in self._clean:
            path = Path(changed.found)
            name = job.roots.name_of(path, job.libraries) or path.name
            library = job.for_module_of(path, name, self._configs)
            checks = ResultCache("check", self._configs, self._folder)
            result = checks.load(library)
            if result is None:
                result = check_job(library)
                checks.keep(result)
            is_source = innermost(path, job.roots.sources) is not None
            is_quiet = is_source or not result.reports
            self._clean[changed.found] = result.is_complete and is_quiet
        return self._clean[changed.found]

    def _places_of(self, job: Job) -> Places:
        key = job.roots, job.options.import_paths, next(iter(job.roots), job.path.parent)
        if key not in self._places:
            self._places[key] = Places.of(job)
        return self._places[key]

    def _options_of(self, place: str, job: Job, places: Places) -> tuple[CompileOptions, str]:
        """Return the options of an imported file, and their text in records."""
        key = place, places.folders, job.roots.settings, job.given
        if key not in self._options:
            options = job.options_of(Path(place), self._configs)
            self._options[key] = options, places.options(options)
        return self._options[key]


def _messages(result: FileResult) -> Iterator[str]:
    """Yield all that a result tells people."""
    for report in result.reports:
        yield report.message
        yield from report.notes
        yield report.help or ""
        yield from (label.message for label in report.labels)
    yield from (loss.summary for loss in result.losses)
