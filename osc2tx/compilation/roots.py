"""Folders from which the names of sources count.

A source is called by its path from the folder that holds it, `urban/cut_in.osc`, and its module by
the same path in the folder of the outputs, so that modules of several folders import each other
under one name each. The first kind of folder that holds a file gives its name, of several folders
of one kind the innermost:

1. the `sources` of the project, or the named folder if it is none of them;
2. the folders of `import_paths`;
3. the folder of the settings file.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Roots:
    """The folders of a project, links followed.

    Attributes:
        sources: Folders of sources, in the order of the search for modules.
        settings: The folder of the settings file, if there is one.
    """

    sources: tuple[Path, ...] = ()
    settings: Path | None = None

    def __iter__(self) -> Iterator[Path]:
        """Yield all folders from which a source may import, in the order of the search."""
        yield from self.sources
        if self.settings is not None:
            yield self.settings

    def name_of(self, path: Path, import_paths: Sequence[Path] = ()) -> str | None:
        """Return the name of a file; `None` if it is in none of the folders.

        Args:
            path: The file, links followed.
            import_paths: Folders with libraries, links followed.
        """
        root = self.root_of(path, import_paths)
        return None if root is None else path.relative_to(root).as_posix()

    def root_of(self, path: Path, import_paths: Sequence[Path] = ()) -> Path | None:
        """Return the folder from which the name of a file counts."""
        settings = () if self.settings is None else (self.settings,)
        kinds = (self.sources, import_paths, settings)
        return next((root for kind in kinds if (root := innermost(path, kind))), None)


def innermost(path: Path, folders: Iterable[Path]) -> Path | None:
    """Return the folder that holds a path, the innermost one of several."""
    holding = [folder for folder in folders if path.is_relative_to(folder)]
    return max(holding, key=lambda folder: len(folder.parts), default=None)
