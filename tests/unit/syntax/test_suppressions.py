"""Where comments that suppress are found, and which lines they mean."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx.diagnostics import SourceFile
from osc2tx.syntax.suppressions import find_suppressions


def found(text: str) -> list[tuple[list[str], list[int]]]:
    suppressions = find_suppressions(SourceFile("a.osc", text))
    return [([name.text for name in item.names], list(item.lines)) for item in suppressions]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a: b  #! allow OSC603\n", [(["OSC603"], [1])]),
        ("a: b  #! allow OSC603", [(["OSC603"], [1])]),
        ("a: b #!allow x-y ,z: it, is: so\nc: d\n", [(["x-y", "z"], [1])]),
        ("\n#! allow A\n\n# why\na: b\nc: d\n", [(["A"], [5])]),
        ("#! allow A\n#! allow B\na: b\n", [(["A"], [3]), (["B"], [3])]),
        ("#! allow A\r\na.b(1,\r\n  2,\r\n  3)\r\nc: d\r\n", [(["A"], [2, 3, 4])]),
        ("a.b(1,\n  #! allow A\n  2,\n  3)\n", [(["A"], [3])]),
        ("a.b(1, #! allow A\n  2)\n", [(["A"], [1])]),
        ("s:\n    a: b\n#! allow A\n\nt:\n    c: d\n", [(["A"], [5])]),
        ("s:\n    #! allow A\n    a: b\n", [(["A"], [3])]),
        ("a: b\n#! allow A\n", [(["A"], [])]),
        ("#! allow\na: b\n", [([], [2])]),
        ("#! allow : because\na: b\n", [([], [2])]),
        ("#! allow A B\na: b\n", [(["A B"], [2])]),
        ('a: "#! allow A"\n', []),
        ('a: """\n#! allow A\n"""\n', []),
        ("# see #! allow A\na: b\n", []),
        ("a: b # x #! allow A\n", []),
        ("// #! allow A\na: b\n", []),
        ("a: b #! allowed A\n", []),
        ("a: b #! allow-all A\n", []),
        ("a: b #! since 2.2\nc: d #! until 2.1\n", []),
        ("a: (b #! allow A\nc: d\n", [(["A"], [1])]),
        ("", []),
    ],
)
def test_comments(text: str, expected: list[tuple[list[str], list[int]]]) -> None:
    assert found(text) == expected


def test_very_many_cost_no_more_than_they_are() -> None:
    many = 20_000
    text = "#! allow A\n" * many + "a.b(\n" + "  1,\n" * many + "  2)\n"
    suppressions = find_suppressions(SourceFile("a.osc", text))
    assert len(suppressions) == many
    assert suppressions[0].lines == range(many + 1, 2 * many + 3)


FRAGMENTS = ["#! allow A", "#", '"', '"""', "(", ")", "\n", "\r", "    ", "a: b", "/*", "*/", "\\"]


@given(st.lists(st.sampled_from(FRAGMENTS), max_size=30).map("".join) | st.text(max_size=40))
def test_any_text_can_be_searched(text: str) -> None:
    lines = len(SourceFile("a.osc", text).line_starts)
    for suppression in find_suppressions(SourceFile("a.osc", text)):
        assert suppression.span.text.startswith("#!")
        assert all(1 <= line <= lines for line in suppression.lines)
        assert all("\n" not in name.text and name.text.strip() for name in suppression.names)
