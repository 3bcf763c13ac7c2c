"""Nothing of a document is lost unseen: what changes in it changes the scenario or the report."""

from xml.etree import ElementTree as ET

import pytest

from osc2tx.importing.document import Refused
from osc2tx.importing.importer import import_document
from tests.importing.documents import (
    after,
    at_time,
    document,
    event,
    imported,
    lane_change,
    speed_change,
)

EVENTS = event("One", speed_change("20"), at_time("1")) + event(
    "Two", lane_change(-1), after("One")
)
WITH_PARAMETER = '<ParameterDeclaration name="v" parameterType="double" value="20"/>'
OTHER = {"true": "false", "false": "true", "0": "7"}


def _product(text: str) -> object:
    try:
        found = imported(text)
    except Refused as error:
        return error.reason
    report = found.report.to_json()
    return found.text, report


def test_each_attribute_counts() -> None:
    text = document(EVENTS, parameters=WITH_PARAMETER, ego_speed="$v")
    root = ET.fromstring(text)
    before = _product(ET.tostring(root, encoding="unicode"))
    silent = []
    for element in root.iter():
        for name, value in list(element.attrib.items()):
            element.attrib[name] = OTHER.get(value, f"{value}9")
            if _product(ET.tostring(root, encoding="unicode")) == before:
                silent.append(f"{element.tag}/@{name}={value}")
            element.attrib[name] = value
    assert not silent


def test_each_element_counts() -> None:
    text = document(EVENTS, parameters=WITH_PARAMETER, ego_speed="$v")
    root = ET.fromstring(text)
    before = _product(ET.tostring(root, encoding="unicode"))
    silent = []
    for parent in list(root.iter()):
        for index, child in enumerate(list(parent)):
            if not child.attrib and not list(child):
                continue  # an empty element says nothing
            parent.remove(child)
            if _product(ET.tostring(root, encoding="unicode")) == before:
                silent.append(f"{parent.tag}/{child.tag}")
            parent.insert(index, child)
    assert not silent


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("<OpenSCENARIO>", "no element found"),
        ("<a/>", "is no document"),
        ('<!DOCTYPE a [<!ENTITY x "y">]><OpenSCENARIO/>', "declares an entity"),
        ("<OpenSCENARIO><FileHeader/></OpenSCENARIO>", "no storyboard"),
        ("<OpenSCENARIO>" * 300, "deep"),
    ],
)
def test_others_are_refused(text: str, reason: str) -> None:
    with pytest.raises(Refused) as caught:
        import_document(text.encode(), "bad.xosc", {})
    assert reason in caught.value.reason
    assert caught.value.place is not None


def test_unknown_parts_are_reported_with_their_place() -> None:
    text = document("").replace("<Init>", '<Init><Strange what="1"/>')
    findings = imported(text).report.findings
    assert [(each.grade, each.construct) for each in findings] == [("left out", "<Strange>")]
    assert findings[0].place is not None


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_encodings(encoding: str) -> None:
    text = document("").replace('<?xml version="1.0" encoding="UTF-8"?>', "").strip()
    found = import_document(text.encode(encoding), "test.xosc", {}, name="two_cars")
    assert found.text == imported(text).text


def test_comments_are_kept() -> None:
    text = document(EVENTS.replace("<Action", "<!--Now it speeds up.--><Action", 1))
    assert "# Now it speeds up." in imported(text).text
