"""Mistakes: one message each, the rest of the file is understood."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.syntax import ast
from osc2tx.syntax.dump import dump_ast
from osc2tx.syntax.tokens import KEYWORDS, PUNCTUATION
from tests.unit.syntax.helpers import clean, parsed, reports

GOOD = """\
scenario top:
    x: int
    keep(x == 3)
    do serial:
        a.b() with:
            speed(3kph)
        parallel:
            wait elapsed(3s)
            emit done
"""
MISTAKES = [
    "a b c",
    "keep(x = 3)",
    "keep(x",
    "wait",
    "a.b(",
    "x: int = ",
    ") )",
    "@",
    "'abc",
    "; ;",
]


@pytest.mark.parametrize("mistake", MISTAKES)
@pytest.mark.parametrize("line", range(1, 10))
def test_a_line_with_a_mistake_gives_one_message(line: int, mistake: str) -> None:
    lines = GOOD.splitlines()
    indent = " " * (len(lines[line - 1]) - len(lines[line - 1].lstrip()))
    text = "\n".join([*lines[: line - 1], indent + mistake, *lines[line - 1 :]]) + "\n"
    found = parsed(text)[1]
    assert {d.primary.line for d in found if d.primary} == {line}
    assert len(found) == 1 or mistake == "; ;"


def test_members_around_a_mistake_survive() -> None:
    file, found = parsed("scenario s:\n    x: int\n    y int\n    z: int\nstruct t\n")
    assert len(found) == 1
    scenario, struct = file.statements
    assert isinstance(scenario, ast.ScenarioDeclaration) and isinstance(
        struct, ast.StructDeclaration
    )
    assert len(scenario.members) == 2


def test_mistakes_in_the_block_of_a_mistake_are_found() -> None:
    assert reports("scenario s x:\n    y: int\n    a b\n    do serial:\n        c d\n") == [
        (1, "OSC100"),
        (3, "OSC100"),
        (5, "OSC100"),
    ]


def test_the_number_of_reports_is_bounded() -> None:
    assert len(parsed("a b\n" * 5000)[1]) == 101


def test_deviations_can_be_allowed() -> None:
    text = "scenario s:  /* c */\n    event e()\n    do:\n        a.b()\nstruct t:\n"
    assert {d.code for d in parsed(text)[1]} == {"OSC111", "OSC112", "OSC113", "OSC114"}
    codes = frozenset({"OSC111", "OSC112", "OSC113", "OSC114"})
    assert parsed(text, allow=codes)[1] == ()


def test_a_use_statement_is_left_to_the_next_stage() -> None:
    (statement,) = clean("use std.stdtypes\n").statements
    assert isinstance(statement, ast.UseStatement) and statement.path == ("std", "stdtypes")


def nested(levels: int) -> str:
    lines = [" " * (level + 2) + "serial:" for level in range(levels)]
    return "\n".join(["scenario s:", " do serial:", *lines, " " * (levels + 3) + "a.b()"]) + "\n"


@pytest.mark.parametrize(
    "line",
    [
        f"keep({'(' * 10_000}1{')' * 10_000})",
        "keep(" + "(" * 10_000,
        "keep(" + "f(" * 10_000 + ")" * 10_000 + ")",
        "keep(" + "[" * 10_000 + "1" + "]" * 10_000 + ")",
        "keep(" + "a ? b : " * 10_000 + "c)",
        "keep(" + "a ? " * 10_000 + "c" + ": d" * 10_000 + ")",
        "keep(" + "-" * 10_000 + "1)",
        "keep(" + "not " * 10_000 + "a)",
    ],
)
def test_deep_nesting_is_refused(line: str) -> None:
    text = f"struct r:\n    x: int\nscenario s:\n    {line}\nscenario t:\n    keep(x = 3)\n"
    assert reports(text) == [(4, "OSC105"), (6, "OSC100")]
    assert isinstance(parsed(text)[0].statements[0], ast.StructDeclaration)


def test_deep_blocks_are_refused() -> None:
    assert [code for _, code in reports(GOOD + nested(1000) + "struct t\nx y\n")] == [
        "OSC105",
        "OSC100",
    ]


def test_nesting_up_to_the_limit() -> None:
    file = clean(nested(190))
    assert dump_ast(file).count("Composition") == 191
    clean("struct s:\n    keep(" + "f(" * 190 + "1" + ")" * 190 + ")\n")
    clean("struct s:\n    keep([" + "a ? b : c, " * 1000 + "d] == e)\n")


def test_odd_texts() -> None:
    assert parsed("")[1] == parsed(" \n\t\n\f")[1] == parsed("# only a comment")[1] == ()
    assert parsed("# only\n  # comments\n")[1] == ()
    assert reports("\\") == [(1, "OSC102")]
    assert reports("scenario a\0b:\n    x: int\n") == [(1, "OSC102")]
    clean('struct s:\n    keep(x == "' + "a" * 1_000_000 + '")\n')
    clean('struct s:\n    keep(x == """' + "\\n\n" * 300_000 + '""")\n')
    for end in ("\n", "\r", "\r\n"):
        assert dump_ast(clean(GOOD.replace("\n", end))) == dump_ast(clean(GOOD))


WORDS = [
    *KEYWORDS,
    *PUNCTUATION,
    "x",
    "3",
    "5m",
    "'a'",
    '"',
    '"""',
    "#",
    "\\",
    "|",
    "/*",
    "*/",
    "SI",
]
TOKENS = st.sampled_from([*WORDS, "\n", "\n    ", "\n        ", "\n\t", ":\n    ", "\r", "("])


@settings(max_examples=400)
@given(st.lists(TOKENS, max_size=80).map(" ".join) | st.text(max_size=200))
def test_any_text_can_be_parsed(text: str) -> None:
    file, _ = parsed(text)
    assert dump_ast(file)


@settings(max_examples=150)
@given(st.data())
def test_damaged_scenarios_can_be_parsed(data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(GOOD)))
    end = data.draw(st.integers(start, min(start + 12, len(GOOD))))
    file, _ = parsed(GOOD[:start] + data.draw(st.sampled_from(["", *WORDS, "\n"])) + GOOD[end:])
    assert dump_ast(file)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "    var limit: speed = slow\n&&\n        speed(limit)\n",
            [(1, "OSC100"), (1, "OSC108"), (2, "OSC102")],
        ),
        ("&&\n    x: int\nstruct t\n", [(1, "OSC102")]),
        ("&&\n    &&\n        x: int\n    &&\n        &&\n", [(n, "OSC102") for n in (1, 2, 4, 5)]),
        ("struct r:\n&&\n    x: int\n    y int\nstruct t\n", [(2, "OSC102"), (4, "OSC100")]),
        ("scenario s:\n    x: int\n    &&\n        y: int\n    z: int\n", [(3, "OSC102")]),
        (
            "scenario s:\n    do serial:\n        &\n            a.b()\n        c.d()\n",
            [(3, "OSC102")],
        ),
    ],
)
def test_a_block_under_a_line_of_unknown_characters_is_passed_over(
    text: str, expected: list[tuple[int, str]]
) -> None:
    assert reports(text) == expected
    assert (
        len(parsed(text + "struct last\n")[0].statements)
        == text.count("struct") + text.count("scenario") + 1
    )
