"""Names of nodes are the text of the source on one line."""

import pytest

from osc2tx.ir.source_text import MAX_LENGTH, condensed, shorten


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("rise(a  >\n    b)", "rise(a > b)"),
        ("rise(\n        a > b\n    )", "rise(a > b)"),
        ("x in [\n  1m..\n  2m\n]", "x in [1m.. 2m]"),
        ("f( a )", "f( a )"),  # as the author has it
    ],
)
def test_condensed(text: str, expected: str) -> None:
    assert condensed(text) == expected


def test_shorten() -> None:
    assert shorten("a" * MAX_LENGTH) == "a" * MAX_LENGTH
    assert shorten("a" * (MAX_LENGTH + 1)) == "a" * (MAX_LENGTH - 1) + "…"
