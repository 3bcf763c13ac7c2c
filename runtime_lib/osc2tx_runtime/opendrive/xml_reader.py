"""Checked access to XML attributes: every complaint names the file, the line and the element."""

from __future__ import annotations

from pathlib import Path

from lxml import etree

from osc2tx_runtime.plain_numbers import to_float, to_int

from .errors import MapError

__all__ = ["Attributes", "parse_bytes", "parse_xml", "source_line"]

_REQUIRED = object()
_LARGEST = 1e9  # beyond it, products of three attributes would leave the range of floats
_LONGEST = 1e6  # m: samples along a road must fit into memory


def parse_xml(path: Path) -> etree._Element:
    """Root element of a file.

    Entities are not resolved and nothing is fetched: maps come from third parties.

    Raises:
        MapError: The file cannot be read or is not XML.
    """
    if path.is_dir():
        raise MapError(str(path), "is a folder; give the path of an .xodr file")
    try:
        content = path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        raise MapError(str(path), f"cannot be read ({reason}); check the path") from error
    return parse_bytes(content, str(path))


def parse_bytes(content: bytes, name: str) -> etree._Element:
    """Root element of the text of a map; `name` is used in messages."""
    parser = etree.XMLParser(
        resolve_entities=False,
        no_network=True,
        remove_comments=True,
        remove_pis=True,
    )
    try:
        root = etree.fromstring(content, parser)
    except (etree.XMLSyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None)
        raise MapError(name, f"is not well-formed XML ({error}); export the map again", line) from (
            error
        )
    if root.tag.startswith("{"):
        _strip_namespaces(root)
    if root.tag != "OpenDRIVE":
        raise MapError(
            name, f"is not OpenDRIVE: the root element is `{root.tag}`", source_line(root)
        )
    return root


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
        remarks: What is wrong with the file, but not so that it cannot be used.
    """

    __slots__ = ("file", "remarks")

    def __init__(self, file: str) -> None:
        self.file = file
        self.remarks: dict[str, None] = {}

    def remark(self, element: etree._Element, message: str) -> None:
        """Take down what is wrong with an element that can be used all the same."""
        name = element.get("id")
        what = f"`{element.tag}`" if name is None else f"`{element.tag}` {name}"
        self.remarks[f"line {source_line(element)}: {what} {message}"] = None

    def error(self, element: etree._Element, message: str) -> MapError:
        """A `MapError` at an element."""
        return MapError(self.file, f"element `{element.tag}`: {message}", source_line(element))

    def text(self, element: etree._Element, name: str, default: str | None = None) -> str:
        """An attribute as it is; without a default it must be there."""
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
