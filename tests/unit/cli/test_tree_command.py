"""`osc2tx tree`: the behavior tree in words and as a picture."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from lxml import etree

from osc2tx.cli import cli
from osc2tx.cli.reporting import Session

SOURCE = """
import osc.standard

scenario two_steps:
    ego: vehicle
    event ready

    do parallel:
        steps: serial:
            ego.drive(duration: 3s) with:
                speed(10mps)
            wait @ready
            rest: ego.drive(duration: 1s)
        emit ready
"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "two_steps.osc"
    path.write_text(SOURCE)
    return path


def tree(*arguments: str | Path) -> Result:
    words = ["tree", *map(str, arguments)]
    return CliRunner().invoke(cli, words, standalone_mode=False, obj=Session())


def test_text(source: Path) -> None:
    assert tree(source).output == (
        "parallel two_steps                                two_steps.osc:8\n"
        "├─ serial steps                                   two_steps.osc:9\n"
        "│  ├─ ego.drive(speed(10 * mps), duration=3 * s)  two_steps.osc:10\n"
        "│  ├─ wait @ready                                 two_steps.osc:12\n"
        "│  └─ rest: ego drive                             two_steps.osc:13\n"
        "└─ emit ready                                     two_steps.osc:14\n"
    )


def test_a_narrow_terminal_cuts_texts_and_keeps_places(source: Path, monkeypatch) -> None:
    monkeypatch.setattr("osc2tx.cli.tree.columns", lambda: 50)
    lines = tree(source).output.splitlines()
    assert max(map(len, lines)) <= 50
    assert lines[2] == "│  ├─ ego.drive(speed(10 * mps)…  two_steps.osc:10"
    assert [line.split()[-1] for line in lines] == [
        f"two_steps.osc:{number}" for number in (8, 9, 10, 12, 13, 14)
    ]


def test_colors_are_those_that_are_asked_for(source: Path, monkeypatch) -> None:
    """Nothing but the colors is different; pictures have none."""
    plain = tree(source).output
    monkeypatch.setenv("FORCE_COLOR", "1")
    painted = CliRunner().invoke(
        cli, ["tree", str(source)], standalone_mode=False, obj=Session(), color=True
    )
    assert "\x1b[1mparallel\x1b[0m two_steps" in painted.output
    assert "\x1b[2mtwo_steps.osc:9\x1b[0m" in painted.output
    assert re.sub(r"\x1b\[\d+m", "", painted.output) == plain
    assert "\x1b" not in tree(source, "--form", "svg").output
    monkeypatch.setenv("NO_COLOR", "1")
    assert tree(source).output == plain


def test_picture(source: Path) -> None:
    """Well-formed, a row for each node, nothing outside of the page."""
    output = tree(source, "--form", "svg").output
    root = etree.fromstring(output.encode())
    width, height = float(root.get("width", "")), float(root.get("height", ""))
    texts = [text for text in root.iterfind("{*}text") if text.text]
    assert [t.text for t in texts if t.text and ".osc:" in t.text] == [
        f"two_steps.osc:{line}" for line in (8, 9, 10, 12, 13, 14)
    ]
    assert all(0 < float(t.get("x", "")) < width for t in texts)
    assert all(0 < float(t.get("y", "")) < height for t in texts)
    assert output == tree(source, "--form", "svg").output


def test_strings_cannot_leave_the_picture(source: Path) -> None:
    source.write_text(SOURCE.replace("steps: serial", "|</text><script>|: serial"))
    root = etree.fromstring(tree(source, "--form", "svg").output.encode())
    assert not root.findall(".//{*}script")


def test_errors_are_reported(source: Path) -> None:
    source.write_text(SOURCE.replace("@ready", "@redy"))
    result = tree(source)
    assert result.return_value == 3
    assert "redy" in result.output
    source.write_text("struct s\n")
    assert "declares no scenario" in str(tree(source).exception)
