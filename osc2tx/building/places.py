"""Paths in the cache: relative to the folders of a project, so that they hold in every clone."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass, replace

if TYPE_CHECKING:
    from osc2tx.building.jobs import Job
    from osc2tx.options import CompileOptions


@dataclass(frozen=True, slots=True)
class Places:
    """The folders of a job: that of its settings or sources, then those of its libraries.

    Attributes:
        folders: Absolute paths.
        roots: The folders of the sources, as `write` has them.
    """

    folders: tuple[str, ...]
    roots: tuple[str, ...] = ()

    @classmethod
    def of(cls, job: Job) -> Places:
        """Return the folders of a job."""
        first = job.roots.settings or next(iter(job.roots.sources), job.path.parent)
        written = [os.path.abspath(each) for each in job.options.import_paths]
        libraries = map(str, job.libraries)
        folders = (str(real_path(first)), os.path.abspath(first), *written, *libraries)
        places = cls(tuple(dict.fromkeys(folders)))
        return replace(places, roots=tuple(places.write(str(each)) for each in job.roots))

    def write(self, path: str) -> str:
        """Return a path as number of a folder and path from there."""
        path = os.path.abspath(path)
        for index, folder in enumerate(self.folders):
            if path == folder or path.startswith(folder.rstrip(os.sep) + os.sep):
                return f"{index}:{os.path.relpath(path, folder)}"
        return f"0:{os.path.relpath(path, self.folders[0])}"

    def read(self, written: str) -> str:
        """Return the absolute path."""
        index, _, path = written.partition(":")
        return os.path.normpath(os.path.join(self.folders[int(index)], path))

    def options(self, options: CompileOptions) -> str:
        """Return options as text."""
        xml = replace(options.xml, map_path=self._all(options.xml.map_path))
        return repr(replace(options, import_paths=self._all(options.import_paths), xml=xml))

    def _all(self, paths: Sequence[str]) -> tuple[str, ...]:
        return tuple(map(self.write, paths))

    def are_in(self, text: str) -> bool:
        """Return whether a text names one of the folders."""
        return any(folder in text for folder in self.folders)
