"""What a campaign is: what the meaning of its rows depends on, as plain data for the store."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from osc2tx.campaigns.sampling import Sampler, Wanted
from osc2tx.version import __version__
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.campaigns import Condition, Executor, Plan, Row
from osc2tx_runtime.running.options import read_options
from osc2tx_shared.classes import replace

__all__ = ["identity_of", "plan_from", "plan_to"]

Texts = Mapping[str, Sequence[str]]
"""Options of a run as they are written, by name."""

NO_MATTER = ("map-path", "seed", "trace", "report")
"""Options that do not change what a row means, or stand in the identity otherwise."""


def identity_of(
    plan: Plan, texts: Texts, executor: Executor, sampler: Sampler, wanted: Wanted
) -> dict[str, Any]:
    """Return what makes a campaign another one, each item with a name that people know."""
    stated = {name: list(text) for name, text in sorted(texts.items()) if name not in NO_MATTER}
    return {
        "scenario": plan.scenario,
        "modules": _digest_of(plan.files),
        "map": _map_digest(executor),
        "osc2tx": __version__,
        "sampler": wanted.name.partition(":")[0],
        "seed": wanted.seed,
        "options": {name: text for name, text in stated.items() if text},
        "kpi": list(plan.measures),
        "fail-if": list(map(str, plan.fail_if)),
        "digests": plan.digests,
        **{f"sampler {name}": value for name, value in sampler.identity.items()},
    }


def _digest_of(files: Mapping[str, str]) -> str:
    modules = {name: text for name, text in sorted(files.items()) if name.endswith(".py")}
    return hashlib.sha256(json.dumps(modules).encode()).hexdigest()


def _map_digest(executor: Executor) -> str | None:
    """Return the digest of the road map; None if it is no file, as in a simulator."""
    try:
        return hashlib.sha256(executor.map_path(Row(0, 0)).read_bytes()).hexdigest()
    except ScenarioError:
        return None


def plan_to(plan: Plan, texts: Texts, folders: Sequence[Path]) -> dict[str, Any]:
    """Return a plan as plain data: a store repeats its rows without the source."""
    return {
        "files": dict(plan.files),
        "module": plan.module,
        "scenario": plan.scenario,
        "options": {name: list(text) for name, text in texts.items() if text},
        "map_path": list(map(str, folders)),
        "measures": list(plan.measures),
        "fail_if": list(map(str, plan.fail_if)),
        "digests": plan.digests,
    }


def plan_from(data: Mapping[str, Any]) -> Plan:
    """Return the plan that `plan_to` wrote.

    Raises:
        SettingsError: An option is not known any more.
    """
    texts = {name: text for name, text in data["options"].items() if name != "map-path"}
    settings = replace(read_options(texts), map_path=tuple(map(Path, data["map_path"])))
    return Plan(
        files=data["files"],
        module=data["module"],
        scenario=data["scenario"],
        settings=settings,
        measures=tuple(data["measures"]),
        fail_if=tuple(map(Condition.parse, data["fail_if"])),
        digests=data["digests"],
    )
