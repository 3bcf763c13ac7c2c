"""Lines of documents: each with a thing of its own, however long that is."""

import re
from pathlib import Path

from lxml import etree

GENERATED = Path(__file__).parents[4] / "generated"


def laid_out(root: etree._Element) -> list[str]:
    lay_out(root)
    return etree.tostring(root, encoding="unicode").splitlines()


def lines_of(text: str) -> list[str]:
    return laid_out(etree.fromstring(text))


def test_a_line_of_the_repository_has_one_thing() -> None:
    documents = sorted(GENERATED.rglob("*.xosc"))
    assert len(documents) > 60
    lines = [line for path in documents for line in path.read_text(encoding="utf-8").splitlines()]
    for tag in ("Event", "Action", "Condition", "PrivateAction", "GlobalAction", "ScenarioObject"):
        opening = re.compile(f"<{tag}[ >]")
        assert any(map(opening.search, lines)), tag
        assert [line for line in lines if len(opening.findall(line)) > 1] == [], tag


def test_a_longer_value_changes_only_its_line() -> None:
    parser = etree.XMLParser(remove_blank_text=True)
    before = etree.parse(GENERATED / "cut_in.xosc", parser).getroot()
    short = laid_out(before)
    for index, node in enumerate(before.iter()):
        for name in node.attrib:
            after = etree.parse(GENERATED / "cut_in.xosc", parser).getroot()
            list(after.iter())[index].attrib[name] = "x" * 300
            long = laid_out(after)
            assert len(long) == len(short)
            assert sum(old != new for old, new in zip(short, long, strict=True)) == 1


def test_members_of_lists_have_lines_of_their_own() -> None:
    assert lines_of("<Private><PrivateAction/><PrivateAction/></Private>") == [
        "<Private>",
        "  <PrivateAction/>",
        "  <PrivateAction/>",
        "</Private>",
    ]


def test_a_curve_is_one_line() -> None:
    curve = '<Polyline><Vertex time="0"/><Vertex time="1"/></Polyline>'
    assert lines_of(curve) == [curve]


def test_an_event_has_lines_for_its_actions_and_its_trigger() -> None:
    event = "<Event><Action><A/></Action><Action><B/></Action><StartTrigger/></Event>"
    assert lines_of(event) == [
        "<Event>",
        "  <Action><A/></Action>",
        "  <Action><B/></Action>",
        "  <StartTrigger/>",
        "</Event>",
    ]


def test_each_condition_has_a_line_of_its_own() -> None:
    group = "<ConditionGroup><Condition/></ConditionGroup>"
    assert lines_of(f"<StartTrigger>{group}</StartTrigger>") == [
        "<StartTrigger>",
        "  <ConditionGroup>",
        "    <Condition/>",
        "  </ConditionGroup>",
        "</StartTrigger>",
    ]


def test_an_only_child_stands_on_the_line_of_its_parent() -> None:
    assert lines_of("<A><B><C><D/><E/></C></B></A>") == [
        "<A><B><C>",
        "  <D/>",
        "  <E/>",
        "</C></B></A>",
    ]
