"""What the sources of a project declare and import, from their texts alone.

Nothing is compiled, so the answers are there at once, also for files with errors. Names lead, as
in `compilation.uses`: a declaration uses another one that its file can see if it has a word that is
the name of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path

from osc2tx.building.jobs import Job
from osc2tx.compilation.imports import module_place
from osc2tx.compilation.uses import Statement, split_statements
from osc2tx.config import ConfigFiles
from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass
from osc2tx_shared.map_files import map_places

_TEXT = re.compile(r'"([^"\n]*)"')
_MAP = re.compile(r'"([^"\n]+\.xodr)"')
BYTE_ORDER_MARK = "\ufeff"


@dataclass(frozen=True, slots=True)
class IndexedFile:
    """A source or a library.

    Attributes:
        path: Where it is, links followed.
        name: What it is called.
        text: Its text; empty if it cannot be read.
        statements: Its statements at the level of the file.
        imports: The files that it imports, in order.
        looked_for: Where imports were looked for before they were found.
        maps: The maps that it names: what is written, and where that is, if it is anywhere.
        dialect: Its dialect.
        settings: The settings file that counts for it.
    """

    path: Path
    name: str
    text: str
    statements: tuple[Statement, ...]
    imports: tuple[Path, ...]
    looked_for: tuple[Path, ...]
    maps: tuple[tuple[str, Path | None], ...]
    dialect: str
    settings: Path | None


class SourceIndex:
    """The sources of some jobs, and all that they import.

    Attributes:
        files: All files, by path; those of the jobs first.
        sources: The paths of the jobs.
    """

    def __init__(self, jobs: Sequence[Job], configs: ConfigFiles) -> None:
        """Read the files.

        Args:
            jobs: The sources.
            configs: The settings files.
        """
        self._configs = configs
        self.files: dict[Path, IndexedFile] = {}
        pending = [(real_path(job.path), job.name, job) for job in jobs]
        self.sources = tuple(path for path, _, _ in pending)
        for path, name, job in pending:  # grows
            if path not in self.files:
                found = self._read(path, name, job)
                self.files[path] = found
                pending += [(each, _name(each, job), job) for each in found.imports]

    def closure(self, path: Path) -> tuple[IndexedFile, ...]:
        """Return all files that a file imports, directly or through others, without itself."""
        if path not in self._closures:
            seen: dict[Path, None] = {}
            pending = list(self.files[path].imports)
            while pending:
                each = pending.pop()
                if each not in seen and each != path:
                    seen[each] = None
                    pending += self.files[each].imports
            self._closures[path] = tuple(self.files[each] for each in sorted(seen))
        return self._closures[path]

    @cached_property
    def _closures(self) -> dict[Path, tuple[IndexedFile, ...]]:
        return {}

    def _read(self, path: Path, name: str, job: Job) -> IndexedFile:
        config = self._configs.for_source(path)
        options = job.options_of(path, self._configs)
        try:
            text = path.read_text(encoding="utf-8").removeprefix(BYTE_ORDER_MARK)
        except (OSError, ValueError):
            text = ""
        statements = split_statements(text, options.dialect)
        imports: dict[Path, None] = {}
        looked_for: dict[Path, None] = {}
        for places in _import_places(statements, path, job):
            for place in places:
                if place.is_file():
                    imports[real_path(place)] = None
                    break
                looked_for[place] = None
        folders = [path.parent, *map(Path, options.xml.map_path)]
        named = dict.fromkeys(each for s in statements for each in _MAP.findall(s.tokens))
        return IndexedFile(
            path=path,
            name=name,
            text=text,
            statements=statements,
            imports=tuple(imports),
            looked_for=tuple(looked_for),
            maps=tuple((each, _map_file(each, folders)) for each in named),
            dialect=options.dialect,
            settings=config.path,
        )


def _name(path: Path, job: Job) -> str:
    return job.roots.name_of(path, job.libraries) or path.name


def _import_places(
    statements: Iterable[Statement], path: Path, job: Job
) -> Iterator[Sequence[Path]]:
    """Yield, for each import of a file, the places where the imported one can be."""
    for statement in statements:
        if statement.keyword != "import":
            continue
        words = statement.tokens.partition("\n")[0].split()
        written = _TEXT.search(statement.tokens)
        if written is not None:
            yield (path.parent / written[1],)
            continue
        module = "".join(words[1:]).split(".")
        place = module_place(module)
        if place is not None and module[0] != "osc":
            folders = (path.parent, *job.roots, *job.libraries)
            yield [folder / place for folder in dict.fromkeys(folders)]


def _map_file(name: str, folders: Sequence[Path]) -> Path | None:
    try:
        return next((real_path(each) for each in map_places(name, folders) if each.is_file()), None)
    except (OSError, ValueError):  # a name that no file can have
        return None
