"""Names, strings and comments of a scenario never become code."""

from itertools import cycle
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.unit.hostile.texts import MULTILINE, TEXTS, quoted, skeleton, strings

SOURCE = """# {comment}
import osc.standard.all

namespace null use std, stdtypes

scenario |{scenario}|:
    road: map with:
        keep(it.map_file == {map})
    |{field}|: string = {text}
    ego: vehicle
    event |{event}|
    # {comment}
    do |{label}|: serial:
        # {comment}
        emit |{event}|
        |{action}|: ego.drive(duration: 3s) with:
            speed(30kph)
        wait elapsed(1s)
        wait (|{field}| == {text})
"""
HARMLESS = {
    "scenario": "harmless_scenario",
    "field": "harmless_field",
    "event": "harmless_event",
    "label": "harmless_label",
    "action": "harmless_action",
    "comment": "harmless comment",
}


def module(folder: Path, text: str = "harmless text", **names: str) -> str:
    """Return the module of the scenario; an empty text if the compiler refuses it."""
    path = folder / "source.osc"
    filled = {**HARMLESS, **names}
    source = SOURCE.format(text=quoted(text), map=quoted(text), **filled)
    path.write_bytes(source.encode())
    compilation = Compilation(path, path.name, CompileOptions())
    compilation.check()
    assert not [d for d in compilation.diagnostics if d.code.startswith("OSC9")]
    return compilation.module.python if compilation.module else ""


@pytest.fixture(scope="module")
def harmless(tmp_path_factory: pytest.TempPathFactory) -> str:
    return module(tmp_path_factory.mktemp("harmless"))


def assert_only_the_strings_differ(made: str, harmless: str, text: str) -> None:
    assert skeleton(made) == skeleton(harmless)
    expected = [text if known == "harmless text" else known for known in strings(harmless)]
    assert strings(made) == expected
    assert expected.count(text) >= 3  # the map, the field, the condition


@pytest.mark.parametrize("text", [*TEXTS, *MULTILINE], ids=ascii)
def test_strings(tmp_path: Path, harmless: str, text: str) -> None:
    assert_only_the_strings_differ(module(tmp_path, text), harmless, text)


@settings(max_examples=25)
@given(text=st.text(st.characters(exclude_categories=["Cs"]), max_size=40))
def test_any_string(tmp_path: Path, harmless: str, text: str) -> None:
    assert_only_the_strings_differ(module(tmp_path, text), harmless, text)


NAMES = [text for text in TEXTS if not set(text) & set("|\r\n\0\x0c\x1b\x7f\x85\u2028")]


KINDS = ("scenario", "field", "event", "label", "action")
SOME = list(zip(NAMES, cycle(KINDS), strict=False))
OTHERS = [(name, kind) for name in NAMES for kind in KINDS if (name, kind) not in SOME]


@pytest.mark.parametrize(
    ("name", "kind"),
    [*SOME, *(pytest.param(*case, marks=pytest.mark.slow) for case in OTHERS)],
    ids=ascii,
)
def test_names(tmp_path: Path, harmless: str, name: str, kind: str) -> None:
    assert skeleton(module(tmp_path, **{kind: name})) == skeleton(harmless)


@pytest.mark.parametrize("text", [t for t in TEXTS if "\x85" not in t], ids=ascii)
def test_comments(tmp_path: Path, harmless: str, text: str) -> None:
    assert skeleton(module(tmp_path, comment=text)) == skeleton(harmless)
