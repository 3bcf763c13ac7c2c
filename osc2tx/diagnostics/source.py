"""Source files and spans."""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import field
from pathlib import Path
from typing import Final

from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass

LINE_END = re.compile(r"\r\n|\r|\n")


@dataclass(frozen=True, slots=True, eq=False)
class SourceFile:
    """One source text.

    Attributes:
        name: How diagnostics and generated files call it (relative, forward slashes).
        text: The decoded text, line ends as they were written.
        path: Where it was read from; `None` for texts that never were a file.
    """

    name: str
    text: str
    path: Path | None = None
    _line_starts: tuple[int, ...] = field(default=(), init=False, repr=False)
    _identity: Path | str = field(default="", init=False, repr=False)

    @property
    def line_starts(self) -> tuple[int, ...]:
        """The offsets at which lines start; CR, LF and CR LF each end one (§7.2.1.2)."""
        if not self._line_starts:
            starts = (match.end() for match in LINE_END.finditer(self.text))
            object.__setattr__(self, "_line_starts", (0, *starts))
        return self._line_starts

    @property
    def identity(self) -> Path | str:
        """The same for all texts read from one file."""
        if not self._identity:
            identity = real_path(self.path) if self.path else self.name
            object.__setattr__(self, "_identity", identity)
        return self._identity

    def position(self, offset: int) -> tuple[int, int]:
        """Return the one-based line and column of an offset."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line_text(self, line: int) -> str:
        """Return the text of a one-based line without its line end."""
        start = self.line_starts[line - 1]
        end = self.line_starts[line] if line < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")


class Span:
    """A half-open range of offsets in one source text; equal to others of the same range.

    There is one for each node, and a frozen dataclass takes three times as long to build.
    """

    __slots__ = ("end", "source", "start")

    def __init__(self, source: SourceFile, start: int, end: int) -> None:
        """Take the range; it never changes."""
        self.source: Final = source
        self.start: Final = start
        self.end: Final = end

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Span)
            and self.source is other.source
            and self.start == other.start
            and self.end == other.end
        )

    def __hash__(self) -> int:
        return hash((self.source, self.start, self.end))

    def __reduce__(self) -> tuple[type[Span], tuple[SourceFile, int, int]]:
        return Span, (self.source, self.start, self.end)

    def __repr__(self) -> str:
        return f"Span({self.source.name!r}, {self.start}, {self.end})"

    @property
    def line(self) -> int:
        """One-based line of the start."""
        return self.source.position(self.start)[0]

    @property
    def column(self) -> int:
        """One-based column of the start."""
        return self.source.position(self.start)[1]

    @property
    def text(self) -> str:
        """The source text that the span covers."""
        return self.source.text[self.start : self.end]

    def holds(self, other: Span) -> bool:
        """Whether another span lies in this one."""
        return self.source is other.source and self.start <= other.start and other.end <= self.end

    def to(self, other: Span) -> Span:
        """Return the span from the start of this one to the end of `other`."""
        return Span(self.source, self.start, other.end)

    def __str__(self) -> str:
        """`file:line`, as traces and generated comments cite it."""
        return f"{self.source.name}:{self.line}"
