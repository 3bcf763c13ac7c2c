"""The only way to standard output and standard error."""

from __future__ import annotations

import os
import re
import sys
import unicodedata
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from typing import Literal, TextIO, TypeAlias

# Control, format (direction overrides, zero width, tags), surrogate, line and paragraph separator.
_UNSAFE = frozenset({"Cc", "Cf", "Cs", "Zl", "Zp"})

# What CI servers obey: GitHub `::name::` after blanks at the beginning of a line, and `##[name]`
# anywhere; Azure Pipelines and TeamCity `##vso[…]` and `##teamcity[…]`.
_LEADING_COMMAND = re.compile(r"\A(\s*)::")
_MARKED_COMMAND = re.compile(r"##(?=\w*\[)")


def visible(text: str) -> str:
    r"""Return a text that stays on its line and steers nothing, escaped as in a Python literal.

    A backslash stays as it is: this is for readers, and not to be undone.
    """
    return text if text.isprintable() else _replaced(text, lambda char: ascii(char)[1:-1])


def without_commands(line: str) -> str:
    """Return a line in which no CI server finds a command."""
    if "##" in line:
        line = _MARKED_COMMAND.sub(r"\\x23#", line)
    return _LEADING_COMMAND.sub(r"\1\\x3a:", line) if "::" in line else line


def in_json(document: str) -> str:
    r"""Return a JSON document of the same meaning, with unsafe characters as `\u` escapes."""
    lines = _MARKED_COMMAND.sub(r"\\u0023#", document).split("\n")
    return "\n".join(x if x.isprintable() else _replaced(x, _json_escape) for x in lines)


def in_xml(document: str) -> str:
    """Return an XML document of the same meaning, with unsafe characters as references.

    It must have no comments: references mean nothing there.
    """
    lines = document.split("\n")
    return "\n".join(x if x.isprintable() else _replaced(x, _xml_escape) for x in lines)


def _json_escape(char: str) -> str:
    units = char.encode("utf-16-be", "surrogatepass").hex()
    return "".join(f"\\u{units[at : at + 4]}" for at in range(0, len(units), 4))


def _xml_escape(char: str) -> str:
    return char if char == "\t" else f"&#{ord(char)};"


def _replaced(text: str, escape: Callable[[str], str]) -> str:
    return "".join(escape(char) if _is_unsafe(char) else char for char in text)


@cache
def _is_unsafe(char: str) -> bool:
    return unicodedata.category(char) in _UNSAFE


UNWRITABLE = 4
READER_HAS_GONE = 141  # as shells have it: 128 + SIGPIPE

StreamName: TypeAlias = Literal["stdout", "stderr"]

_COLOR = re.compile("(\x1b\\[[0-9;]*m)")


def _stand_in(name: StreamName) -> bool:
    """Put a stream in the place of one that the process was started without.

    Libraries rely on an open stream, and a file of ours must not get its number. A closed standard
    error suppresses messages; the exit code still reports the result.
    """
    if getattr(sys, name) is None:
        setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        return True
    return False


_stand_in("stderr")
_HAS_NO_OUTPUT = _stand_in("stdout")


class OutputError(Exception):
    """Standard output or standard error takes no text.

    Attributes:
        exit_code: The exit code of the process: 141 if the reader has gone, as with `head`.
    """

    def __init__(self, name: str, reason: str, exit_code: int = UNWRITABLE) -> None:
        super().__init__(f"{name} cannot be written: {reason}")
        self.exit_code = exit_code


def explain(error: OutputError) -> int:
    """Report why an output failed, if it may still be read; return the exit code."""
    if error.exit_code != READER_HAS_GONE:
        with suppress(OutputError):
            complain(f"error: {error}")
    return error.exit_code


def is_watched(*, err: bool = True) -> bool:
    """Whether standard error, or standard output, is a terminal."""
    return (sys.stderr if err else sys.stdout).isatty()


def expect_output() -> None:
    """Refuse to continue without standard output; for libraries that would print into nothing.

    Raises:
        OutputError: If the process was started without it.
    """
    if _HAS_NO_OUTPUT:
        raise OutputError("standard output", "it is closed")


def say(line: str) -> None:
    """Print a line; what would end it is escaped."""
    _print("stdout", f"{without_commands(visible(line))}\n")


def complain(line: str) -> None:
    """Print a line on standard error."""
    _print("stderr", f"{without_commands(visible(line))}\n")


def put(text: str, *, err: bool = False, colored: bool = False) -> None:
    """Print lines of text.

    Args:
        text: The lines. The caller has made sure that no part of a line contains its end.
        err: On standard error.
        colored: Let the sequences for colors pass.
    """
    clean = _clean_colored if colored else _clean
    lines = map(clean, text.removesuffix("\n").split("\n"))
    _print("stderr" if err else "stdout", "\n".join(lines) + "\n")


def put_document(text: str) -> None:
    """Print a document for programs unchanged: its text is escaped already."""
    _print("stdout", text)


@contextmanager
def recorded() -> Iterator[list[tuple[StreamName, str]]]:
    """Yield a list of the lines printed meanwhile, without those of `show_status`."""
    printed: list[tuple[StreamName, str]] = []
    _RECORDS.append(printed)
    try:
        yield printed
    finally:
        _RECORDS.remove(printed)


def replay(printed: Iterable[tuple[StreamName, str]]) -> None:
    """Print once more what was recorded; it is clean already."""
    for name, text in printed:
        _print(name, text)


def show_status(text: str) -> None:
    """Show a line on the terminal that the next one replaces."""
    _write("stderr", f"\r\033[K{_clean(text)}")


def clear_status() -> None:
    """Wipe the line of `show_status`."""
    _write("stderr", "\r\033[K")


def _clean(line: str) -> str:
    return without_commands("\t".join(map(visible, line.split("\t"))))


def _clean_colored(line: str) -> str:
    parts = _COLOR.split(line)
    parts[::2] = map(_clean, parts[::2])
    return "".join(parts)


_RECORDS: list[list[tuple[StreamName, str]]] = []


def _print(name: StreamName, text: str) -> None:
    _write(name, text)
    for printed in _RECORDS:
        printed.append((name, text))


def _write(name: StreamName, text: str) -> None:
    """Write to a stream of the process; characters that it lacks are escaped.

    Raises:
        OutputError: If it is full or not read any more, or standard output is closed.
    """
    stream: TextIO = getattr(sys, name)
    described = f"standard {'output' if name == 'stdout' else 'error'}"
    if name == "stdout":
        expect_output()
    encoding = stream.encoding or "utf-8"
    try:
        stream.write(text.encode(encoding, "backslashreplace").decode(encoding))
        stream.flush()
    except OSError as error:
        _abandon(stream)
        code = READER_HAS_GONE if isinstance(error, BrokenPipeError) else UNWRITABLE
        raise OutputError(described, error.strerror or str(error), code) from None


def flush() -> None:
    """Write out what others have printed, such as code of a user, unless it is closed."""
    for stream in (sys.stdout, sys.stderr):
        if not stream.closed:
            stream.flush()


def _abandon(stream: TextIO) -> None:
    """Lead a stream nowhere, or the interpreter complains about its unwritten rest at the end."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except (OSError, ValueError):  # a stream of a test, or of another program
        return
