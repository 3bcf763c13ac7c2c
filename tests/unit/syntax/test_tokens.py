"""The token source: layout, literals, contextual keywords, tiling."""

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.syntax._antlr import OpenSCENARIO2
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, KEYWORDS, NEWLINE, PUNCTUATION
from tests.unit.syntax.helpers import scanned, shown


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "EOF"),
        ("  \n\t\n# c\n\f\n", "EOF"),
        ("a\n", "a NEWLINE EOF"),
        ("a", "a NEWLINE EOF"),
        ("\ufeffa\r\nb\rc\n", "a NEWLINE b NEWLINE c NEWLINE EOF"),
        (
            "a\n  b\n    c\nd",
            "a NEWLINE INDENT b NEWLINE INDENT c NEWLINE DEDENT DEDENT d NEWLINE EOF",
        ),
        ("a\n\tb\n        c", "a NEWLINE INDENT b NEWLINE c NEWLINE DEDENT EOF"),
        ("a\n \tb\n        c", "a NEWLINE INDENT b NEWLINE c NEWLINE DEDENT EOF"),
        ("a\n\f  b\n  c", "a NEWLINE INDENT b NEWLINE c NEWLINE DEDENT EOF"),
        ("a(\n      b,\n\nc # x\n)\nd", "a ( b , c ) NEWLINE d NEWLINE EOF"),
        ("a \\\n   b\nc", "a b NEWLINE c NEWLINE EOF"),
        ("a # \\\nb", "a NEWLINE b NEWLINE EOF"),
        ("a\n    # far\n  # near\nb", "a NEWLINE b NEWLINE EOF"),
    ],
)
def test_layout(text: str, expected: str) -> None:
    assert shown(text) == expected.split()
    assert scanned(text)[1] == ()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("[1..5]", "[ 1 .. 5 ]"),
        ("[5m..10m]", "[ 5m .. 10m ]"),
        ("3.as", "3 . as"),
        (".5 1.5e3 2e3 2em 2e3m 1e6.5", ".5 1.5e3 2e3 2em 2e3m 1e6 .5"),
        ("0x1F 0x1Fg 0xg", "0x1F 0x1Fg 0xg"),
        ("5|km/h| 5std::m 5::m 5std::|x/y|", "5|km/h| 5std::m 5::m 5std::|x/y|"),
        ("a::b ::c |x/y|::d null::e", "a::b ::c |x/y|::d null::e"),
        ("a::* ::* *", "a::* ::* *"),
        ("a :: b", "a :: b"),
        ("x:::y", "x : ::y"),
        ("a->b=>c>=d<=e==f!=g!h-1", "a -> b => c >= d <= e == f != g ! h - 1"),
        ("a-1", "a - 1"),
        ("'a\\'b' \"\" \"\"\"a\"b\"\"\" ''''x'''", "'a\\'b' \"\" \"\"\"a\"b\"\"\" ''''x'''"),
        ("größe Ⅷ a‿b क्ष", "größe Ⅷ a‿b क्ष"),
    ],
)
def test_tokens_of_a_line(text: str, expected: str) -> None:
    assert shown(text) == [*expected.split(" "), "NEWLINE", "EOF"]
    assert scanned(text)[1] == ()


@pytest.mark.parametrize("text", ["a² b", "²", "a\u00a0b"])
def test_characters_outside_of_identifiers(text: str) -> None:
    assert [d.code for d in scanned(text)[1]] == ["OSC102"]


@pytest.mark.parametrize("word", sorted(KEYWORDS))
def test_every_word_may_be_a_name(word: str) -> None:
    text = f"struct a:\n    {word}: {word} = x.{word}\n    b, {word}: c\n    keep(f({word}: 3))\n"
    assert word.upper() not in shown(text) or word in ("struct", "keep")


def test_comments_are_kept_apart() -> None:
    table, _ = scanned("# one\na #two  \n    #  three\nb(#four\n#five\n)")
    texts = [(c.text, c.alone, c.column, c.line is not None) for c in table.comments]
    assert texts == [
        ("one", True, 0, False),
        ("two", False, 0, True),
        (" three", True, 4, False),
        ("four", False, 0, True),
        ("five", True, 0, True),
    ]


def test_token_numbers_are_those_of_the_parser() -> None:
    assert (NEWLINE, INDENT, DEDENT, EOF) == (1, 2, 3, -1)
    assert KEYWORDS["serial"] == OpenSCENARIO2.SERIAL


BLANKS = [" ", "\n", "    ", "\t", "\f", "\r", "\r\n", "\\", "\\\n", "#c"]
MARKS = ["'", '"', '"""', "|x|", "|", "/*", "*/", "//", "²", "\0"]
PIECES = st.sampled_from([*BLANKS, *MARKS, *PUNCTUATION, "scenario", "a", "5m", "0x1", "1.5"])


@settings(max_examples=300)
@given(st.lists(PIECES | st.characters(), max_size=60).map("".join))
def test_tokens_tile_the_text(text: str) -> None:
    """Tokens come in order and do not overlap; what lies between them is no code, or reported."""
    table, diagnostics = scanned(text)
    bounds = list(zip(table.starts, table.ends, strict=True))
    assert all(start <= end for start, end in bounds)
    assert all(a[1] <= b[0] for a, b in itertools.pairwise(bounds))
    assert table.types.count(INDENT) == table.types.count(DEDENT)
    assert table.types[-1] == EOF
    if not diagnostics:
        gaps = [a[1] for a in [(0, 0), *bounds]], [b[0] for b in [*bounds, (len(text), 0)]]
        for start, end in zip(*gaps, strict=True):
            lines = text[start:end].replace("\r", "\n").split("\n")
            assert all(line.strip(" \t\f\\\ufeff")[:1] in ("", "#") for line in lines)
