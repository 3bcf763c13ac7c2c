"""The identity of a campaign: all that the meaning of its rows depends on, as plain data."""

from __future__ import annotations

import ast
import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from osc2tx.campaigns.sampling import Sampler, Wanted
from osc2tx.campaigns.store import Store
from osc2tx.version import __version__
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.campaigns import Condition, Executor, Plan, Row
from osc2tx_runtime.running.options import read_options
from osc2tx_shared.classes import replace

Texts = Mapping[str, Sequence[str]]
"""Options of a run as they are written, by name."""

NO_MATTER = ("map-path", "seed", "trace", "report")
"""Options that do not change the meaning of a row, or are part of the identity otherwise."""


def identity_of(
    plan: Plan, texts: Texts, executor: Executor, sampler: Sampler, wanted: Wanted
) -> dict[str, Any]:
    """Return the identity of a campaign, each item with a readable name."""
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
    """Return a digest of modules without comments and docstrings, which change no row."""
    modules = {name: _code(text) for name, text in sorted(files.items()) if name.endswith(".py")}
    return hashlib.sha256(json.dumps(modules).encode()).hexdigest()


def _code(text: str) -> str:
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):  # loading it reports the reason
        return text
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(
            node
        ):
            node.body[0] = ast.Pass()
    return ast.unparse(tree)


def with_files_of(plan: Plan, store: Store) -> Plan:
    """Return a plan with the modules that the rows of a store were run with.

    They may differ in comments, and so in the lines that traces name.

    Raises:
        CampaignError: They are not the modules of the plan: the store is damaged.
    """
    stored = plan_of(store).files
    with store.as_written("the modules of the campaign"):
        if _digest_of(stored) != _digest_of(plan.files):
            raise ValueError("their digest is another one")
    return replace(plan, files=stored)


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


def plan_of(store: Store) -> Plan:
    """Return the plan that a store was begun with.

    Raises:
        CampaignError: Nothing was run yet, or the plan is damaged.
        SettingsError: An option is not known any more.
    """
    with store.as_written("the plan of the campaign"):
        return _plan_from(store.plan)


def _plan_from(data: Mapping[str, Any]) -> Plan:
    texts = {name: text for name, text in data["options"].items() if name != "map-path"}
    settings = replace(read_options(texts), map_path=tuple(map(Path, data["map_path"])))
    return Plan(
        files={str(name): str(text) for name, text in data["files"].items()},
        module=data["module"],
        scenario=data["scenario"],
        settings=settings,
        measures=tuple(data["measures"]),
        fail_if=tuple(map(Condition.parse, data["fail_if"])),
        digests=data["digests"],
    )
