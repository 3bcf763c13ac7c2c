"""The coverage model of a module: what its scenarios sample, and which buckets there are.

It is a file beside the module, for who counts hits of many runs; a run does not read it.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from osc2tx import ir

__all__ = ["FORMAT", "render_coverage_model"]

FORMAT = 1


def render_coverage_model(source: str, scenarios: Sequence[ir.Scenario]) -> str | None:
    """Return the model as JSON, a line for each item; None if nothing is sampled."""
    sampling = [scenario for scenario in scenarios if scenario.coverage]
    if not sampling:
        return None
    parts = []
    for scenario in sampling:
        items = ",\n".join(f"   {json.dumps(_item(each))}" for each in scenario.coverage)
        parts.append(f"  {json.dumps(scenario.name)}: [\n{items}\n  ]")
    body = ",\n".join(parts)
    head = f' "format": {FORMAT},\n "source": {json.dumps(source)},'
    return f'{{\n{head}\n "scenarios": {{\n{body}\n }}\n}}\n'


def _item(item: ir.Coverage) -> dict[str, Any]:
    """Return what an item says; keys that say nothing are left out."""
    event = item.event.value if isinstance(item.event, ir.Moment) else item.event.name
    said: dict[str, Any] = {"name": item.name, "kind": item.kind, "group": event}
    if item.items:
        said["items"] = list(item.items)
    if item.unit is not None:
        said["unit"] = item.unit.name
    if item.target is not None:
        said["target"] = item.target
    if item.text:
        said["text"] = item.text
    if item.graded:
        said["buckets"] = [_bucket(each) for each in item.graded]
    if item.impossible:
        said["impossible"] = [list(cell) for cell in item.impossible]
    return said


def _bucket(bucket: ir.Bucket) -> dict[str, Any]:
    if bucket.value is not None:
        return {"value": bucket.value}
    said: dict[str, Any] = {"low": bucket.low, "high": bucket.high}
    return {**said, "label": bucket.label} if bucket.label else said
