"""Elements of a document: immutable trees of strings with typed attributes.

An element keeps the texts of its attributes, so that a document is written as it was read, and
`$name` and `${expression}` stay what they are. `node.get("value")` is such a text; `node.value` is
its value: a number, a Boolean or a name, the default of the standard if it is omitted.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from math import isfinite
from typing import Any, NamedTuple, Self, TypeAlias, TypeVar

from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.numbers import Noted, number_text
from osc2tx.xosc.schema import Part

Value: TypeAlias = str | int | float | bool
E = TypeVar("E", bound="Element")


class Place(NamedTuple):
    """Where an element begins in its file; both count from 1."""

    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.line}:{self.column}"


class Unwritable(Exception):
    """A text that XML cannot hold, or that readers take for something else.

    Attributes:
        reason: A sentence without full stop.
    """

    def __init__(self, reason: str) -> None:
        """Store the details."""
        super().__init__(reason)
        self.reason = reason


class Unresolved(Exception):
    """An attribute has no value: it is an expression, or invalid.

    Attributes:
        reason: A sentence without full stop.
        place: Where its element begins; `None`: it was not read from a file.
    """

    def __init__(self, reason: str, place: Place | None) -> None:
        """Store the details."""
        super().__init__(reason if place is None else f"{place}: {reason}")
        self.reason = reason
        self.place = place


class Element:
    """An element; each tag has a class in `elements`.

    Attributes:
        attributes: Their texts, in any order.
        children: In any order where the schema gives one; elements of one tag keep theirs.
        text: Its text.
        place: Its position; it is ignored in comparisons.
        notes: The origins of its numbers, for readers; they are ignored as well.
    """

    __slots__ = ("attributes", "children", "notes", "place", "text")
    attributes: tuple[tuple[str, str], ...]
    children: tuple[Element, ...]
    text: str | None
    place: Place | None
    notes: tuple[str, ...]

    def __init__(
        self, *children: Element | None, text: str | None = None, **attributes: Value | None
    ) -> None:
        """Store its parts; `None` is skipped.

        An underscore at the end of a name is dropped: `from_` is the attribute `from`.

        Raises:
            Unwritable: A string cannot be written to a document.
        """
        texts = []
        notes: dict[str, None] = {}
        for key, value in attributes.items():
            if value is not None:
                texts.append((key.removesuffix("_"), text_of(value)))
                if isinstance(value, Noted):
                    notes[value.note] = None
        parts = tuple([each for each in children if each is not None])
        self._fill(tuple(texts), parts, text, None, tuple(notes))

    def _fill(
        self,
        attributes: tuple[tuple[str, str], ...],
        children: tuple[Element, ...],
        text: str | None,
        place: Place | None,
        notes: tuple[str, ...],
    ) -> None:
        set_attributes, set_children, set_text, set_place, set_notes = _SETTERS
        set_attributes(self, attributes)
        set_children(self, children)
        set_text(self, text)
        set_place(self, place)
        set_notes(self, notes)

    @classmethod
    def of(
        cls,
        attributes: tuple[tuple[str, str], ...],
        children: tuple[Element, ...] = (),
        text: str | None = None,
        place: Place | None = None,
        notes: tuple[str, ...] = (),
    ) -> Self:
        """Return an element with the strings of a document."""
        made = cls.__new__(cls)
        made._fill(attributes, children, text, place, notes)
        return made

    @property
    def tag(self) -> str:
        """Its name in the document."""
        return type(self).__name__

    def get(self, attribute: str) -> str | None:
        """Return the text of an attribute."""
        for name, text in self.attributes:  # a loop: players read millions of them
            if name == attribute:
                return text
        return None

    def said(self, attribute: str) -> str:
        """Return the text of an attribute, which has to be there.

        Raises:
            Unresolved: It is not.
        """
        text = self.get(attribute)
        if text is None:
            raise Unresolved(f"<{self.tag}> without {attribute}", self.place)
        return text

    @property
    def inner(self) -> Element:
        """Its first child: many elements have exactly one.

        Raises:
            Unresolved: There is none.
        """
        for child in self.children:
            return child
        raise Unresolved(f"<{self.tag}> is empty", self.place)

    # --- children -----------------------------------------------------------------------------

    def all(self, kind: type[E]) -> Iterator[E]:
        """Yield the children of a kind."""
        return (child for child in self.children if isinstance(child, kind))

    def find(self, kind: type[E]) -> E | None:
        """Return the first child of a kind."""
        for child in self.children:
            if isinstance(child, kind):
                return child
        return None

    def one(self, kind: type[E]) -> E:
        """Return the first child of a kind, which has to be there.

        Raises:
            Unresolved: There is none.
        """
        child = self.find(kind)
        if child is None:
            raise Unresolved(f"<{self.tag}> has no <{kind.__name__}>", self.place)
        return child

    def walk(self) -> Iterator[Element]:
        """Yield the element and all below it, in the order of the document."""
        pending: list[Element] = [self]
        while pending:
            node = pending.pop()
            yield node
            if node.children:
                pending += node.children[::-1]

    def below(self, kind: type[E]) -> Iterator[E]:
        """Yield the elements of a kind in it, itself included, in the order of the document."""
        return (node for node in self.walk() if isinstance(node, kind))

    # --- others like it ---------------------------------------------------------------------------

    def with_attributes(self, attributes: Mapping[str, str]) -> Self:
        """Return the same with other attributes."""
        return self._like(tuple(attributes.items()), self.children)

    def with_children(self, *children: Element) -> Self:
        """Return the same with other children."""
        return self._like(self.attributes, children)

    def _like(self, attributes: tuple[tuple[str, str], ...], children: tuple[Element, ...]) -> Self:
        return self.of(attributes, children, self.text, self.place, self.notes)

    # --- a value ----------------------------------------------------------------------------------

    def _key(self) -> tuple[object, ...]:
        return self.tag, self.attributes, self.children, self.text

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Element) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        given = "".join(f" {name}={text!r}" for name, text in self.attributes)
        return f"<{self.tag}{given}>"

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{self!r} cannot be changed")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{self!r} cannot be changed")


_SETTERS: tuple[Callable[[Element, object], None], ...] = tuple(
    vars(Element)[name].__set__ for name in ("attributes", "children", "text", "place", "notes")
)
"""They write the slots past `__setattr__`."""


class Unknown(Element):
    """An element that no version has; each tag has a class."""

    __slots__ = ()


class Attribute:
    """The value of an attribute, as a property of its class."""

    def __init__(self, name: str, part: Part) -> None:
        """Take its name, and its facts in the table."""
        self._name = name
        self._part = part

    def __get__(self, node: Element | None, owner: type[Element]) -> Any:
        """Return the value of the attribute; its default if it is omitted, otherwise `None`."""
        if node is None:
            return self
        text = node.get(self._name)
        text = self._part.default if text is None else text
        try:
            return None if text is None else _PARSERS.get(self._part.type, str)(text.strip())
        except ValueError:
            wanted = _KINDS[self._part.type]
            reason = f"{self._name}={text!r} of <{node.tag}> is not {wanted}"
            raise Unresolved(reason, node.place) from None


def _boolean(text: str) -> bool:
    if text.lower() not in ("true", "1", "false", "0"):
        raise ValueError(text)
    return text.lower() in ("true", "1")


_PARSERS: Mapping[str, Any] = {
    "Double": float,
    "Int": int,
    "UnsignedInt": int,
    "UnsignedShort": int,
    "Boolean": _boolean,
}
_KINDS = {
    "Double": "a number",
    "Int": "a whole number",
    "UnsignedInt": "a whole number",
    "UnsignedShort": "a whole number",
    "Boolean": "`true` or `false`",
}


def text_of(value: Value) -> str:
    """Return the text of a value; numbers are as short as possible, without exponent.

    Raises:
        Unwritable: It is a text that XML cannot hold, or that readers take for a parameter, or a
            number beyond any world.
    """
    if isinstance(value, str):
        _require_plain_text(value)
        return str(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not isfinite(value):
        raise Unwritable(f"a number in it is {value:g}, which no world has")
    if isinstance(value, Symbol):
        return value.attribute
    if isinstance(value, float):
        return number_text(value)
    return str(value)


_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def _require_plain_text(text: str) -> None:
    if text.startswith("$"):
        raise Unwritable(f"{text!r} begins with `$`, so it would be taken for a parameter")
    is_usual = text.isascii() and text.isprintable()
    if not is_usual and _NOT_XML.search(text):
        raise Unwritable(f"{text!r} has characters that XML cannot hold")
