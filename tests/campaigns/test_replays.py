"""Rows of stores are repeated to the byte."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from osc2tx.campaigns.engine import LocalEngine
from osc2tx.campaigns.replay import replay_row
from osc2tx.campaigns.store import Store
from osc2tx.testing.campaigns import plan_of
from osc2tx_shared.classes import replace
from tests.campaigns.kit import run
from tests.end_to_end.harness import SCENARIOS

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("sampler", ["random", "halton"])
def test_replays_of_fifty_rows_are_equal_to_the_byte(sampler: str, tmp_path: Path) -> None:
    """Here, after they were run by others: the digest is that of the text in the file."""
    plan, _ = plan_of(SCENARIOS / "cut_in.osc", None, (), (), {})
    run(replace(plan, digests=True), tmp_path / "store", sampler, 50, LocalEngine(2, 7))
    trace = tmp_path / "trace.jsonl"
    with Store(tmp_path / "store") as store:
        found = list(store.runs())
        assert len({each["digest"] for each in found}) == 50
        for each in found:
            replay_row(store, each["number"], trace, None)
            assert hashlib.sha256(trace.read_bytes()).hexdigest() == each["digest"]
