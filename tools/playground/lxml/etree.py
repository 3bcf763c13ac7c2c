"""The part of `lxml.etree` that the reader of maps uses, over the standard library."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element
from xml.parsers.expat import ExpatError, ParserCreate

XMLSyntaxError = ExpatError


class _Element(Element):
    """An element that knows its parent and its line."""

    parent: _Element | None = None
    sourceline = 0

    def getparent(self) -> _Element | None:
        """Return the element that it stands in."""
        return self.parent

    def iterchildren(self, *tags: str) -> Iterator[_Element]:
        """Yield the elements in it, of some tags if there are any."""
        for child in self:
            if not tags or child.tag in tags:
                yield child


class XMLPullParser:
    """Builds a tree; events are those of wanted elements. Options of lxml are defaults here."""

    def __init__(self, events: tuple[str, ...], *, tag: tuple[str, ...], **_: object) -> None:
        self._wanted = {each.rpartition("}")[2] for each in tag}
        self._parser = ParserCreate(namespace_separator="}")
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text
        self._open: list[_Element] = []
        self._root: _Element | None = None
        self._events: list[tuple[str, _Element]] = []

    def feed(self, data: bytes) -> None:
        """Take more of the text."""
        self._parser.Parse(data, False)

    def close(self) -> _Element:
        """Return the root of the whole text."""
        self._parser.Parse(b"", True)
        assert self._root is not None
        return self._root

    def read_events(self) -> Iterator[tuple[str, _Element]]:
        """Yield the events since the last call."""
        found, self._events = self._events, []
        yield from found

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        made = _Element(name.rpartition("}")[2], attributes)
        made.sourceline = self._parser.CurrentLineNumber
        if self._open:
            made.parent = self._open[-1]
            self._open[-1].append(made)
        else:
            self._root = made
        self._open.append(made)
        self._note("start", made)

    def _end(self, name: str) -> None:
        self._note("end", self._open.pop())

    def _text(self, data: str) -> None:
        last = self._open[-1]
        if len(last):
            last[-1].tail = (last[-1].tail or "") + data
        else:
            last.text = (last.text or "") + data

    def _note(self, event: str, element: _Element) -> None:
        if element.tag in self._wanted:
            self._events.append((event, element))
