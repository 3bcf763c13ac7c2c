"""Fragments of Python cannot be broken out of."""

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx.backends.py_trees.code import PyComment, PyDocLine, PyName, literal
from osc2tx.backends.py_trees.naming import NameTable, class_name, identifier


@given(st.text())
def test_a_string_literal_is_the_string(text: str) -> None:
    assert ast.literal_eval(literal(text).text) == text


@given(st.floats(allow_nan=False) | st.integers() | st.booleans())
def test_a_number_literal_is_the_number(value: float) -> None:
    assert eval(literal(value).text) == value


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.5, "0.5"),
        (-0.0000475, "-0.0000475"),
        (4.75e-13, "4.75e-13"),
        (1.5e-9, "1.5e-9"),
        (1e16, "1e16"),
    ],
)
def test_a_number_is_spelled_as_a_person_would(value: float, text: str) -> None:
    assert literal(value).text == text


@given(st.text())
def test_a_comment_stays_a_comment(text: str) -> None:
    tree = ast.parse(f"x = 1  {PyComment.of(text)}\ny = 2\n")
    assert len(tree.body) == 2


@given(st.text() | st.text('"\\ a'))
def test_a_docstring_line_stays_inside_the_docstring(text: str) -> None:
    for docstring in (f'"""{PyDocLine.of(text)}"""\n', f'"""a\n{PyDocLine.of(text)}\n"""\n'):
        tree = ast.parse(docstring)
        assert len(tree.body) == 1
        assert isinstance(tree.body[0], ast.Expr)


@given(st.text())
def test_every_name_has_an_identifier(text: str) -> None:
    assert PyName(identifier(text)).text.isidentifier()
    assert PyName(class_name(text)).text.isidentifier()


@given(st.lists(st.text(), unique=True, max_size=20))
def test_names_stay_different(names: list[str]) -> None:
    table = NameTable({"place", "name"})
    given_names = [table.add(name, identifier(name)).text for name in names]
    assert len(set(given_names)) == len(names)
    assert not {"place", "name"} & set(given_names)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("lambda", "lambda_"),
        ("__class__", "x__class__"),
        ("foo/bar", "foo_bar"),
        ("2go", "x_2go"),
        ("ﬁeld", "field"),
        ("", "x"),
    ],
)
def test_identifiers(name: str, expected: str) -> None:
    assert identifier(name) == expected


def test_what_is_no_identifier_is_refused() -> None:
    for text in ("import os", "a b", "", "class", "x\n"):
        with pytest.raises(ValueError, match="identifier"):
            PyName(text)
