"""Lines of documents: each with a thing of its own, however long that is."""

import re
from collections.abc import Iterator
from pathlib import Path

from osc2tx.xosc import Element, read
from osc2tx.xosc import elements as xml
from osc2tx.xosc.numbers import Noted
from osc2tx.xosc.writer import written

GENERATED = Path(__file__).parents[3] / "generated"


def lines_of(text: str) -> list[str]:
    return laid_out(read(text))


def laid_out(root: Element) -> list[str]:
    return written(root).splitlines()[1:]


def test_a_line_of_the_repository_has_one_thing() -> None:
    documents = sorted(GENERATED.rglob("*.xosc"))
    assert len(documents) > 60
    lines = [line for path in documents for line in path.read_text(encoding="utf-8").splitlines()]
    for tag in ("Event", "Action", "Condition", "PrivateAction", "GlobalAction", "ScenarioObject"):
        opening = re.compile(f"<{tag}[ >]")
        assert any(map(opening.search, lines)), tag
        assert [line for line in lines if len(opening.findall(line)) > 1] == [], tag


def lengthened(node: Element, index: list[int], name: str) -> Element:
    """Return a document with a longer text of an attribute of one of its elements."""
    if not index:
        return node.with_attributes(dict(node.attributes) | {name: "x" * 300})
    children = list(node.children)
    children[index[0]] = lengthened(children[index[0]], index[1:], name)
    return node.with_children(*children)


def paths(node: Element) -> Iterator[tuple[list[int], Element]]:
    yield [], node
    for place, child in enumerate(node.children):
        yield from (([place, *path], below) for path, below in paths(child))


def test_a_longer_value_changes_only_its_line() -> None:
    root = read((GENERATED / "cut_in.xosc").read_bytes())
    short = laid_out(root)
    for path, node in paths(root):
        for name, _ in node.attributes:
            long = laid_out(lengthened(root, path, name))
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


def test_notes_stand_at_the_end_of_the_line() -> None:
    """Whatever a source says, a note is one comment, and no part of the document."""
    notes = {"v_ego": "v_ego", "a --> b": "a - -> b", "x ---\n y": "x - - - y"}
    line = '<SpeedActionTarget><AbsoluteTargetSpeed value="19.5"/></SpeedActionTarget>'
    for note, text in notes.items():
        target = xml.AbsoluteTargetSpeed(value=Noted(19.5, note))
        document = xml.SpeedActionTarget(target)
        assert laid_out(xml.Private(document, document, entityRef="ego")) == [
            '<Private entityRef="ego">',
            f"  {line}  <!-- {text} -->",
            f"  {line}  <!-- {text} -->",
            "</Private>",
        ]
        assert read(written(document)) == document
        assert target == xml.AbsoluteTargetSpeed(value=19.5)


def test_long_notes_are_cut() -> None:
    (line,) = laid_out(xml.AbsoluteTargetSpeed(value=Noted(1.0, "v + " * 100)))
    assert len(line) < 120 and line.endswith("… -->")
