"""Lines of documents: short enough to be read in a diff, and each with a thing of its own."""

from pathlib import Path

from lxml import etree

from osc2tx.backends.xosc.xml.layout import lay_out

GENERATED = Path(__file__).parents[4] / "generated"


def laid_out(text: str) -> list[str]:
    root = etree.fromstring(text)
    lay_out(root)
    return etree.tostring(root, encoding="unicode").splitlines()


def test_lines_of_the_repository_can_be_read() -> None:
    documents = sorted(GENERATED.rglob("*.xosc"))
    assert len(documents) > 60
    lines = [line for path in documents for line in path.read_text(encoding="utf-8").splitlines()]
    assert max(map(len, lines)) <= 220
    assert max(len(line.strip()) for line in lines) <= 200


def test_members_of_lists_have_lines_of_their_own() -> None:
    assert laid_out("<Polyline><Vertex time='0'/><Vertex time='1'/></Polyline>") == [
        "<Polyline>",
        '  <Vertex time="0"/>',
        '  <Vertex time="1"/>',
        "</Polyline>",
    ]


def test_an_event_has_lines_for_its_action_and_its_trigger() -> None:
    assert laid_out("<Event><Action><A/></Action><StartTrigger/></Event>") == [
        "<Event><Action><A/></Action>",
        "  <StartTrigger/></Event>",
    ]


def test_what_is_too_long_goes_on_below() -> None:
    """Start tags and elements without children are never broken; end tags stay together."""
    first, second = (f'<{tag} name="{tag * 120}"/>' for tag in "xy")
    assert laid_out(f"<P><Q>{first}{second}</Q></P>") == [
        f"<P><Q>{first}",
        f"  {second}</Q></P>",
    ]
    long = f'<z name="{"z" * 180}"/>'
    assert laid_out(f"<Outer><Inner>{long}</Inner></Outer>") == [
        "<Outer><Inner>",
        f"  {long}",
        "</Inner></Outer>",
    ]
