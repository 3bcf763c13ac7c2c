"""Selects among tests of scenarios: by values that they fix, and by shards for jobs of CI."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Any

import pytest

from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx_shared.text import complain

if TYPE_CHECKING:
    from osc2tx.testing.conditions import ValueCondition

_BEFORE_SHARDS = pytest.StashKey[int]()
"""How many tests there were to divide into shards."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options; called by pytest."""
    group = parser.getgroup("osc2tx")
    group.addoption(
        "--osc-where",
        action="append",
        default=[],
        metavar="'NAME == VALUE'",
        help="only scenarios that fix this value; repeated: all of them",
    )
    group.addoption("--osc-shard", metavar="K/N", help="only the K-th of N parts of all tests")


def pytest_configure(config: pytest.Config) -> None:
    """Read the options; called by pytest."""
    try:
        _conditions(config)
        _shard(config)
    except ValueError as error:
        raise pytest.UsageError(str(error)) from None


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Select by values and by shard, after `-k`; called by pytest."""
    conditions = _conditions(config)
    if conditions:
        _select(config, items, [item for item in items if _meets(item, conditions)])
    shard = _shard(config)
    if shard is not None:
        _keep_number(config, len(items))
        if is_worker(config):
            config.workeroutput["osc_before_shards"] = len(items)  # type: ignore[attr-defined]
        index, count = shard
        _select(config, items, items[index - 1 :: count])


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """Take what a process of pytest-xdist has counted; called by pytest-xdist."""
    output = getattr(node, "workeroutput", {})
    _keep_number(node.config, output.get("osc_before_shards", 0))


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Let a job pass whose shard is empty because there are more shards than tests; by pytest."""
    is_empty = session.exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED
    if is_empty and session.config.stash.get(_BEFORE_SHARDS, 0):
        session.exitstatus = pytest.ExitCode.OK
        complain("no scenario is in this shard")


def is_worker(config: pytest.Config) -> bool:
    """Whether this is a worker of pytest-xdist, whose tests another process selects."""
    return hasattr(config, "workerinput")


def report_unknown_names(config: pytest.Config, known: Collection[str]) -> None:
    """Report the conditions that no scenario fulfils, as none fixes a value of their name."""
    for condition in _conditions(config) if known else ():
        if condition.name not in known:
            meant = did_you_mean(condition.name, known)
            complain(f"no scenario fixes `{condition.name}`" + (f"; {meant}" if meant else ""))


def _conditions(config: pytest.Config) -> list[ValueCondition]:
    """Return the conditions on values.

    Raises:
        ValueError: One has another form.
    """
    texts = config.getoption("osc_where")
    if not texts:
        return []
    from osc2tx.testing.conditions import ValueCondition

    return [ValueCondition.parse(text) for text in texts]


def _shard(config: pytest.Config) -> tuple[int, int] | None:
    """Return which part of how many is to run.

    Raises:
        ValueError: It is none.
    """
    text = config.getoption("osc_shard")
    if text is None:
        return None
    index, sign, count = text.partition("/")
    if sign and index.isdecimal() and count.isdecimal() and 1 <= int(index) <= int(count):
        return int(index), int(count)
    raise ValueError(f"{text!r} is no shard: write K/N, as in 1/4")


def _meets(item: pytest.Item, conditions: Sequence[ValueCondition]) -> bool:
    if not hasattr(item, "entry"):  # a test of something else
        return True
    values = item.entry.values if item.entry is not None else {}
    return all(condition.holds(values) for condition in conditions)


def _keep_number(config: pytest.Config, number: int) -> None:
    config.stash[_BEFORE_SHARDS] = max(number, config.stash.get(_BEFORE_SHARDS, 0))


def _select(config: pytest.Config, items: list[pytest.Item], chosen: Sequence[pytest.Item]) -> None:
    kept = set(map(id, chosen))
    config.hook.pytest_deselected(items=[item for item in items if id(item) not in kept])
    items[:] = chosen
