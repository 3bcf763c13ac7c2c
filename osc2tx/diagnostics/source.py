"""Source texts and the places in them."""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass, field
from pathlib import Path

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
    line_starts: tuple[int, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Index the line starts; CR, LF and CR LF each end a line (§7.2.1.2)."""
        starts = (match.end() for match in LINE_END.finditer(self.text))
        object.__setattr__(self, "line_starts", (0, *starts))

    def position(self, offset: int) -> tuple[int, int]:
        """Return the one-based line and column of an offset."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line_text(self, line: int) -> str:
        """Return the text of a one-based line without its line end."""
        start = self.line_starts[line - 1]
        end = self.line_starts[line] if line < len(self.line_starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")


@dataclass(frozen=True, slots=True)
class Span:
    """A half-open range of offsets in one source text."""

    source: SourceFile
    start: int
    end: int

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

    def to(self, other: Span) -> Span:
        """Return the span from the start of this one to the end of `other`."""
        return Span(self.source, self.start, other.end)

    def __str__(self) -> str:
        """`file:line`, as traces and generated comments cite it."""
        return f"{self.source.name}:{self.line}"
