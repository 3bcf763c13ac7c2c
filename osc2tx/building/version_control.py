"""Reads what git has stored: nothing of a repository runs, and nothing is fetched (ADR 0007)."""

from __future__ import annotations

import hashlib
import os
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from osc2tx.compilation.inputs import InputError

_HASHES = {40: hashlib.sha1, 64: hashlib.sha256}
"""Digits of an object's name to what makes it."""

_CLOSED = {
    "GIT_ALLOW_PROTOCOL": "",  # no transport at all, whatever the repository's settings allow
    "GIT_NO_LAZY_FETCH": "1",  # missing objects of a partial clone stay missing
    "GIT_OPTIONAL_LOCKS": "0",  # nothing is written beside the files that are read
    "GIT_TERMINAL_PROMPT": "0",
}
"""The environment that each command of git has in addition to the user's."""

_NO_COMMANDS = ("-c", f"core.hooksPath={os.devnull}", "-c", "core.fsmonitor=false")
"""Settings that precede those of the repository."""

LINK = "120000"
"""The mode of a symbolic link."""


class Entry(NamedTuple):
    """A file in a revision.

    Attributes:
        path: From the top of the listing, as git stores it: no part of it is checked.
        mode: The octal digits that git stores: `LINK`, or those of a file.
        blob: The name of the object with its contents.
    """

    path: str
    mode: str
    blob: str


def committed_objects(folder: Path) -> Mapping[str, str]:
    """Return the files below a folder in the last commit, each with the name of its object.

    There are none without git, outside of repositories, and before the first commit.
    """
    try:
        ended = _run(folder, "ls-tree", "-r", "-z", "HEAD")
    except OSError:
        return {}
    return {entry.path: entry.blob for entry in _entries(ended.stdout)}


def is_object(data: bytes, name: str) -> bool:
    """Return whether git stores a text under a name."""
    blob = b"blob %d\0%b" % (len(data), data)
    return _HASHES[len(name)](blob).hexdigest() == name


def top_of(folder: Path) -> Path:
    """Return the folder of the repository that a folder is in.

    Raises:
        InputError: It is in no repository, or there is no git.
    """
    found = _git(
        folder, "rev-parse", "--show-toplevel", failure=f"{folder}: is in no git repository"
    )
    return Path(os.path.realpath(os.fsdecode(found.rstrip(b"\n"))))


def commit_of(root: Path, revision: str) -> str:
    """Return the name of the commit of a revision, given in any way git understands.

    Raises:
        InputError: The repository has no such revision.
    """
    arguments = ("rev-parse", "--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
    return _git(root, *arguments, failure=f"git knows no revision {revision!r}").decode().strip()


def entries_of(root: Path, commit: str) -> Iterator[Entry]:
    """Yield the files of a commit, with paths from the top of the repository.

    Raises:
        InputError: The repository does not have all of its folders.
    """
    yield from _entries(_git(root, "ls-tree", "-r", "-z", "--full-tree", commit))


def contents_of(root: Path, entries: Sequence[Entry]) -> Iterator[bytes]:
    """Yield the contents of files.

    Raises:
        InputError: The repository does not have one of them, as a partial clone may not.
    """
    stdin = "".join(f"{entry.blob}\n" for entry in entries).encode()
    text = _git(root, "cat-file", "--batch", stdin=stdin)
    start = 0
    for entry in entries:
        end = text.index(b"\n", start)
        head = text[start:end].split(b" ")
        if len(head) != len(("object", "type", "size")):
            raise InputError(
                f"{entry.path}: the repository has no contents of this file"
                f" (object {entry.blob}); `git fetch` may bring them",
                unreadable=False,
            )
        size = int(head[2])
        yield text[end + 1 : end + 1 + size]
        start = end + 1 + size + 1


def _entries(listing: bytes) -> Iterator[Entry]:
    for line in os.fsdecode(listing).split("\0"):
        head, _, path = line.partition("\t")
        if path:
            mode, kind, name = head.split(" ")
            if kind == "blob":
                yield Entry(path, mode, name)


def _run(folder: Path, *arguments: str, stdin: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        ["git", *_NO_COMMANDS, "-C", str(folder), *arguments],
        input=stdin,
        capture_output=True,
        check=False,
        env={**os.environ, **_CLOSED},
    )


def _git(folder: Path, *arguments: str, stdin: bytes = b"", failure: str = "") -> bytes:
    try:
        ended = _run(folder, *arguments, stdin=stdin)
    except FileNotFoundError:
        raise InputError("git, needed for --diff-against, is missing", unreadable=False) from None
    if ended.returncode:
        reason = failure or ended.stderr.decode(errors="replace").strip()
        raise InputError(reason, unreadable=False)
    return ended.stdout
