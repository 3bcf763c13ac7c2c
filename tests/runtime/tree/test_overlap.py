"""The eight overlaps of parallel and its offsets: when members start and end, in steps."""

from __future__ import annotations

from itertools import permutations
from typing import Any

import pytest

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.tree import Emit, Parallel, Serial, Status, Until, Wait, elapsed
from osc2tx_runtime.language.tree.base import Leaf
from tests.runtime.tree.kit import Drive, FakeActor, Run, event

STEP = 0.05
OPEN = None


class Timed(Leaf):
    """Takes some steps; says so before (`known`) or not; None steps: open-ended."""

    def __init__(self, name: str, steps: int | None, known: bool = True) -> None:
        super().__init__(name)
        self.steps, self.known, self.open_ended = steps, known, steps is None
        self.begun = self.ended = -1

    def length(self) -> int | None:
        return self.steps if self.known else None

    def initialise(self) -> None:
        assert self.begun < 0, "started twice"
        self.begun = self.context.step

    def update(self) -> Status:
        over = self.steps is not None and self.context.step - self.begun >= self.steps
        return Status.SUCCESS if over else Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        if new_status is Status.SUCCESS:
            self.ended = self.context.step


def timed(name: str, text: str) -> Timed:
    """Read `4` (known), `?4` (only the run tells), `open`."""
    if text == "open":
        return Timed(name, OPEN)
    return Timed(name, int(text.strip("?")), not text.startswith("?"))


def spans(lengths: str, **options: Any) -> str:
    """Run a parallel of such members and return `start-end` of each, or why it failed."""
    texts = []
    others = range(1, len(lengths.split()))
    for order in permutations(others):  # the secondaries in any order: the same
        members = [timed("abc"[i], text) for i, text in enumerate(lengths.split())]
        tree = Parallel("p", members[0], *(members[i] for i in order), **options)
        run = Run(tree, max_time=2.0).go()
        if run.outcome.status == "success":
            assert run.outcome.steps == max(member.ended for member in members)
            texts.append(" ".join(f"{m.begun}-{m.ended}" for m in members))
        else:
            texts.append(run.outcome.reason)
    assert len(set(texts)) == 1
    return texts[0]


@pytest.mark.parametrize(
    ("overlap", "lengths", "expected"),
    [
        # All lengths are known: the offsets nearest to zero that keep the rule.
        ("start", "4 2 6", "0-4 0-2 0-6"),
        ("equal", "4 4 open", "0-4 0-4 0-4"),
        ("end", "6 2 4", "0-6 4-6 2-6"),
        ("end", "2 6 4", "4-6 0-6 2-6"),
        ("initial", "4 2 6", "0-4 0-2 0-6"),
        ("final", "4 2 6", "0-4 2-4 0-6"),
        ("inside", "6 2 6", "0-6 0-2 0-6"),
        ("full", "2 4 6", "0-2 0-4 0-6"),
        ("any", "4 2 6", "0-4 0-2 0-6"),
        # Open-ended secondaries end with the last bounded member, as far as the rule allows.
        ("start", "4 open 6", "0-4 0-6 0-6"),
        ("end", "4 open 2", "0-4 0-4 2-4"),
        ("inside", "6 open 2", "0-6 0-6 0-2"),
        ("full", "4 open 6", "0-4 0-6 0-6"),
        ("final", "4 open 2", "0-4 0-4 2-4"),
        # An open-ended primary goes on as long as the rule allows and somebody needs.
        ("start", "open 2 6", "0-6 0-2 0-6"),
        ("equal", "open 4 4", "0-4 0-4 0-4"),
        ("end", "open 2 6", "0-6 4-6 0-6"),
        ("inside", "open 2 6", "0-6 0-2 0-6"),
        ("full", "open 2 6", "0-2 0-2 0-6"),
        ("final", "open 2 6", "0-6 4-6 0-6"),
        # Only the run tells the length of the primary: it drives.
        ("initial", "?4 2 6", "0-4 0-2 0-6"),
        ("final", "?4 2 3", "0-4 4-6 4-7"),
        ("final", "?4 open 3", "0-4 0-7 4-7"),
        ("inside", "?6 2 ?4", "0-6 0-2 0-4"),
        ("full", "?2 4 ?2", "0-2 0-4 0-2"),
        ("end", "?4 open open", "0-4 0-4 0-4"),
        ("equal", "?4 open ?4", "0-4 0-4 0-4"),
        # Only the run tells that of a secondary.
        ("final", "4 ?2 open", "0-4 4-6 0-6"),
        ("end", "open ?3 open", "0-3 0-3 0-3"),
        ("inside", "open ?3 ?5", "0-5 0-3 0-5"),
        ("full", "open ?3 ?5", "0-3 0-3 0-5"),
        ("any", "?3 ?5 open", "0-3 0-5 0-5"),
    ],
)
def test_overlaps(overlap: str, lengths: str, expected: str) -> None:
    assert spans(lengths, overlap=overlap) == expected


@pytest.mark.parametrize(
    ("options", "lengths", "expected"),
    [
        ({"overlap": "any", "start_to_start": 2 * STEP}, "4 4", "0-4 2-6"),
        ({"overlap": "any", "start_to_start": -2 * STEP}, "4 4", "2-6 0-4"),
        ({"overlap": "any", "start_to_start": (STEP, 3 * STEP)}, "4 open", "0-4 1-4"),
        ({"overlap": "any", "start_to_start": (-3 * STEP, -STEP)}, "4 6 4", "1-5 0-6 0-4"),
        ({"overlap": "any", "start_to_start": 2 * STEP}, "?4 ?4", "0-4 2-6"),
        ({"overlap": "any", "start_to_start": 2 * STEP}, "open 4", "0-6 2-6"),
        ({"start_to_start": 0}, "4 2", "0-4 0-2"),
        ({"end_to_end": 2 * STEP}, "4 open", "0-4 0-6"),
        ({"end_to_end": -STEP}, "4 open", "0-4 0-3"),
        ({"end_to_end": (STEP, 3 * STEP)}, "open 6", "0-5 0-6"),
        ({"end_to_end": 2 * STEP, "overlap": "any"}, "4 3", "0-4 3-6"),
        ({"end_to_end": -2 * STEP, "overlap": "inside"}, "6 2", "0-6 2-4"),
        ({"end_to_end": 2 * STEP, "overlap": "final"}, "?4 2", "0-4 4-6"),
        ({"start_to_start": STEP, "overlap": "inside"}, "4 2", "0-4 1-3"),
        ({"overlap": "any", "start_to_start": STEP, "end_to_end": STEP}, "4 4", "0-4 1-5"),
        ({"overlap": "end", "duration": 6 * STEP}, "open 2", "0-6 4-6"),
    ],
)
def test_offsets(options: Any, lengths: str, expected: str) -> None:
    assert spans(lengths, **options) == expected


@pytest.mark.parametrize(
    ("options", "lengths", "reason"),
    [
        ({"overlap": "equal"}, "?4 ?6", "0.200 s: overlap equal: b still runs when a has ended"),
        ({"overlap": "equal"}, "?6 ?4", "0.200 s: overlap equal: a still runs when b has ended"),
        ({"overlap": "inside"}, "?2 4", "0.100 s: overlap inside: b still runs when a has ended"),
        ({"overlap": "full"}, "?4 2", "0.100 s: overlap full: a still runs when b has ended"),
        (
            {"overlap": "any", "start_to_start": 4 * STEP},
            "?2 2",
            "overlap any: a has ended before b starts",
        ),
        ({"end_to_end": (0, STEP)}, "?2 ?5", "b still runs 0.05 s after the end of a"),
        ({"end_to_end": (2 * STEP, 9 * STEP)}, "?3 ?4", "overlap start: b ended 0.05 s after a"),
    ],
)
def test_what_only_the_run_can_tell_is_watched(options: Any, lengths: str, reason: str) -> None:
    found = spans(lengths, **options)
    assert found.startswith("p failed at ")
    assert reason in found


@pytest.mark.parametrize(
    ("options", "lengths", "problem"),
    [
        ({"overlap": "end"}, "?4 ?6", "overlap: end) cannot be scheduled: the length of a and b"),
        ({"overlap": "end"}, "4 ?6", "the length of b cannot be determined"),
        ({"overlap": "end"}, "?4 6", "the length of a cannot be determined"),
        ({"overlap": "equal"}, "4 6", "b does not fit the length of a"),
        ({"overlap": "inside"}, "4 6", "b does not fit the length of a"),
        ({"overlap": "full"}, "4 2", "b does not fit the length of a"),
        ({"overlap": "any", "start_to_start": 5 * STEP}, "4 2", "b does not fit the length of a"),
        (
            {"overlap": "any", "start_to_start": 5 * STEP},
            "4 open",
            "b would start after the end of the first member",
        ),
        ({"overlap": "any", "start_to_start": -5 * STEP}, "?4 2", "b would end before the start"),
        (
            {"overlap": "any", "start_to_start": STEP},
            "open open",
            "start_to_start: 0.05 s) cannot be scheduled: no member has a length",
        ),
        ({"start_to_start": STEP, "overlap": "start"}, "4 4", "start_to_start contradicts it"),
        (
            {"end_to_end": (STEP, 2 * STEP), "overlap": "inside"},
            "4 4",
            "end_to_end: 0.05 s to 0.1 s) cannot be scheduled: end_to_end contradicts it",
        ),
        ({"end_to_end": -STEP}, "?4 open", "the length of a cannot be determined"),
        ({"overlap": "any", "start_to_start": (-3 * STEP, -3 * STEP)}, "8 4 open", ""),
    ],
)
def test_what_cannot_be_scheduled_is_refused_before_the_run(
    options: Any, lengths: str, problem: str
) -> None:
    members = [timed("abc"[i], text) for i, text in enumerate(lengths.split())]
    tree = Parallel("p", *members, **options)
    tree.source = "x.osc:5"
    if not problem:
        Run(tree).go()
        return
    with pytest.raises(UnsupportedError) as caught:
        Run(tree).go()
    assert caught.value.source == "x.osc:5"
    assert problem in caught.value.message


def test_lengths_of_compositions_add_up() -> None:
    hero: Any = FakeActor("hero")
    npc: Any = FakeActor("npc")
    never = event("never")

    def ends() -> Any:
        return Until(Drive(hero), elapsed(0.3))

    cases: list[tuple[Any, int | None]] = [
        (Wait(elapsed(0.2)), 4),
        (Wait(never), None),
        (Drive(hero, duration=0.5), 10),
        (Until(Drive(hero, duration=(0.5, 1.0)), never), None),
        (Serial("s", Wait(elapsed(0.2)), ends()), 10),
        (Serial("s", Wait(never), duration=0.4), 8),
        (Serial("s", Wait(never), duration=(0.2, 0.4)), None),
        (Serial("s", Wait(elapsed(0.1)), duration=(0.0, 0.4)), 2),
        (Until(Wait(elapsed(0.1)), elapsed(0.1)), 2),
        (Until(Drive(hero), elapsed(0.3), never), None),
        (Parallel("p", Wait(elapsed(0.2)), ends(), Drive(npc)), 6),
        (
            Parallel(
                "p", Wait(elapsed(0.2)), Wait(elapsed(0.1)), overlap="any", start_to_start=0.15
            ),
            5,
        ),
        (Parallel("p", Wait(elapsed(0.2)), Wait(never)), None),
    ]
    for node, steps in cases:
        timed_member = Timed("last", 20)
        run = Run(Parallel("p", timed_member, node, overlap="any"), max_time=0.1).go()
        assert run.outcome.status == "timeout"
        assert node.length() == steps, node.name


def test_events_of_one_instant_count_as_one_instant() -> None:
    a = event("a")
    first = Serial("first", Wait(elapsed(0.2)), Emit(a))
    second = Serial("second", Wait(a), Emit(event("b")))
    assert Run(Parallel("p", first, second, overlap="equal")).go().outcome.status == "success"
    a = event("a")
    late = Serial("late", Wait(a), Wait(elapsed(0.05)))
    first = Serial("first", Wait(elapsed(0.2)), Emit(a))
    run = Run(Parallel("p", first, late, overlap="inside")).go()
    assert run.outcome.reason == (
        "p failed at 0.200 s: overlap inside: late still runs when first has ended"
    )
