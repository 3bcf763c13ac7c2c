"""Traces are streams: what reads or writes one keeps no more of a long run than of a short one."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from osc2tx_runtime import RunSettings, Wait, elapsed, run_scenario
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.report.page import Trace
from osc2tx_runtime.report.tracks import MAX_SAMPLES
from osc2tx_runtime.running.output_files import OutputFile
from osc2tx_runtime.running.verification import read_trace
from tests.runtime.world.two_cars import scenario

DT = 0.05


def lines(steps: int) -> Iterator[str]:
    """The trace of a car that waits at each end of a road."""
    yield json.dumps({"kind": "header", "dt": DT, "scenario": "long"})
    for step in range(steps):
        place = {"x": 0.3 * (step % 1000), "y": 0.0, "h": 0.0, "v": 6.0, "road": "1", "lane": -1}
        yield json.dumps({"t": round(step * DT, 6), "kind": "state", "actor": "a", **place})
    yield json.dumps({"kind": "tree", "nodes": [{"kind": "wait", "text": "", "runs": []}]})


def peak(action: Callable[[], object]) -> int:
    """Return how many bytes are in use at most."""
    tracemalloc.start()
    try:
        action()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def verified(path: Path) -> int:
    return sum(1 for _ in read_trace(path).states)


def written(path: Path, steps: int) -> None:
    file = OutputFile("trace", path)
    for line in lines(steps):
        file.take([line])
    file.close()


@pytest.mark.slow
def test_memory_does_not_grow_with_the_length(tmp_path: Path) -> None:
    short, long = 9_000, 36_000
    for what, cost in {
        "write": lambda steps: peak(lambda: written(tmp_path / f"{steps}.jsonl", steps)),
        "verify": lambda steps: peak(lambda: verified(tmp_path / f"{steps}.jsonl")),
        "report": lambda steps: peak(lambda: Trace(lines(steps)).run.as_json()),
    }.items():
        cost(short)  # what is made once does not count
        assert cost(long) < 1.3 * cost(short) + 1e5, what
    assert verified(tmp_path / f"{long}.jsonl") == long


@pytest.mark.parametrize("steps", [1, 2, MAX_SAMPLES, 2 * MAX_SAMPLES + 2, 5 * MAX_SAMPLES])
def test_a_thinned_track_has_its_ends_and_is_even(steps: int) -> None:
    run = Trace(lines(steps)).run
    (track,) = run.tracks.values()
    kept = [round((sample["t"] or 0.0) / DT) for sample in track._kept()]
    assert (kept[0], kept[-1], len(kept)) == (0, steps - 1, min(steps, MAX_SAMPLES))
    gaps = {after - before for before, after in pairwise(kept)}
    assert not gaps or max(gaps) <= 2 * max(1, steps // MAX_SAMPLES) + 2
    assert kept == sorted(set(kept))


def test_the_digest_is_that_of_the_file(tmp_path: Path) -> None:
    from hashlib import sha256

    made, path = scenario(lambda cars: Wait(elapsed(0.5))), tmp_path / "run.jsonl"
    result = run_scenario(made, RunSettings(trace=path), keep_trace=False, digest=True)
    assert result.trace_lines == ()
    assert result.digest == sha256(path.read_bytes()).hexdigest()


def test_a_file_that_cannot_be_written_to_its_end_leaves_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "t.jsonl"
    path.write_text("old")
    file = OutputFile("trace", path)
    file.take(["new"])
    with pytest.raises(InputError, match="the trace cannot be written"):
        file.take(["\ud800"])  # no text of a file
    file.take(["more"])
    file.close()
    assert [each.name for each in tmp_path.iterdir()] == ["t.jsonl"]
    assert path.read_text() == "old"
