"""What is printed steers no terminal and gives no CI server a command, wherever it comes from."""

import json
import unicodedata
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx_shared.text import complain, in_json, in_xml, put, say, visible
from tests.unit.hostile.texts import MULTILINE, TEXTS

COMMANDS = ["::error::x", "  ::set-output name=a::b", "\u3000::add-mask::x", "a ##[error]b"]
COMMANDS += ["##vso[task.setvariable variable=a]b", "x ##teamcity[buildStop]", "#####[group]"]
TEXT = st.text(st.characters(exclude_categories=["Cs"]))


def is_steering(char: str) -> bool:
    return unicodedata.category(char) in {"Cc", "Cf", "Cs", "Zl", "Zp"}


def obeyed(line: str) -> bool:
    """Whether a CI server takes a line for a command, by what their documentation says."""
    return line.lstrip().startswith("::") or any(
        f"##{name}[" in line for name in ("", "vso", "teamcity")
    )


@pytest.mark.parametrize("text", [*TEXTS, *MULTILINE, *COMMANDS, "\udcff"], ids=ascii)
def test_one_line_stays_one_line(capsys: pytest.CaptureFixture[str], text: str) -> None:
    say(text)
    complain(f"a: {text}")
    for stream in capsys.readouterr():
        line = stream.removesuffix("\n")
        assert not any(map(is_steering, line))
        assert not obeyed(line)


@pytest.mark.parametrize("text", COMMANDS, ids=ascii)
def test_no_line_of_several_is_a_command(capsys: pytest.CaptureFixture[str], text: str) -> None:
    put(f"one\n{text}\n\ttwo\n")
    lines = capsys.readouterr().out.splitlines()
    assert (len(lines), lines[0], lines[2]) == (3, "one", "\ttwo")
    assert not any(map(obeyed, lines))


def test_colors_pass_and_nothing_else(capsys: pytest.CaptureFixture[str]) -> None:
    put("\x1b[31mred\x1b[0m \x1b[2J\x1b]0;title\x07", colored=True)
    assert capsys.readouterr().out == "\x1b[31mred\x1b[0m \\x1b[2J\\x1b]0;title\\x07\n"


@given(TEXT)
def test_what_is_harmless_stays_as_it_is(text: str) -> None:
    harmless = "".join(char for char in text if not is_steering(char))
    assert visible(harmless) == harmless


@given(TEXT)
def test_json_says_the_same(text: str) -> None:
    written = in_json(json.dumps({text: [text]}, ensure_ascii=False))
    assert json.loads(written) == {text: [text]}
    assert not any(map(is_steering, written))
    assert not obeyed(written)


@given(st.text(st.characters(exclude_categories=["Cs", "Cc"])))
def test_xml_says_the_same(text: str) -> None:
    root = ElementTree.Element("a", name=text)
    root.text = text.replace("\ufffe", "").replace("\uffff", "")
    root.set("name", root.text)
    written = in_xml(ElementTree.tostring(root, encoding="unicode"))
    assert not any(map(is_steering, written.replace("\n", "")))
    read = ElementTree.fromstring(written)
    assert (read.get("name"), read.text or "") == (root.get("name"), root.text)
