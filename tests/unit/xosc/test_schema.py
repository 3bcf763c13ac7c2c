"""The table of the schemas is what the schemas say, and documents are held against it."""

import json
from importlib.resources import files

import pytest
from lxml import etree

from osc2tx.diagnostics import InternalCompilerError
from osc2tx.options import XML_VERSIONS, XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.elements import class_of
from osc2tx.xosc.numbers import number_text
from osc2tx.xosc.schema import element_type, has_attribute, literals
from osc2tx.xosc.writer import serialize
from tests.unit.xosc.schemas import OFFICIAL_1_4, schema_of, tool

XSD = "{http://www.w3.org/2001/XMLSchema}"


def test_the_table_is_up_to_date() -> None:
    made = tool()["make"]()
    shipped = (files("osc2tx.xosc") / "schema.json").read_text(encoding="utf-8")
    assert json.loads(shipped) == json.loads(made)
    assert shipped == made


@pytest.mark.parametrize("version", XML_VERSIONS)
def test_every_part_of_a_schema_is_in_the_table(version: XmlVersion) -> None:
    """Counted with plain XPath, not with the code that makes the table."""
    root = tool()["schema_of"](version)
    checked = 0
    for type_ in root.iter(f"{XSD}complexType"):
        name = type_.get("name")
        for attribute in type_.iter(f"{XSD}attribute"):
            assert has_attribute(name, attribute.get("name"), version)
            checked += 1
        for child in type_.iter(f"{XSD}element"):
            assert element_type(name).children[child.get("name")].is_in(version)
        named = {a.get("name") for a in type_.iter(f"{XSD}attribute")}
        table = element_type(name).attributes
        assert named == {each for each in table if has_attribute(name, each, version)}
    assert checked > 200


def parts(root: etree._Element) -> set[tuple[str, ...]]:
    """Return all types of a schema with what they consist of."""
    return {
        (type_.get("name"), part.tag, part.get("name") or part.get("value"), part.get("type"))
        for type_ in root.iter(f"{XSD}complexType", f"{XSD}simpleType")
        if type_.get("name")
        for part in type_.iter(f"{XSD}element", f"{XSD}attribute", f"{XSD}enumeration")
    }


@pytest.mark.skipif(OFFICIAL_1_4 is None, reason="OSC2TX_XML_SCHEMA_1_4 names no schema of 1.4")
def test_additions_of_1_4_are_those_of_its_schema() -> None:
    ours, theirs = parts(tool()["schema_of"]("1.4")), parts(schema_of("1.4"))
    assert ours == theirs


@pytest.mark.parametrize(
    ("version", "priority"), [("1.0", "overwrite"), ("1.1", "overwrite"), ("1.2", "override")]
)
def test_literals_know_their_versions(version: XmlVersion, priority: str) -> None:
    known = literals("Priority", version)
    assert known is not None and priority in known
    assert ("override" in known) is (version >= "1.2")
    assert literals("Double", version) is None


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (70 / 3.6, "19.4444444444"),
        (0.0, "0"),
        (-0.0, "0"),
        (5.0, "5"),
        (0.1 + 0.2, "0.3"),
        (5.56e-7, "0.000000556"),
        (-1e-5, "-0.00001"),
        (3600.0, "3600"),
        (1e15, "1000000000000000"),
    ],
)
def test_numbers_are_short_and_plain(value: float, text: str) -> None:
    assert number_text(value) == text
    assert float(text) == pytest.approx(value, rel=1e-11)


HEADER = xml.FileHeader(
    revMajor=1, revMinor=0, date="2000-01-01T00:00:00", description="x", author="y"
)


def test_parts_come_in_the_order_of_the_schema() -> None:
    tree = xml.OpenSCENARIO(
        xml.Storyboard(xml.Init(xml.Actions())),
        xml.Entities(),
        xml.RoadNetwork(),
        HEADER,
        xml.CatalogLocations(),
    )
    text = serialize(tree, "1.3")
    order = ["FileHeader", "CatalogLocations", "RoadNetwork", "Entities", "Storyboard"]
    assert [child.tag for child in etree.fromstring(text.encode())] == order


@pytest.mark.parametrize(
    ("child", "version"),
    [
        (xml.VariableDeclarations(), "1.1"),  # not yet
        (class_of("Nonsense")(), "1.3"),  # never
        (class_of("CatalogLocations")(colour="red"), "1.3"),  # an attribute nobody knows
        (xml.Storyboard(xml.Init(xml.Actions())), "1.0"),  # no StopTrigger
    ],
)
def test_what_a_version_has_not_is_a_bug(child: object, version: XmlVersion) -> None:
    with pytest.raises(InternalCompilerError, match=f"OpenSCENARIO XML {version}"):
        serialize(xml.OpenSCENARIO(HEADER, child), version)  # type: ignore[arg-type]
