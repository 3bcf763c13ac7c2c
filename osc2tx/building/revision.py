"""Sources of an earlier revision, checked out to a folder of their own."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path, PurePosixPath

from osc2tx.compilation.inputs import InputError
from osc2tx.support.real_paths import real_path

SETTINGS = ("osc2tx.toml", "pyproject.toml")
LINK = "120000"


@contextmanager
def checked_out(
    paths: Sequence[str | Path], revision: str, import_paths: Sequence[str]
) -> Iterator[tuple[list[Path], tuple[str, ...]]]:
    """Lay out scenario and settings files of a revision; yield where paths and libraries are.

    Nothing of the repository's own folder is touched, and no command of its settings is run: the
    files are read as git stores them.

    Args:
        paths: Files and folders as they are named today; those that the revision does not have
            are left out.
        revision: A commit, in any way git understands.
        import_paths: Folders with libraries; those outside of the repository stay what they are.

    Raises:
        InputError: If the paths are in no repository, or it has no such revision.
    """
    root = _repository(paths)
    commit = _git(
        root,
        "rev-parse",
        "--verify",
        "--quiet",
        "--end-of-options",
        f"{revision}^{{commit}}",
        failure=f"git knows no revision {revision!r}",
    )
    with tempfile.TemporaryDirectory(prefix="osc2tx-revision-") as folder:
        top = Path(os.path.realpath(folder))
        _lay_out(root, commit.decode().strip(), top)
        inside = [top / _place(path).relative_to(root) for path in paths]
        libraries = [(str(path), _place(path)) for path in import_paths]
        yield (
            [path for path in inside if path.exists() and _has_source(path)],
            tuple(
                str(top / place.relative_to(root)) if place.is_relative_to(root) else written
                for written, place in libraries
            ),
        )


def _has_source(path: Path) -> bool:
    return path.is_file() or any(path.rglob("*.osc"))


def _repository(paths: Sequence[str | Path]) -> Path:
    place = _place(paths[0])
    start = place if place.is_dir() else place.parent
    found = _git(start, "rev-parse", "--show-toplevel", failure=f"{start}: is in no git repository")
    root = Path(os.path.realpath(found.decode().rstrip("\n")))
    for path in paths:
        if not _place(path).is_relative_to(root):
            raise InputError(f"{path}: is not in the repository {root}", unreadable=False)
    return root


def _place(path: str | Path) -> Path:
    """Return the absolute path; a link stays a link, as it does in the repository."""
    path = Path(path)
    return Path(os.path.realpath(path.parent), path.name) if path.name else real_path(path)


def _lay_out(root: Path, commit: str, top: Path) -> None:
    """Write the files that a build may read."""
    listing = _git(root, "ls-tree", "-r", "-z", "--full-tree", commit)
    names, hashes, links = [], [], []
    for line in listing.decode("utf-8", "surrogateescape").split("\0"):
        head, _, name = line.partition("\t")
        place = PurePosixPath(name)
        if place.suffix != ".osc" and place.name not in SETTINGS:
            continue
        mode, kind, blob = head.split(" ")
        if kind == "blob":
            names.append(name)
            hashes.append(blob)
            links.append(mode == LINK)
    contents = _blobs(root, hashes)
    for name, is_link, data in zip(names, links, contents, strict=True):
        target = top / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if is_link:
            os.symlink(os.fsdecode(data), target)
        else:
            target.write_bytes(data)


def _blobs(root: Path, hashes: Sequence[str]) -> Iterator[bytes]:
    """Yield the contents of objects, as `git cat-file --batch` writes them."""
    text = _git(root, "cat-file", "--batch", stdin="\n".join(hashes).encode() + b"\n")
    start = 0
    for _ in hashes:
        end = text.index(b"\n", start)
        size = int(text[start:end].split(b" ")[2])
        yield text[end + 1 : end + 1 + size]
        start = end + 1 + size + 1


def _git(folder: Path, *arguments: str, stdin: bytes = b"", failure: str = "") -> bytes:
    try:
        ended = subprocess.run(
            ["git", "-C", str(folder), *arguments], input=stdin, capture_output=True, check=False
        )
    except FileNotFoundError:
        raise InputError("--diff-against needs git, and there is none", unreadable=False) from None
    if ended.returncode:
        reason = failure or ended.stderr.decode(errors="replace").strip()
        raise InputError(reason, unreadable=False)
    return ended.stdout
