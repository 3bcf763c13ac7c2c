"""Names, strings and comments of a scenario never become code.

A file has a scenario for each hostile text, so that many are looked at at once.
"""

import ast
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.unit.hostile.texts import MULTILINE, TEXTS, quoted, skeleton, strings

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n"
SCENARIO = """
# {comment}
scenario |{scenario}|:
    road: map with:
        keep(it.map_file == {text})
    |{field}|: string = {text}
    ego: vehicle
    event |{event}|
    # {comment}
    do |{label}|: serial:
        # {comment}
        emit |{event}|
        |{action}|: ego.drive(duration: 3s)
        wait (|{field}| == {text})
"""
KINDS = ("scenario", "field", "event", "label", "action")
ALL_TEXTS = [*TEXTS, *MULTILINE]
NAMES = [text for text in TEXTS if not set(text) & set("|\r\n\0\x0c\x1b\x7f\x85\u2028")]
COMMENTS = [text for text in TEXTS if "\x85" not in text]


def harmless(number: int) -> dict[str, str]:
    """Return what a scenario says if nobody means harm."""
    return {kind: f"harmless_{kind}_{number}" for kind in (*KINDS, "comment", "text")}


def module(folder: Path, scenarios: Sequence[Mapping[str, str]]) -> str:
    """Return the module of a file with scenarios that say these things."""
    source = HEAD + "".join(
        SCENARIO.format(**{**said, "text": quoted(said["text"])})
        for said in ({**harmless(number), **given} for number, given in enumerate(scenarios))
    )
    comments = (said["comment"] for said in scenarios if "comment" in said)
    path = folder / "source.osc"
    path.write_bytes("".join([*(f"# {comment}\n" for comment in comments), source]).encode())
    compilation = Compilation(path, path.name, CompileOptions())
    assert compilation.module is not None, compilation.diagnostics
    return compilation.module.python


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., str]:
    """Return the module of a number of scenarios that mean no harm."""

    @cache
    def made(number: int, *, comments: bool = False) -> str:
        said = {"comment": "harmless"} if comments else {}
        return module(tmp_path_factory.mktemp("harmless"), [said] * number)

    return made


def assert_only_the_strings_differ(folder: Path, texts: Sequence[str], known: str) -> None:
    made = module(folder, [{"text": text} for text in texts])
    assert skeleton(made) == skeleton(known)
    replaced = {harmless(number)["text"]: text for number, text in enumerate(texts)}
    expected = strings(known)
    assert all(expected.count(text) >= 3 for text in replaced)  # map, field, condition
    assert strings(made) == [replaced.get(text, text) for text in expected]


@pytest.mark.slow
def test_strings(tmp_path: Path, known: Callable[..., str]) -> None:
    assert_only_the_strings_differ(tmp_path, ALL_TEXTS, known(len(ALL_TEXTS)))


@pytest.mark.slow
@settings(max_examples=25)
@given(text=st.text(st.characters(exclude_categories=["Cs"]), max_size=40))
def test_any_string(tmp_path: Path, known: Callable[..., str], text: str) -> None:
    assert_only_the_strings_differ(tmp_path, [text], known(1))


def without_names_of_events(python: str) -> str:
    """Leave the literals out that events have whose names are no identifiers."""
    tree = ast.parse(python)
    for node in ast.walk(tree):
        match node:
            case ast.Call(
                func=ast.Name(id="Event"),
                args=[],
                keywords=[ast.keyword(arg="name", value=ast.Constant(value=str(name)))],
            ):
                assert name in NAMES
                node.keywords = []
    return ast.unparse(tree)


@pytest.mark.slow
@pytest.mark.parametrize("shift", range(len(KINDS)))
def test_names(tmp_path: Path, known: Callable[..., str], shift: int) -> None:
    """Each as the name of something, and of all else."""
    kinds = [KINDS[(number + shift) % len(KINDS)] for number in range(len(NAMES))]
    made = module(tmp_path, [{kind: name} for kind, name in zip(kinds, NAMES, strict=True)])
    assert skeleton(without_names_of_events(made)) == skeleton(known(len(NAMES)))


@pytest.mark.slow
def test_comments(tmp_path: Path, known: Callable[..., str]) -> None:
    made = module(tmp_path, [{"comment": text} for text in COMMENTS])
    assert skeleton(made) == skeleton(known(len(COMMENTS), comments=True))
