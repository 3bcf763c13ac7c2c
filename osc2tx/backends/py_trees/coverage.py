"""Coverage items as calls of `cover` and `record`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from osc2tx import ir
from osc2tx.backends.py_trees.calls import CallWriter, code
from osc2tx.backends.py_trees.code import (
    Level,
    PyExpr,
    PyName,
    literal,
    name_expression,
    self_attribute,
)
from osc2tx.backends.py_trees.view import ArgumentView, CallView


class CoverageWriter:
    """Writes coverage items.

    Args:
        calls: Writer of the scenario's calls.
    """

    def __init__(self, calls: CallWriter) -> None:
        self._calls = calls

    def write(self, item: ir.Coverage) -> CallView:
        """Return the call that declares an item."""
        arguments = [code(literal(item.name))]
        writer = self._calls.expressions
        if item.expression is not None:
            arguments.append(code(writer.late(writer.write(item.expression))))
        else:
            arguments.append(code(_tuple(tuple(map(literal, item.items))), "items"))
        arguments += self._slices(item)
        if isinstance(item.event, ir.EventRef):
            arguments.append(code(writer.field(item.event.name), "at"))
        elif item.event is not ir.Moment.END:
            arguments.append(code(literal(item.event.value), "at"))
        for keyword, condition in (("ignore", item.ignore), ("illegal", item.illegal)):
            if condition is not None:
                body = writer.write(condition).within(Level.CONDITIONAL)
                arguments.append(code(PyExpr(f"lambda it: {body}", Level.LAMBDA), keyword))
        if item.target is not None:
            arguments.append(code(literal(item.target), "target"))
        if item.text:
            arguments.append(code(literal(item.text), "text"))
        return CallView(self_attribute(PyName(item.kind)), tuple(arguments))

    def _slices(self, item: ir.Coverage) -> list[ArgumentView]:
        arguments = []
        if item.unit is not None:
            arguments.append(code(written_unit(self._calls, item.unit), "unit"))
        if item.within is not None:
            arguments.append(code(_tuple(tuple(map(literal, item.within))), "within"))
        if item.every is not None:
            arguments.append(code(literal(item.every), "every"))
        if item.buckets:
            arguments.append(code(_tuple(tuple(map(literal, item.buckets))), "buckets"))
        return arguments


def written_unit(calls: CallWriter, unit: ir.Unit) -> PyExpr:
    """Write a unit: the runtime knows units of the library by name, others are objects.

    A factor cannot express an offset, so a unit with one is written by its numbers.
    """
    if unit.is_standard:
        return literal(unit.name)
    name = calls.use_name("Unit")
    if unit.offset:
        numbers = f"{literal(unit.factor)}, {literal(unit.offset)}"
        return PyExpr(f"{name}({literal(unit.name)}, {numbers})", Level.ATOM)
    factor = name_expression(calls.expressions.unit(unit))
    return PyExpr(f"{name}({literal(unit.name)}, {factor})", Level.ATOM)


def _tuple(parts: tuple[PyExpr, ...]) -> PyExpr:
    inner = ", ".join(str(part) for part in parts)
    return PyExpr(f"({inner},)" if len(parts) == 1 else f"({inner})", Level.ATOM)


FORMAT = 1


def render_coverage_model(source: str, scenarios: Sequence[ir.Scenario]) -> str | None:
    """Return the model as JSON, a line for each entry and bucket; None if nothing is sampled."""
    sampling = [scenario for scenario in scenarios if scenario.coverage]
    if not sampling:
        return None
    parts = []
    for scenario in sampling:
        items = ",\n".join(f"   {_written(_item(each))}" for each in scenario.coverage)
        parts.append(f"  {json.dumps(scenario.name)}: [\n{items}\n  ]")
    body = ",\n".join(parts)
    head = f' "format": {FORMAT},\n "source": {json.dumps(source)},'
    return f'{{\n{head}\n "scenarios": {{\n{body}\n }}\n}}\n'


def _written(entries: dict[str, Any]) -> str:
    """Return the entries of an item, a line for each, and for each bucket."""
    lines = []
    for key, value in entries.items():
        text = json.dumps(value)
        if key in ("buckets", "impossible"):
            rows = ",\n".join(f"     {json.dumps(each)}" for each in value)
            text = f"[\n{rows}\n    ]"
        lines.append(f"    {json.dumps(key)}: {text}")
    body = ",\n".join(lines)
    return f"{{\n{body}\n   }}"


def _item(item: ir.Coverage) -> dict[str, Any]:
    """Return the entries of an item; empty ones are left out."""
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
