"""Outputs of the trace of a run: files, kept lines, a digest. Each takes it line by line."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import TakeLines
from osc2tx_runtime.running.output_files import OutputFile, write_output

if TYPE_CHECKING:
    from osc2tx_runtime.opendrive import RoadMap


class TraceDigest:
    """The SHA-256 of a trace, equal to that of its file."""

    def __init__(self) -> None:
        self._hash = hashlib.sha256()

    def take(self, lines: Sequence[str]) -> None:
        """Take the next lines, without line ends."""
        self._hash.update("".join(f"{line}\n" for line in lines).encode())

    def __str__(self) -> str:
        """The digest of the lines so far, in hexadecimal."""
        return self._hash.hexdigest()


class RunOutputs:
    """The outputs of one run.

    Args:
        settings: Settings of the run, with the files.
        keep_lines: Keep the lines; memory then grows with the length of the run.
        digest: Compute the digest.

    Attributes:
        takers: The receivers of the lines of the trace.
        lines: Kept lines.
        digest: The digest, if requested.
    """

    def __init__(self, settings: RunSettings, *, keep_lines: bool, digest: bool) -> None:
        self._settings = settings
        self.lines: list[str] = []
        self.digest = TraceDigest() if digest else None
        self.takers: list[TakeLines] = [self.lines.extend] if keep_lines else []
        if self.digest is not None:
            self.takers.append(self.digest.take)
        self._trace = None if settings.trace is None else OutputFile("trace", settings.trace)
        if self._trace is not None:
            self.takers.append(self._trace.take)
        if settings.report is not None:
            from osc2tx_runtime.report.page import Trace

            self._shown = Trace()
            self.takers.append(self._shown.run.take)

    def close(self, road_map: RoadMap) -> None:
        """Move trace and report to the paths of the settings.

        Raises:
            InputError: They cannot be written; existing files are unchanged.
        """
        if self._trace is not None:
            self._trace.close()
        if self._settings.report is not None:
            from osc2tx_runtime.report.page import render_runs

            write_output("report", self._settings.report, render_runs([self._shown], road_map))
