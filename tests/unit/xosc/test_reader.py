"""Documents are read as they stand, with places; what asks for too much is refused."""

import os
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.options import XML_VERSIONS
from osc2tx.xosc import Element, Limits, Place, Unknown, Unreadable, read
from osc2tx.xosc import elements as xml
from osc2tx.xosc.checking import problems, version_of
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.elements import class_of
from osc2tx.xosc.schema import attributes_of, tags
from osc2tx.xosc.writer import written

GENERATED = Path(__file__).parents[3] / "generated"
PUBLIC = Path(os.environ.get("OSC2TX_TEST_DATA", "/nowhere")) / "xosc"
TEXT = (GENERATED / "cut_in.xosc").read_text(encoding="utf-8")

Node = tuple[str, tuple[tuple[str, str], ...], str, tuple["Node", ...]]


def canonical(data: bytes) -> Node:
    """Return a document as another parser reads it; children of several tags in any order."""
    parser = etree.XMLParser(remove_comments=True, remove_pis=True, resolve_entities=False)
    return _canonical(etree.fromstring(data, parser))


def _canonical(node: etree._Element) -> Node:
    children = sorted(map(_canonical, node), key=lambda child: child[0])
    attributes = tuple(sorted((str(key), str(text)) for key, text in node.attrib.items()))
    return str(node.tag), attributes, (node.text or "").strip(), tuple(children)


def documents(folder: Path) -> Iterator[bytes]:
    return (path.read_bytes() for path in sorted(folder.rglob("*.xosc")))


def test_documents_of_the_repository_are_written_as_they_were_read() -> None:
    found = list(documents(GENERATED))
    assert len(found) > 60
    for data in found:
        root = read(data)
        assert written(root).encode() == re.sub(rb"  <!-- .* -->", b"", data)  # without notes
        assert list(problems(root, version_of(root))) == []


@pytest.mark.skipif(not PUBLIC.is_dir(), reason="OSC2TX_TEST_DATA has no public documents")
def test_public_documents_are_written_as_they_were_read() -> None:
    """Their authors validate them, so the table finds nothing wrong but dates."""
    found, wrong = 0, set()
    for data in documents(PUBLIC):
        root = read(data)
        assert canonical(written(root).encode()) == canonical(data)
        said = (each for each in problems(root, version_of(root)) if not each.is_warning)
        wrong |= {each.reason for each in said if not each.reason.startswith("date=")}
        found += 1
    assert found > 250
    assert wrong == set()


def sample(tag: str) -> Element:
    """Return an element with all its attributes."""
    texts = tuple((name, f"${name}") for name in attributes_of(tag))
    return class_of(tag).of(texts)


@pytest.mark.parametrize("tag", sorted(tags()))
def test_every_element_is_read_as_it_was_written(tag: str) -> None:
    made = sample(tag)
    found = read(written(made))
    assert type(found) is type(made)
    assert dict(found.attributes) == dict(made.attributes)
    assert getattr(xml, f"{tag}_" if tag == "None" else tag) is type(made)


def test_a_place_is_where_an_element_begins() -> None:
    root = read("<A>\n  <B/> <Event\n    name='x'/>\n</A>")
    assert [child.place for child in root.children] == [Place(2, 3), Place(2, 8)]


def test_order_and_unknown_parts_are_kept() -> None:
    root = read('<Event priority="skip" future="1"><StartTrigger/><Hologram/><Action/></Event>')
    assert [child.tag for child in root.children] == ["StartTrigger", "Hologram", "Action"]
    assert isinstance(root.children[1], Unknown)
    assert root.get("future") == "1"
    assert [child.tag for child in read(written(root)).children] == [
        "Action",
        "StartTrigger",
        "Hologram",
    ]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1", "cp1252"])
def test_encodings(encoding: str) -> None:
    named = encoding.removesuffix("-sig")
    text = f'<?xml version="1.0" encoding="{named}"?>\n<File filepath="Straße"/>'
    assert read(text.encode(encoding)).get("filepath") == "Straße"


def test_values_are_typed_and_defaults_those_of_the_standard() -> None:
    event = read('<Event name="e" priority="skip"/>')
    assert isinstance(event, xml.Event)
    assert (event.name, event.maximumExecutionCount) == ("e", 1)
    condition = read('<RelativeDistanceCondition value="1e1" freespace="1"/>')
    assert isinstance(condition, xml.RelativeDistanceCondition)
    assert (condition.value, condition.freespace) == (10.0, True)
    assert condition.coordinateSystem == "entity"


@pytest.mark.parametrize("text", ["$v", "${$v * 2}", "fast"])
def test_an_expression_is_no_number(text: str) -> None:
    node = read(f'<Storyboard>\n<AbsoluteTargetSpeed value="{text}"/></Storyboard>').children[0]
    assert isinstance(node, xml.AbsoluteTargetSpeed)
    with pytest.raises(Unresolved, match="is not a number") as caught:
        _ = node.value
    assert caught.value.place == Place(2, 1)


def test_elements_do_not_change() -> None:
    node = xml.Event(name="e", priority="skip")
    with pytest.raises(AttributeError, match="cannot be changed"):
        node.text = "x"
    assert hash(node) == hash(xml.Event(name="e", priority="skip"))
    assert node != xml.Event(name="e", priority="parallel")


BOMB = """<!DOCTYPE a [<!ENTITY b "xxxxxxxxxx"><!ENTITY c "&b;&b;&b;">]><a>&c;</a>"""
FILE = '<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><a>&b;</a>'


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (BOMB, "entity of its own, `b`"),
        (FILE, "entity of its own, `b`"),
        ("<a>" * 300 + "</a>" * 300, "more than 200 deep"),
        ("<a/>" + " " * 2000, "more than 1000 bytes"),
        ("<a>" + "<b/>" * 150 + "</a>", "more than 100 elements"),
        ("<a>&b;</a>", "undefined entity"),
        ("<a><b></a>", "mismatched tag"),
        ("", "no element found"),
        (b"\xff\xfe\x00", "unclosed token|no element|well-formed"),
        ('<?xml version="1.0" encoding="nonsense"?><a/>', "unknown encoding"),
        ("<a b='1' b='2'/>", "duplicate attribute"),
    ],
)
def test_what_asks_for_too_much_is_refused(data: str | bytes, reason: str) -> None:
    bytes_ = data if isinstance(data, bytes) else data.encode()
    limits = Limits(size=1000 if "bytes" in reason else 100_000, elements=100)
    if "deep" in reason:
        limits = Limits()
    with pytest.raises(Unreadable, match=reason) as caught:
        read(bytes_, limits)
    assert caught.value.place.line >= 1
    assert caught.value.place.column >= 1


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ('priority="override"', 'priority="overdrive"', "priority='overdrive' of <Event>"),
        ("<StopTrigger>", '<StopTrigger colour="red">', "colour of <StopTrigger>"),
        ('revMajor="1"', 'revMajor="one"', "revMajor='one' of <FileHeader>"),
        (' priority="parallel"', "", "<Event> without priority"),
        ("<CatalogLocations/>", "<CatalogLocations/>" * 2, "second <CatalogLocations>"),
        ("<CatalogLocations/>", "<CatalogLocations/><Car/>", "<Car> below <OpenSCENARIO>"),
    ],
)
def test_a_mistake_has_a_place_and_a_reason(before: str, after: str, reason: str) -> None:
    text = TEXT if before in TEXT else TEXT.replace('priority="parallel"', before)
    assert before in text
    root = read(text.replace(before, after, 1))
    found = [each for each in problems(root, version_of(root)) if not each.is_warning]
    assert any(reason in each.reason for each in found), found
    assert all(each.place is not None for each in found)


def test_what_is_deprecated_is_a_warning() -> None:
    root = read(TEXT.replace('priority="parallel"', 'priority="overwrite"'))
    found = list(problems(root, "1.3"))
    assert {each.reason for each in found} == {"priority='overwrite' of <Event> is deprecated"}
    assert all(each.is_warning for each in found)


@pytest.mark.parametrize(
    ("major", "minor", "version"),
    [("1", "0", "1.0"), ("1", "3", "1.3"), ("1", "17", "1.4"), ("2", "0", "1.4"), ("x", "", "1.0")],
)
def test_a_version_beyond_the_last_one_is_taken_for_that(
    major: str, minor: str, version: str
) -> None:
    root = read(f'<OpenSCENARIO><FileHeader revMajor="{major}" revMinor="{minor}"/></OpenSCENARIO>')
    assert version_of(root) == version
    assert version in XML_VERSIONS
