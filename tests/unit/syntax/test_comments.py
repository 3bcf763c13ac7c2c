"""Which statement a comment belongs to: the forms that indentation and blank lines can take."""

from collections.abc import Iterator

import pytest

from osc2tx.analysis.tree_walk import children_of
from osc2tx.syntax import ast
from tests.unit.syntax.helpers import clean

# Text -> where each comment belongs: the line of its statement, `below` it, `end` of the one with
# the block. An empty one parts groups, or a comment from its statement.
CASES = {
    "above": ("# a\nactor x\n", {"a": 2}),
    "above_with_a_blank_line": ("actor x\n\n# a\n\nactor y\n", {"a": 5}),
    "first_of_a_file": ("# a\n\n# b\n\nactor x\n", {"a": 5, "": 5, "b": 5}),
    "touches_what_is_above": ("actor x\n# a\n\nactor y\n", {"a": "below 1"}),
    "touches_both": ("actor x\n# a\nactor y\n", {"a": 3}),
    "touches_the_block_above": (
        "struct s:\n    x: int\n# a\n\nactor y\n",
        {"a": "below 1"},
    ),
    "two_groups": (
        "actor x\n# a\n# b\n\n# c\n\n# d\nactor y\n",
        {"a": "below 1", "b": "below 1", "c": 8, "": 8, "d": 8},
    ),
    "first_of_a_block": ("struct s:\n    # a\n\n    x: int\n", {"a": 4, "": 4}),
    "deeper_first_of_a_block": ("struct s:\n        # a\n    x: int\n", {"a": 3}),
    "less_deep": ("struct s:\n    x: int\n# a\n    y: int\n", {"a": 4}),
    "deeper_without_a_block": ("modifier m\n    # a\nmodifier n\n", {"a": "below 1"}),
    "deeper_after_a_blank_line": ("modifier m\n\n    # a\nmodifier n\n", {"a": "below 1"}),
    "deeper_in_a_group": ("# a\n    # b\nactor x\n", {"a": 3, "b": 3}),
    "end_of_a_plain_block": (
        "struct s:\n    x: int\n    # a\n# b\nactor y\n",
        {"a": "below 2", "b": 5},
    ),
    "end_of_a_with_block": (
        "scenario s:\n    do serial:\n        a.b() with:\n            c()\n            # a\n"
        "        # b\n        d.e()\n",
        {"a": "below 4", "b": 7},
    ),
    "ends_of_blocks": (
        "scenario s:\n    do serial:\n        parallel:\n            a.b()\n            # a\n\n"
        "            # b\n        # c\n    # d\n# e\n",
        {"a": "end 3", "": "end 3", "b": "end 3", "c": "end 2", "d": "end 1", "e": "below 1"},
    ),
    "between_the_columns": (
        "scenario s:\n    do serial:\n        a.b()\n      # a\n  # b\nactor x\n",
        {"a": "end 1", "b": "end 1"},
    ),
    "tabs": ("scenario s:\n    do serial:\n        a.b()\n\t# a\n", {"a": "end 2"}),
    "blanks_at_the_end": ("actor x\n# a\n    ", {"a": "below 1"}),
    "end_of_file": ("actor x\n\n# a\n", {"a": "below 1"}),
    "behind": ("actor x  # a\n# b\nactor y\n", {"a": 1, "b": 3}),
    "behind_a_header": ("struct s:  # a\n    x: int  # b\n", {"a": 1, "b": 2}),
    "in_brackets": (
        "enum e: [  # a\n    # b\n    x  # c\n    # d\n]\n",
        {"a": 1, "b": 3, "c": 3, "d": "below 1"},
    ),
    "in_a_call": (
        "scenario s:\n    do a.b(  # a\n        # b\n        c: 1\n    )  # c\n",
        {"a": 2, "b": 2, "c": 2},
    ),
    "joined_lines": ("struct s:\n    x: int \\\n        = 1  # a\n", {"a": 2}),
    "above_with": (
        "scenario s:\n    do serial:\n        a.b()\n    # a\n    with:  # b\n        until @x\n",
        {"a": 6, "b": 6},
    ),
    "line_ends": (
        "actor x\r\n# a\r\n\r\nactor y\r\n# b\r\nactor z\r",
        {"a": "below 1", "b": 6},
    ),
}


def belongings(node: ast.Node) -> Iterator[tuple[str, object]]:
    line = node.span.line
    for comment in getattr(node, "comments", ()):
        yield comment, line
    if (trailing := getattr(node, "trailing_comment", None)) is not None:
        yield trailing, line
    for comment in getattr(node, "comments_below", ()):
        yield comment, f"below {line}"
    for comment in getattr(node, "end_comments", ()):
        yield comment, f"end {line}"
    for child in children_of(node):
        yield from belongings(child)


@pytest.mark.parametrize("case", CASES)
def test_belongs_to(case: str) -> None:
    text, expected = CASES[case]
    found = list(belongings(clean(text)))
    assert dict(found) == expected
    assert len(found) == len(expected)
