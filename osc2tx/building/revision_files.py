"""The files of a revision that a build reads, laid out in a folder of their own (ADR 0007)."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from osc2tx.building.version_control import (
    LINK,
    Entry,
    commit_of,
    contents_of,
    entries_of,
    top_of,
)
from osc2tx.compilation.inputs import InputError
from osc2tx.support.paths import SETTINGS_FILES, real_path
from osc2tx_shared.own_folders import REVISION, own_folder

REFUSED_PARTS = ("", ".", "..", ".git")
"""Parts of paths that lead elsewhere or would be a repository."""
MAP = ".xodr"
POINTER = b"version https://git-lfs.github.com/"
"""How a file begins that git stores in place of a large one."""


class Revision(NamedTuple):
    """The sources of a revision, laid out in a folder of their own.

    Attributes:
        top: The folder.
        paths: Where the paths of today are; those that the revision does not have are left out.
        libraries: Where the folders with libraries are.
        problems: What of the revision was not laid out, a sentence each.
    """

    top: Path
    paths: list[Path]
    libraries: tuple[str, ...]
    problems: list[str]


@contextmanager
def checked_out(
    paths: Sequence[str | Path], revision: str, import_paths: Sequence[str]
) -> Iterator[Revision]:
    """Lay out scenarios, settings and maps of a revision; yield where paths and libraries are.

    Nothing of the repository's own folder is touched, and nothing of it runs: the files are read
    as git stores them.

    Args:
        paths: Files and folders by their present names.
        revision: A commit, in any way git understands.
        import_paths: Folders with libraries; those outside of the repository are used as they are.

    Raises:
        InputError: The paths are in no repository, it has no such revision, or the revision has
            names that git would not check out.
    """
    root = _repository(paths)
    commit = commit_of(root, revision)
    with own_folder(REVISION) as folder:
        top = Path(os.path.realpath(folder))
        try:
            problems = list(_lay_out(root, commit, top))
        except _RefusedName as error:
            raise InputError(
                f"{revision}: {error}; nothing is compared", unreadable=False
            ) from None
        inside = [top / _place(path).relative_to(root) for path in paths]
        libraries = [(str(path), _place(path)) for path in import_paths]
        yield Revision(
            top,
            [path for path in inside if path.exists() and _has_source(path)],
            tuple(
                str(top / place.relative_to(root)) if place.is_relative_to(root) else written
                for written, place in libraries
            ),
            [f"{revision}: {problem}" for problem in problems],
        )


def _has_source(path: Path) -> bool:
    return path.is_file() or any(path.rglob("*.osc"))


def _repository(paths: Sequence[str | Path]) -> Path:
    place = _place(paths[0])
    root = top_of(place if place.is_dir() else place.parent)
    for path in paths:
        if not _place(path).is_relative_to(root):
            raise InputError(f"{path}: is not in the repository {root}", unreadable=False)
    return root


def _place(path: str | Path) -> Path:
    """Return the absolute path; a link stays a link, as it does in the repository."""
    path = Path(path)
    return Path(os.path.realpath(path.parent), path.name) if path.name else real_path(path)


class _RefusedName(Exception):
    """A revision holds a name that git refuses to check out."""


def _lay_out(root: Path, commit: str, top: Path) -> Iterator[str]:
    """Write the files that a build may read, below `top` only; yield the omitted ones.

    Links come last: while files are written, there is none to follow.

    Raises:
        _RefusedName: A name leads elsewhere, or two entries are one file.
    """
    entries = [entry for entry in entries_of(root, commit) if _is_read(entry)]
    links = []
    for entry, data in _contents(root, entries):
        if any(part.casefold() in REFUSED_PARTS for part in entry.path.split("/")):
            raise _RefusedName(f"{entry.path!r} is no name that git would check out")
        if entry.mode == LINK:
            links.append((entry.path, os.fsdecode(data)))
            continue
        if data.startswith(POINTER):
            stored = _stored_elsewhere(root / entry.path, data)
            if stored is None:
                yield f"{entry.path} is in Git LFS, which is not read, and is another file now"
                continue
            data = stored
        target = top / entry.path
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            with target.open("xb") as file:
                file.write(data)
        except (FileExistsError, NotADirectoryError):
            raise _RefusedName(f"{entry.path!r} is there twice") from None
    for path, goal in links:
        if not _stays_inside(top, path, goal):
            yield f"{path} is a link out of the repository, which is not read"
            continue
        target = top / path
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.symlink_to(goal)
        except (FileExistsError, NotADirectoryError):
            raise _RefusedName(f"{path!r} is there twice") from None


def _contents(root: Path, entries: Sequence[Entry]) -> Iterator[tuple[Entry, bytes]]:
    """Yield each file with its contents; maps, which may be large, one at a time."""
    maps = [entry for entry in entries if _is_map(entry)]
    texts = [entry for entry in entries if not _is_map(entry)]
    yield from zip(texts, contents_of(root, texts), strict=True)
    for entry in maps:
        yield entry, next(contents_of(root, [entry]))


def _stored_elsewhere(place: Path, pointer: bytes) -> bytes | None:
    """Return what a pointer of Git LFS stands for, if the working copy still has it."""
    wanted = re.search(rb"^oid sha256:([0-9a-f]{64})$", pointer, re.MULTILINE)
    data = place.read_bytes() if wanted is not None and place.is_file() else b""
    is_same = wanted is not None and hashlib.sha256(data).hexdigest().encode() == wanted[1]
    return data if is_same else None


def _is_map(entry: Entry) -> bool:
    return PurePosixPath(entry.path).suffix == MAP


def _is_read(entry: Entry) -> bool:
    place = PurePosixPath(entry.path)
    return place.suffix == ".osc" or place.name in SETTINGS_FILES or _is_map(entry)


def _stays_inside(top: Path, path: str, goal: str) -> bool:
    """Return whether a link stays below `top`; links that are there already do so."""
    place = os.path.realpath((top / path).parent / goal)
    return Path(place).is_relative_to(top)
