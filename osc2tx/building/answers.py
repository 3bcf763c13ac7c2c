"""Answers of `osc2tx check` as they were printed, for the same command on unchanged files.

`result_cache` knows what there is to report on a file, but to ask it, the command line, settings
and diagnostics must be loaded: twice the time of all else. An answer needs none of them, so this
module imports next to nothing. It belongs to one command line, folder, set of streams and osc2tx,
and holds as long as every file that was looked at, or looked for, is as it was: contents count.
"""

from __future__ import annotations

import json
import os
import stat
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from osc2tx.building.fingerprint import STARTED, tool_stamp
from osc2tx.support.paths import SETTINGS_FILES
from osc2tx.support.records import digest
from osc2tx_shared.cache import cache_folder, evict_oldest, read_own, write_own
from osc2tx_shared.text import OutputError, StreamName, explain, is_watched, replay

FORMAT = 1
MOST_FILES = 32  # in each of the 256 folders
COMMAND, NO_CACHE = "check", "--no-cache"
# What else decides how an answer looks, or who gives it.
_VARIABLES = ("NO_COLOR", "FORCE_COLOR", "OSC2TX_CACHE_DIR", "_OSC2TX_COMPLETE")


class Answer:
    """The answer to one command line: recalled if it is known and holds, kept if it is not."""

    def __init__(self, arguments: Sequence[str]) -> None:
        """Find the file of the answer.

        Args:
            arguments: The command line, the command first.
        """
        is_kept = list(arguments[:1]) == [COMMAND] and NO_CACHE not in arguments
        folder = cache_folder() if is_kept else None
        stamp = tool_stamp(folder) if folder else None
        self._place: Path | None = None
        if folder is not None and stamp is not None:
            said = [os.environ.get(name) for name in _VARIABLES]
            watched = [is_watched(err=err) for err in (False, True)]
            parts = [FORMAT, stamp, *arguments, os.getcwd(), said, watched]
            key = digest(json.dumps(parts).encode())
            self._place = folder / "answers" / key[:2] / key[2:]

    def recall(self) -> int | None:
        """Print the answer and return the exit code; `None` if none is known that holds."""
        data = read_own(self._place) if self._place else None
        try:
            code, files, printed = json.loads(data or b"null")
            holds = all([real, text] == _state(path) for path, real, text in files)
            pieces: list[tuple[StreamName, str]] = [(name, text) for name, text in printed]
        except (ValueError, TypeError, RecursionError):  # there is none, or it is damaged
            return None
        if not holds:
            return None
        try:
            replay(pieces)
        except OutputError as error:
            return explain(error)
        return int(code)

    def keep(
        self, code: int, printed: Sequence[tuple[StreamName, str]], files: Iterable[str]
    ) -> None:
        """Store the answer, unless a file changed after this process began.

        Args:
            code: The exit code.
            printed: What was printed.
            files: The sources and all places where imported files were looked for; settings files
                are looked for in their folders and all above.
        """
        if self._place is None:
            return
        looked_at = sorted({place for path in files for place in _with_settings(path)})
        if any(_changed(path) > STARTED for path in looked_at):
            return
        states = [[path, *_state(path)] for path in looked_at]
        if write_own(self._place, json.dumps([code, states, printed]).encode()):
            evict_oldest(self._place.parent, MOST_FILES)


def _with_settings(path: str) -> Iterator[str]:
    """Yield a file, and the places of settings that count for it, links followed."""
    path = os.path.abspath(path)
    yield path
    folder = os.path.dirname(os.path.realpath(path))
    while True:
        yield from (os.path.join(folder, name) for name in SETTINGS_FILES)
        if folder == os.path.dirname(folder):
            return
        folder = os.path.dirname(folder)


def _changed(path: str) -> int:
    """Return when a file was changed, in nanoseconds; 0 if there is none: its name alone counts."""
    try:
        status = os.stat(path)
    except OSError:
        return 0
    return status.st_mtime_ns if stat.S_ISREG(status.st_mode) else 0


def _state(path: str) -> list[str | None]:
    """Return where a path leads, and the digest of the text there; empty if that is no file."""
    real = os.path.realpath(path)
    try:
        with open(path, "rb") as stream:
            return [real, digest(stream.read())]
    except FileNotFoundError:
        return [real, None]
    except (OSError, ValueError):
        return [real, ""]
