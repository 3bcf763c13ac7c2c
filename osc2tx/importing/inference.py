"""What the uses of parameters say about their dimensions."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.importing.dimensions import (
    ACCELERATION,
    LENGTH,
    NUMBER,
    OF_SCHEMA,
    SPEED,
    TIME,
    Dimension,
)
from osc2tx.importing.expressions import (
    Expression,
    Name,
    Number,
    Operation,
    Untyped,
    is_per_hour,
    parsed,
)
from osc2tx.xosc.element import Element
from osc2tx.xosc.schema import attributes_of

Vote = tuple[Dimension, bool]
"""A dimension, and whether the number counts kilometres per hour."""
Votes = dict[str, set[Vote]]
"""What the uses of parameters say, by their names."""


def uses_in(root: Element) -> list[tuple[Expression, Dimension]]:
    """Return the expressions of attributes that the schema gives a dimension."""
    given = [node for node in root.walk() if "$" in [text[:1] for _, text in node.attributes]]
    return [each for node in given for each in _uses_at(node)]


def _uses_at(node: Element) -> Iterator[tuple[Expression, Dimension]]:
    parts = attributes_of(node.tag) if not node.tag.startswith("Parameter") else {}
    for name, text in node.attributes:
        dimension = dimension_of(node, name) if text.startswith("$") and name in parts else None
        if dimension is None:
            continue
        try:
            yield parsed(text), dimension
        except Untyped:
            continue


def dimension_of(node: Element, name: str) -> Dimension | None:
    """Return the dimension of an attribute; `None` if the schema says none."""
    part = attributes_of(node.tag).get(name)
    if part is None or part.type != "Double":
        return None
    if node.tag.endswith("Dynamics") and name == "value":
        rate = ACCELERATION if node.tag == "SpeedActionDynamics" else SPEED
        by = {"time": TIME, "distance": LENGTH, "rate": rate}
        return by.get(node.get("dynamicsDimension") or "")
    if node.tag == "RelativeTargetSpeed":
        return SPEED if node.get("speedTargetValueType") != "factor" else NUMBER
    return OF_SCHEMA.get(part.unit) if part.unit else None


def vote(
    node: Expression,
    dimension: Dimension,
    is_hourly: bool,
    votes: Votes,
) -> None:
    """Note what an expression of a dimension says about its parameters."""
    if isinstance(node, Name):
        votes[node.name].add((dimension, is_hourly))
    elif isinstance(node, Operation):
        if dimension == SPEED and not is_hourly and is_per_hour(node):
            vote(node.left, dimension, True, votes)
        elif node.sign in "+-":
            vote(node.left, dimension, is_hourly, votes)
            vote(node.right, dimension, is_hourly, votes)
        else:
            _vote_in_product(node, dimension, is_hourly, votes)


def _vote_in_product(node: Operation, dimension: Dimension, is_hourly: bool, votes: Votes) -> None:
    """A number times something is of its dimension, unless that is a speed by itself.

    Of two factors the one whose dimension is known says that of the other one.
    """
    left, right = known(node.left, votes), known(node.right, votes)
    if left is None and right is not None:
        vote(node.left, dimension / right if node.sign == "*" else dimension * right, False, votes)
    elif right is None and left is not None:
        vote(node.right, dimension / left if node.sign == "*" else left / dimension, False, votes)
    for side, other in ((node.left, node.right), (node.right, node.left)):
        if is_per_hour(side):
            vote(side, SPEED, False, votes)
        elif isinstance(other, Number) and (node.sign == "*" or side is node.left):
            vote(side, dimension, is_hourly, votes)


def known(node: Expression, votes: Votes) -> Dimension | None:
    """Return the dimension that votes give an expression; `None`: none, or several."""
    if isinstance(node, Number):
        return None
    if isinstance(node, Name):
        found = votes.get(node.name, set())
        dimension, is_hourly = next(iter(found)) if len(found) == 1 else (None, False)
        return None if is_hourly else dimension
    if is_per_hour(node):
        return SPEED
    left, right = known(node.left, votes), known(node.right, votes)
    if node.sign in "+-":
        return right if left is None else left
    if isinstance(node.right, Number):
        return left
    if left is None or right is None:
        return right if isinstance(node.left, Number) and node.sign == "*" else None
    return left * right if node.sign == "*" else left / right
