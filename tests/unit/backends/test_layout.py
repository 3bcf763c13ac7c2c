"""Statements are laid out as black lays them out, whatever their layout was."""

import keyword
from collections.abc import Iterator

import black
from hypothesis import given
from hypothesis import strategies as st

from osc2tx.backends.py_trees.code import Level, PyComment, PyExpr, PyName, literal
from osc2tx.backends.py_trees.formatting import LINE_LENGTH, format_module
from osc2tx.backends.py_trees.layout import returned, statement
from osc2tx.backends.py_trees.view import ArgumentView, CallView, StatementView

MODE = black.Mode(line_length=LINE_LENGTH, target_versions={black.TargetVersion.PY311})
HEAD = "class A:\n    def f(self) -> None:\n"
COLUMN = 8

names = st.from_regex("[a-z]{1,30}", fullmatch=True)
names = names.filter(lambda name: not keyword.iskeyword(name))
dotted = st.lists(names, min_size=1, max_size=4).map(".".join)
sums = st.lists(dotted | st.just("-3.5 * kph"), min_size=1, max_size=4).map(" + ".join)
texts = st.text(max_size=30).map(literal).map(str)
conditions = st.builds("lambda: {} < {}".format, sums, sums)
others = st.sampled_from(
    ["a[1:2]", "b[:c + 1]", "f(a).b(c).d", "f(a, b=[c])", "{'a': 1}['a']", "(a, b)"]
)
expressions = st.one_of(dotted, sums, texts, conditions, others)
expressions = expressions.map(lambda text: PyExpr(text, Level.ATOM))
comments = st.lists(st.text(max_size=40).map(PyComment.of), max_size=2).map(tuple)
few = st.just(()) | st.just(()) | comments


def positional_first(arguments: list[ArgumentView]) -> tuple[ArgumentView, ...]:
    return tuple(sorted(arguments, key=lambda each: each.keyword is not None))


def calls(inner: st.SearchStrategy[ArgumentView]) -> st.SearchStrategy[ArgumentView]:
    given_ = st.lists(inner, max_size=4).map(positional_first)
    callees = dotted.map(lambda text: PyExpr(text, Level.ATOM))
    call = st.builds(CallView, callees, given_, st.booleans(), few)
    values = given_.filter(lambda each: all(one.keyword is None for one in each))
    listed = st.builds(CallView, st.none(), values, st.booleans(), few)
    return st.builds(ArgumentView, st.none(), call | listed, st.none() | names.map(PyName), few)


plain = st.builds(ArgumentView, expressions, st.none(), st.none() | names.map(PyName), few)
arguments = st.recursive(plain, calls, max_leaves=12)
values = arguments.map(lambda each: ArgumentView(each.code, each.call))
targets = dotted.map(lambda text: PyExpr(f"self.{text}", Level.ATOM))
statements = st.one_of(
    st.builds(StatementView, targets, values, comments),
    st.builds(StatementView, st.none(), values.filter(lambda each: each.call), comments),
)


def tokens(view: ArgumentView) -> Iterator[str]:
    """Write an argument with each name, comment and bracket on a line of its own."""
    yield from map(str, view.comments)
    call = view.call
    name = f"{view.keyword}=" if view.keyword else ""
    if call is None:
        yield f"{name}{view.code}"
        return
    yield f"{name}{call.callee}(" if call.callee else f"{name}["
    for index, each in enumerate(call.arguments, 1):
        yield from tokens(each)
        if call.exploded or index < len(call.arguments):
            yield ","
    yield from map(str, call.end_comments)
    yield ")" if call.callee else "]"


def by_black(start: str, view: ArgumentView) -> str:
    return black.format_str(HEAD + " " * COLUMN + start + "\n".join(tokens(view)), mode=MODE)


@given(statements)
def test_statements(view: StatementView) -> None:
    comments = list(map(str, view.comments))
    if len(comments) > 1 and not view.comments[-1].text:
        comments[-1] = ""
    above = "".join(f"{comment}\n{' ' * COLUMN}" for comment in comments)
    start = "" if view.target is None else f"{view.target} = "
    laid_out = format_module(f"{HEAD}{statement(view, COLUMN)}\n")
    assert laid_out == by_black(above + start, view.value)


@given(values)
def test_returned_values(view: ArgumentView) -> None:
    assert format_module(f"{HEAD}{returned(view, COLUMN)}\n") == by_black("return ", view)
