"""The nodes of the `tree` line, as the page reads them."""

from __future__ import annotations

from .json_values import Json, number, short, text

__all__ = ["node_list"]


def node_list(value: object) -> list[Json]:
    """Return the nodes with what can be drawn of them; what is no node is left out."""
    nodes = value if isinstance(value, list) else []
    return [_node(each) for each in nodes if isinstance(each, dict)]


def _node(value: Json) -> Json:
    words = {key: text(value.get(key)) for key in ("kind", "text", "label", "source")}
    runs = value.get("runs")
    spans = [_span(run) for run in runs if _is_span(run)] if isinstance(runs, list) else []
    return {"depth": int(number(value.get("depth")) or 0), **words, "runs": spans}


def _is_span(run: object) -> bool:
    return isinstance(run, list) and len(run) == 3 and number(run[0]) is not None


def _span(run: list[object]) -> list[object]:
    """Start (s), end (s, None while it runs), and how it was left."""
    start, end = number(run[0]), number(run[1])
    return [short(start or 0.0, 4), None if end is None else short(end, 4), text(run[2])]
