"""The plan of a parallel against the definition of the overlaps, by brute force and by runs."""

from __future__ import annotations

from itertools import product

from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.tree import Parallel
from osc2tx_runtime.language.tree.parallel_schedule import (
    FREE,
    SPANS,
    Overlap,
    Part,
    Span,
    Unplannable,
    make_schedule,
    spans_of,
)
from tests.runtime.tree.kit import Run
from tests.runtime.tree.test_overlap import STEP, timed

kinds = st.sampled_from(sorted(SPANS))
offsets = st.none() | st.tuples(st.integers(-3, 3), st.integers(0, 2)).map(
    lambda pair: Span(pair[0], pair[0] + pair[1])
)


def keeps(starts: list[int], ends: list[int], kind: Overlap, sts: Span, ete: Span) -> bool:
    """The table of language.md 9.2, word by word."""
    p, p_end = starts[0], ends[0]
    for j, j_end in zip(starts[1:], ends[1:], strict=True):
        rule = {
            "equal": j == p and j_end == p_end,
            "start": j == p,
            "end": j_end == p_end,
            "initial": j <= p <= j_end,
            "final": j <= p_end <= j_end,
            "inside": p <= j and p_end >= j_end,
            "full": p >= j and p_end <= j_end,
            "any": True,
        }[kind]
        if not (rule and sts.low <= j - p <= sts.high and ete.low <= j_end - p_end <= ete.high):
            return False
    return max(starts) <= min(ends)


@settings(max_examples=300)
@given(kinds, st.lists(st.integers(1, 5), min_size=2, max_size=3), offsets, offsets)
def test_known_lengths_are_scheduled_if_and_only_if_that_is_possible(
    kind: Overlap, lengths: list[int], start: Span | None, end: Span | None
) -> None:
    sts, ete = start or FREE, end or FREE
    possible = any(
        keeps(
            [0, *others],
            [a + n for a, n in zip([0, *others], lengths, strict=True)],
            kind,
            sts,
            ete,
        )
        for others in product(range(-6, 7), repeat=len(lengths) - 1)
    )
    try:
        parts = [Part(str(index), length) for index, length in enumerate(lengths)]
        plan = make_schedule(parts, *spans_of(kind, start, end))
    except Unplannable:
        assert not possible
        return
    starts = [begin for begin in plan.starts if begin is not None]
    ends = [begin + length for begin, length in zip(starts, lengths, strict=True)]
    assert keeps(starts, ends, kind, sts, ete)
    assert (min(starts), max(ends)) == (0, plan.length)


texts = st.sampled_from(["1", "2", "4", "?1", "?3", "?4", "open"])


@settings(max_examples=400)
@given(kinds, st.lists(texts, min_size=2, max_size=4), offsets, offsets)
def test_what_succeeds_has_kept_the_rule(
    kind: Overlap, lengths: list[str], start: Span | None, end: Span | None
) -> None:
    members = [timed("abcd"[index], text) for index, text in enumerate(lengths)]
    sts, ete = start or FREE, end or FREE
    tree = Parallel(
        "p",
        *members,
        overlap=kind,
        start_to_start=None if start is None else (start.low * STEP, start.high * STEP),
        end_to_end=None if end is None else (end.low * STEP, end.high * STEP),
    )
    try:
        run = Run(tree, max_time=2.0).go()
    except UnsupportedError:
        return
    if run.outcome.status == "success":
        starts, ends = [m.begun for m in members], [m.ended for m in members]
        assert keeps(starts, ends, kind, sts, ete)
        assert (min(starts), max(ends)) == (0, run.outcome.steps)
    elif run.outcome.status == "timeout":
        assert all(member.open_ended for member in members)
    else:  # only the run could tell
        assert any("?" in text for text in lengths)
