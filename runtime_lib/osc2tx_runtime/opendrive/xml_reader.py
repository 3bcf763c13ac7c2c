"""Checked access to XML attributes: each error states the file, the line and the element."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import BinaryIO, cast

from lxml import etree

from osc2tx_runtime.plain_numbers import to_float, to_int

from .errors import MapError
from .polynomials import Piecewise, Row

_REQUIRED = object()
_LARGEST = 1e9  # beyond it, products of three attributes would leave the range of floats
_CHUNK = 1 << 16  # bytes
_LONGEST = 1e6  # m: samples along a road must fit into memory


def parse_xml(
    path: Path, take: Callable[[etree._Element], None] = lambda road: None
) -> etree._Element:
    """Root element of a file; see `parse_stream`.

    Raises:
        MapError: The file cannot be read or is not a map.
    """
    if path.is_dir():
        raise MapError(str(path), "is a folder; give the path of an .xodr file")
    try:
        with path.open("rb") as stream:
            return parse_stream(stream, str(path), take)
    except OSError as error:
        reason = error.strerror or str(error)
        raise MapError(str(path), f"cannot be read ({reason}); check the path") from error


def parse_stream(
    stream: BinaryIO, name: str, take: Callable[[etree._Element], None]
) -> etree._Element:
    """Root element of the text of a map.

    Entities are not resolved and nothing is loaded: maps come from third parties.

    Args:
        stream: The text.
        name: Used in messages.
        take: Called with each road as soon as it is complete; may remove the elements that it has
            read, which are many times larger than the resulting objects.

    Raises:
        MapError: It is not XML, or not a map.
    """
    parser = etree.XMLPullParser(
        ("start", "end"),
        tag=("{*}OpenDRIVE", "{*}road"),
        resolve_entities=False,
        no_network=True,
        remove_comments=True,
        remove_pis=True,
    )
    try:
        while chunk := stream.read(_CHUNK):
            parser.feed(chunk)
            _take_roads(parser, take)
        root = parser.close()
    except (etree.XMLSyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None)
        reason = getattr(error, "msg", None) or error  # without lxml's `(<string>, line 1)`
        raise MapError(
            name, f"is not well-formed XML ({reason}); export the map again", line
        ) from (error)
    if root.tag.startswith("{"):
        _strip_namespaces(root)
    if root.tag != "OpenDRIVE":
        raise MapError(
            name, f"is not OpenDRIVE: the root element is `{root.tag}`", source_line(root)
        )
    return root


def _take_roads(parser: etree.XMLPullParser, take: Callable[[etree._Element], None]) -> None:
    """Pass on the roads of the map that are complete."""
    for event, found in parser.read_events():
        element = cast("etree._Element", found)
        parent = element.getparent()
        if event == "end" and parent is not None and parent.getparent() is None:
            if str(element.tag) != "road":
                _strip_namespaces(element)
            take(element)


def source_line(element: etree._Element) -> int:
    """Line of an element in its file (1-based)."""
    line: int | None = getattr(element, "sourceline", None)  # the type stubs lack its type
    return line or 0


def _strip_namespaces(root: etree._Element) -> None:
    for element in root.iter():
        if isinstance(element.tag, str) and element.tag.startswith("{"):
            element.tag = element.tag.rpartition("}")[2]


class Attributes:
    """Reads attributes of elements of one file.

    Attributes:
        file: Its name, for messages.
        remarks: Errors of the file that do not prevent its use.
    """

    __slots__ = ("_shared", "file", "remarks")

    def __init__(self, file: str) -> None:
        self.file = file
        self.remarks: dict[str, None] = {}
        self._shared: dict[tuple[tuple[float, Row], ...], Piecewise] = {}

    def remark(self, element: etree._Element, message: str) -> None:
        """Note an error of an element that can still be used."""
        name = element.get("id")
        what = f"`{element.tag}`" if name is None else f"`{element.tag}` {name}"
        self.remarks[f"line {source_line(element)}: {what} {message}"] = None

    def error(self, element: etree._Element, message: str) -> MapError:
        """A `MapError` at an element."""
        return MapError(self.file, f"element `{element.tag}`: {message}", source_line(element))

    def text(self, element: etree._Element, name: str, default: str | None = None) -> str:
        """The text of an attribute; required without a default."""
        value = element.get(name)
        if value is not None:
            return value
        if default is None:
            raise self.error(element, f"attribute `{name}` is missing; add it")
        return default

    def number(
        self, element: etree._Element, name: str, default: float | object = _REQUIRED
    ) -> float:
        """A finite number."""
        text = element.get(name)
        if text is None:
            if isinstance(default, float):
                return default
            raise self.error(element, f"attribute `{name}` is missing; add it")
        try:
            value = to_float(text)
        except ValueError:
            message = f"attribute `{name}` is not a finite number: `{text[:40]}`"
            raise self.error(element, message) from None
        if abs(value) > _LARGEST:
            raise self.error(element, f"attribute `{name}` is too large for a map: `{text}`")
        return value

    def length(self, element: etree._Element, name: str) -> float:
        """A finite number that is not negative (m)."""
        value = self.number(element, name)
        if value > _LONGEST:
            raise self.error(element, f"attribute `{name}` is longer than 1000 km: {value:g}")
        if value < 0.0:
            raise self.error(element, f"attribute `{name}` must not be negative: {value:g}")
        return value

    def integer(self, element: etree._Element, name: str) -> int:
        """A whole number."""
        text = self.text(element, name)
        try:
            return to_int(text)
        except ValueError:
            message = f"attribute `{name}` is not a whole number: `{text[:40]}`"
            raise self.error(element, message) from None

    def piecewise(self, records: Iterable[tuple[float, Row]]) -> Piecewise | None:
        """From polynomials with their starts; equal ones, which are frequent, share an object."""
        key = tuple(records)
        found = self._shared.get(key)
        if found is None:
            made = Piecewise.from_records(key)
            if made is None:
                return None
            found = self._shared[key] = made
        return found

    def cubic(self, element: etree._Element, suffix: str = "") -> tuple[float, float, float, float]:
        """Coefficients a to d, with a suffix "U" or "V" for paramPoly3."""
        get = element.get
        try:  # the fast way: widths are most of the elements of a map
            a, b, c, d = (get(name + suffix, "") for name in "abcd")
            row = float(a), float(b), float(c), float(d)
            texts = a + b + c + d
            is_plain = texts.isascii() and "_" not in texts
            if is_plain and abs(row[0]) + abs(row[1]) + abs(row[2]) + abs(row[3]) < _LARGEST:
                return row
        except ValueError:
            pass
        p, q, r, s = (self.number(element, name + suffix) for name in "abcd")
        return p, q, r, s
