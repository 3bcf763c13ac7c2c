"""Times that invoked scenarios draw share the durations around their invocations (§7.6.2.1.4)."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from osc2tx_runtime import RunSettings
from tests.unit.cli.shell import Shell
from tests.xosc.parity import FINE, Given, check, is_exact, scenarios

NESTED = """import osc.standard.all

namespace null use std, stdtypes

scenario inner:
    do serial:
        wait elapsed([1s..4s])
        wait elapsed([1s..4s])

scenario sub:
    do serial:
        inner()
        wait elapsed([1s..2s])

scenario top:
    event done
    do serial:
        sub(duration: 9s)
        emit done
"""


@pytest.fixture
def nested(shell: Shell) -> Path:
    return shell.write("nested.osc", NESTED)


def values(trace: Path) -> dict[str, float]:
    header = json.loads(trace.read_text(encoding="utf-8").splitlines()[0])
    return dict(header["parameters"])


def test_each_draw_fills_the_duration(nested: Path, shell: Shell) -> None:
    seen = set()
    for seed in range(10):
        ended = shell("run", "--seed", seed, "--trace", "trace.jsonl", nested)
        assert "top: success after 9.00 s" in ended.err + ended.out
        found = values(Path("trace.jsonl"))
        inner = [found["sub.inner.wait time"], found["sub.inner.wait time 2"]]
        assert all(3.0 <= time <= 4.0 for time in inner)
        assert sum(inner) + found["sub.wait time"] == pytest.approx(9.0)
        seen.add(inner[0])
    assert len(seen) == 10


def test_a_set_time_leaves_the_others_the_rest(nested: Path, shell: Shell) -> None:
    given = ("--set", "wait time of sub.inner=3.5s")
    shell("run", *given, "--trace", "trace.jsonl", nested)
    found = values(Path("trace.jsonl"))
    assert found["sub.inner.wait time"] == 3.5
    assert found["sub.inner.wait time 2"] + found["sub.wait time"] == pytest.approx(5.5)


def test_documents_have_the_same_times(nested: Path) -> None:
    given = Given(nested, RunSettings(dt=FINE))
    documents = scenarios(given)
    assert len(documents) == 3
    for document in documents:
        assert is_exact(document), document.report.obstacles
        check(given, document)
