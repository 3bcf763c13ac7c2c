"""Where in a text the cursor is: the block, the open parenthesis, the words before it.

The text around the cursor is unfinished while one types, so this reads lines and indentation, and
needs no syntax tree.
"""

from __future__ import annotations

import re
from enum import Enum

from osc2tx_shared.classes import dataclass

_STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|#.*')
_PATH = re.compile(r"([A-Za-z_]\w*(?:\[\d+\])?(?:\.[A-Za-z_]\w*(?:\[\d+\])?)*)$")
_COMPOSITION = re.compile(r"(?:do\s+|\w+\s*:\s*)*(?:do|serial|parallel|one_of)\b.*:$")
_DECLARATION = re.compile(r"(?:scenario|action|modifier|actor|struct|extend)\b")


class Block(Enum):
    """The kind of lines of a block."""

    FILE = "file"
    TYPE = "type"
    DO = "do"
    WITH = "with"
    ON = "on"


@dataclass(frozen=True, slots=True)
class OpenCall:
    """The innermost parenthesis that is open at the cursor.

    Attributes:
        callee: The callee before it, `ego.drive`.
        argument: The text of the present argument.
        index: Its number, from 0.
        named: The names of arguments that are already there.
    """

    callee: str
    argument: str
    index: int
    named: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Cursor:
    """The surroundings of the cursor.

    Attributes:
        block: The kind of lines of its block.
        header: The line that opens the block; empty at the level of the file.
        declaration: Offset of the line that begins the enclosing declaration.
        before: The present line up to the cursor, without comments and texts.
        call: The parenthesis that is open, if there is one.
    """

    block: Block
    header: str
    declaration: int
    before: str
    call: OpenCall | None


def cursor_at(text: str, offset: int) -> Cursor:
    """Return the surroundings of an offset."""
    start = text.rfind("\n", 0, offset) + 1
    before = _plain(text[start:offset])
    headers = _headers(text, start, _indentation(text[start:offset]))
    header = headers[0][1] if headers else ""
    declaration = headers[-1][0] if headers else start
    return Cursor(_block(headers), header, declaration, before, _open_call(before))


def path_before(text: str) -> str:
    """Return the dotted name at the end of a text."""
    found = _PATH.search(text)
    return found[1] if found else ""


def _plain(line: str) -> str:
    """Return a line with blanks in place of texts and comments."""
    return _STRING_OR_COMMENT.sub(lambda found: " " * len(found[0]), line)


def _indentation(line: str) -> int:
    return len(line) - len(line.lstrip(" \t"))


def _headers(text: str, start: int, indentation: int) -> list[tuple[int, str]]:
    """Return the lines that open the blocks around a line, the innermost first."""
    found: list[tuple[int, str]] = []
    while start > 0 and indentation > 0:
        end = start - 1
        start = text.rfind("\n", 0, end) + 1
        line = _plain(text[start:end]).rstrip()
        if line.strip() and _indentation(line) < indentation:
            indentation = _indentation(line)
            found.append((start, line.strip()))
    return found


def _block(headers: list[tuple[int, str]]) -> Block:
    if not headers:
        return Block.FILE
    header = headers[0][1]
    if header.endswith("with:") or header.endswith("with"):
        return Block.WITH
    if _COMPOSITION.match(header):
        return Block.DO
    if header.startswith("on "):
        return Block.ON
    return Block.TYPE if _DECLARATION.match(header) else Block.DO


def _open_call(before: str) -> OpenCall | None:
    depth = 0
    for index in range(len(before) - 1, -1, -1):
        char = before[index]
        if char in ")]":
            depth += 1
        elif char in "([" and depth:
            depth -= 1
        elif char == "(":
            return _call(path_before(before[:index]), before[index + 1 :])
        elif char == "[":
            return None
    return None


def _call(callee: str, written: str) -> OpenCall:
    arguments, depth = [""], 0
    for char in written:
        depth += (char in "([") - (char in ")]")
        if char == "," and depth == 0:
            arguments.append("")
        else:
            arguments[-1] += char
    named = [each.partition(":")[0].strip() for each in arguments if ":" in each]
    return OpenCall(callee, arguments[-1].strip(), len(arguments) - 1, tuple(named))
