"""Changes of a session on its server with the former values, in memory and in a file.

The file outlives a process that is killed: the next session on the server undoes the listed
changes. Each line is `[kind, value]` in JSON. A file that a living process has locked is not read.
"""

from __future__ import annotations

import fcntl
import json
import os
import secrets
import stat
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

SERVER, EPISODE = "server", "episode"
"""Kinds of lines that identify the server and the episode: an address, and the random number that
CARLA draws for each loading of a level (`UCarlaEpisode`)."""

Undo = Callable[[Any, Sequence[Any]], object]

UNDO: dict[str, Undo] = {}
"""Functions that undo the changes of a kind, by its name, from a session and the noted values."""


def undoes(kind: str) -> Callable[[Undo], Undo]:
    """Register the function that undoes the changes of a kind."""

    def declared(undo: Undo) -> Undo:
        UNDO[kind] = undo
        return undo

    return declared


class Journal:
    """The changes of a session.

    Attributes:
        changes: Noted values by kind, in the order in which the kinds came up.
        server: Address of the server.
        episode: Episode of the server of the changes.
    """

    def __init__(self) -> None:
        self.changes: dict[str, list[Any]] = {}
        self.server, self.episode = "", 0
        self._path: Path | None = None
        self._file = -1

    def open(self, folder: str, server: str) -> None:
        """Keep a file in a folder, if possible; it appears once it is locked."""
        self.server = server
        if not folder or self._file >= 0:
            return
        path = Path(folder, f"{secrets.token_hex(8)}.jsonl")
        new = path.with_suffix(".new")
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            self._file = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            fcntl.flock(self._file, fcntl.LOCK_EX)
            self._write(SERVER, server)
            new.rename(path)
            self._path = path
        except OSError:  # changes are still undone, unless this process is killed
            self.close()

    def enter(self, episode: int) -> None:
        """Note the episode of the further changes."""
        self.episode = episode
        self._write(EPISODE, episode)

    def note(self, kind: str, before: Any) -> None:
        """Note a change before it is made."""
        self.changes.setdefault(kind, []).append(before)
        self._write(kind, before)

    def _write(self, kind: str, value: Any) -> None:
        if self._file >= 0:
            os.write(self._file, json.dumps([kind, value]).encode() + b"\n")

    def undo(self, session: Any) -> Iterator[Callable[[], object]]:
        """Yield the functions that undo the changes, the last first.

        A kind is removed once undone.
        """
        for kind in reversed(list(self.changes)):
            yield partial(UNDO[kind], session, self.changes[kind])
            del self.changes[kind]

    def read(self, text: str) -> None:
        """Read the lines of a file; a truncated last line is omitted.

        Raises:
            ValueError: It is not a journal.
        """
        for line in text.splitlines(keepends=True):
            if not line.endswith("\n"):
                break
            kind, value = json.loads(line)
            if kind == SERVER:
                self.server = value
            elif kind == EPISODE:
                self.episode = value
            elif kind in UNDO:
                self.changes.setdefault(kind, []).append(value)
            else:
                raise ValueError(f"unknown kind {kind}")

    def close(self) -> None:
        """Remove the file if all changes are undone."""
        if self._path is not None and not self.changes:
            self._path.unlink(missing_ok=True)
        if self._file >= 0:
            os.close(self._file)
            self._file = -1


def left_behind(folder: str, server: str, episode: int) -> list[Journal]:
    """Return the journals of killed sessions whose changes still exist.

    Those of earlier episodes of the server are removed: their changes ended with the level.
    """
    found = []
    for path in sorted(Path(folder).glob("*.jsonl")) if folder else ():
        journal = _taken(path)
        if journal is None:
            continue
        if journal.episode == episode and journal.changes:
            found.append(journal)
            continue
        if journal.server == server:
            journal.changes.clear()
        journal.close()
    return found


def _taken(path: Path) -> Journal | None:
    """Return a journal that no process keeps, and lock it; None for others."""
    journal = Journal()
    try:
        journal._file = os.open(path, os.O_RDWR | os.O_NOFOLLOW)
        status = os.fstat(journal._file)
        if status.st_uid != os.geteuid() or not stat.S_ISREG(status.st_mode):
            raise PermissionError(path)
        fcntl.flock(journal._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        with os.fdopen(os.dup(journal._file), encoding="utf-8") as stream:
            journal.read(stream.read())
        journal._path = path
    except (OSError, ValueError):  # of a living session, of another user, or damaged
        journal.close()
        return None
    return journal
