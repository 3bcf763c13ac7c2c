"""Reads documents: text to elements, with their places.

A document is untrusted. It is read without own entities, files and networks, and within limits; a
refusal has a position and a reason. Unusual documents are read as they are: any order, parts of
other versions, unknown elements. `checking` reports their defects.
"""

from __future__ import annotations

from typing import Any, NamedTuple
from xml.parsers import expat

from osc2tx.xosc.element import Element, Place
from osc2tx.xosc.elements import class_of
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of a document.

    Attributes:
        size: Bytes.
        depth: Elements in one another.
        elements: Their number.
    """

    size: int = 100_000_000
    depth: int = 200
    elements: int = 2_000_000


BOUNDED = Limits()


class Unreadable(Exception):
    """A document that cannot be read, or exceeds a limit.

    Attributes:
        reason: A sentence without full stop.
        place: Its position.
    """

    def __init__(self, reason: str, place: Place) -> None:
        """Store the details."""
        super().__init__(f"{place}: {reason}")
        self.reason = reason
        self.place = place


class Comment(NamedTuple):
    """A comment of a document.

    Attributes:
        text: Its text.
        within: Where the surrounding element begins; `None`: outside of the root.
    """

    text: str
    within: Place | None


def read(
    data: bytes | str, limits: Limits = BOUNDED, comments: list[Comment] | None = None
) -> Element:
    """Return the root element of a document.

    Args:
        data: The document; the encoding of bytes is the one that they declare, else UTF-8.
        limits: Its limits.
        comments: Takes its comments, in their order.

    Raises:
        Unreadable: It is no XML, or exceeds a limit.
    """
    if len(data) > limits.size:
        raise Unreadable(f"it has more than {limits.size} bytes", Place(1, 1))
    return _Reading(limits, comments).run(data)


@dataclass(slots=True)
class _Open:
    """An element whose end has not come."""

    tag: str
    attributes: tuple[tuple[str, str], ...]
    place: Place
    children: list[Element]
    texts: list[str]

    def closed(self) -> Element:
        text = "".join(self.texts)
        kept = text if text.strip() else None
        return class_of(self.tag).of(self.attributes, tuple(self.children), kept, self.place)


class _Reading:
    """Reads one document."""

    def __init__(self, limits: Limits, comments: list[Comment] | None) -> None:
        self._limits = limits
        self._comments = comments
        self._open: list[_Open] = []
        self._root: Element | None = None
        self._count = 0
        self._parser = parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.ordered_attributes = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        if comments is not None:
            parser.CommentHandler = self._comment
        parser.EntityDeclHandler = self._refuse_entity
        parser.SetParamEntityParsing(expat.XML_PARAM_ENTITY_PARSING_NEVER)

    def run(self, data: bytes | str) -> Element:
        try:
            self._parser.Parse(data, True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code)
            raise Unreadable(reason, Place(error.lineno, error.offset + 1)) from None
        except (LookupError, ValueError) as error:  # an unknown encoding
            raise Unreadable(str(error), Place(1, 1)) from None
        assert self._root is not None  # else expat has found no element
        return self._root

    def _place(self) -> Place:
        return Place(self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber + 1)

    def _start(self, tag: str, attributes: list[str]) -> None:
        self._count += 1
        if len(self._open) == self._limits.depth:
            reason = f"elements are more than {self._limits.depth} deep"
            raise Unreadable(reason, self._place())
        if self._count > self._limits.elements:
            reason = f"there are more than {self._limits.elements} elements"
            raise Unreadable(reason, self._place())
        pairs = tuple(zip(attributes[::2], attributes[1::2], strict=True))
        self._open.append(_Open(tag, pairs, self._place(), [], []))

    def _end(self, tag: str) -> None:
        made = self._open.pop().closed()
        if self._open:
            self._open[-1].children.append(made)
        else:
            self._root = made

    def _text(self, text: str) -> None:
        self._open[-1].texts.append(text)

    def _comment(self, text: str) -> None:
        if self._comments is not None and text.strip():
            within = self._open[-1].place if self._open else None
            self._comments.append(Comment(text.strip(), within))

    def _refuse_entity(self, name: str, *_: Any) -> None:
        raise Unreadable(f"it declares an entity of its own, `{name}`", self._place())
