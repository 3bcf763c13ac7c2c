"""Files as they are now: each is read once, and each folder looked at once."""

from __future__ import annotations

import os
from pathlib import Path

from osc2tx.building.results import Dependency, Detail
from osc2tx.support.records import digest
from osc2tx_shared.classes import replace

BYTE_ORDER_MARK = b"\xef\xbb\xbf"


class PresentFiles:
    """Texts and real paths of files during one activity."""

    def __init__(self) -> None:
        self._texts: dict[str, bytes | None] = {}
        self._digests: dict[str, str] = {}
        self._real: dict[str, str] = {}

    def text(self, path: str) -> bytes | None:
        """Return the text of a file without its byte order mark; `None` if there is none."""
        if path not in self._texts:
            try:
                is_file = os.path.isfile(path)
                data = Path(path).read_bytes() if is_file else None
            except OSError:
                data = None
            self._texts[path] = data.removeprefix(BYTE_ORDER_MARK) if data is not None else None
        return self._texts[path]

    def decoded(self, path: str) -> str:
        """Return the same as text, empty if there is none."""
        return (self.text(path) or b"").decode()

    def now(self, known: Dependency) -> Dependency | None:
        """Return a dependency as it is now; `None` if imports would find something else."""
        if not known.found:
            return known  # no file can have such a name
        if self._real_path(known.asked) != known.found:
            return None
        if known.digest is None:
            return None if os.path.exists(known.asked) else known
        text = self.text(known.asked)
        if text is None:
            return None
        if known.asked not in self._digests:
            self._digests[known.asked] = digest(text)
        now = self._digests[known.asked]
        if now == known.digest:
            return known
        return None if known.detail is Detail.TEXT else replace(known, digest=now)

    def _real_path(self, path: str) -> str:
        """Return an absolute path with links followed."""
        if path not in self._real:
            folder, name = os.path.split(path)
            is_plain = name and not os.path.islink(path)
            self._real[path] = (
                os.path.join(self._real_path(folder), name) if is_plain else os.path.realpath(path)
            )
        return self._real[path]
