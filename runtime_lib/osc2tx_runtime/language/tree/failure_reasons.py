"""Texts with the reasons why a tree failed or timed out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.language.tree.base import FAILURE, RUNNING, Behaviour, Node, place_key
from osc2tx_runtime.language.tree.ending import Ending

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

NAMED_LEAVES = 4  # greatest number of running leaves in the reason of a timeout


def failure_reason(root: Behaviour, context: ExecutionContext) -> str:
    """Return the text of a failure: node, position, time and reason."""
    texts = []
    for node in culprits(root):
        # The losers of a race failed before the race.
        at = getattr(node, "failed_at", None)
        time = context.time if at is None else at
        why = node.feedback_message or "no reason is given"
        texts.append(f"{named(node)} failed at {time:.3f} s: {why}")
    return "; ".join((*texts, *vain(root)))


def failure_place(root: Behaviour) -> str:
    """Return the source position of the first failure; empty without one."""
    first = culprits(root)[0]
    says_so = first.failed_by if isinstance(first, Ending) else None
    return getattr(first, "failure_source", "") or source_of(says_so or first)


def culprits(root: Behaviour) -> list[Behaviour]:
    """Return the nodes that cause a failure, in order."""
    return sorted(failing(root), key=place_key)


def vain(root: Behaviour) -> list[str]:
    """Return a hint for each node that waited for a change to a value that was already present."""
    nodes = [node for node in root.iterate() if isinstance(node, Node) and node.waits_in_vain()]
    nodes.sort(key=place_key)
    return [
        f"{named(node)} never occurred: its condition was true from the start, and only a change"
        " counts"
        for node in nodes
    ]


def failing(node: Behaviour) -> list[Behaviour]:
    """Return the nodes that cause a failure."""
    below = [child for child in node.children if child.status is FAILURE]
    if node.feedback_message or not below:
        return [node]
    return [culprit for child in below for culprit in failing(child)]


def timeout_reason(root: Behaviour, context: ExecutionContext) -> str:
    """Return the text of a timeout: the running leaves."""
    leaves = running_leaves(root)
    texts = [with_situation(named(leaf), leaf) for leaf in leaves[:NAMED_LEAVES]]
    if len(leaves) > NAMED_LEAVES:
        texts.append(f"and {len(leaves) - NAMED_LEAVES} more")
    running_now = ", ".join(texts) or "nothing"
    reason = f"not finished at {context.time:g} s; still running: {running_now}"
    return "; ".join((reason, *vain(root)))


def timeout_place(root: Behaviour) -> str:
    """Return the position of the first leaf that is still running; empty without one."""
    return next((source_of(leaf) for leaf in running_leaves(root)), "")


def running_leaves(root: Behaviour) -> list[Behaviour]:
    """Return the leaves that are still running, in order."""
    running = [node for node in root.iterate() if node.status is RUNNING and not node.children]
    leaves = [node for node in running if not getattr(node, "synthetic", False)]
    return sorted(leaves, key=place_key)


def with_situation(text: str, node: Behaviour) -> str:
    """Return a text about a running node with its situation."""
    situation = node.situation() if isinstance(node, Node) else ""
    return f"{text}, while {situation}" if situation else text


def source_of(node: Behaviour) -> str:
    """Return the source position of a node; other py_trees behaviours have none."""
    place = getattr(node, "source", "")
    return place if isinstance(place, str) else str(place)


def named(node: Behaviour) -> str:
    """Return the name of a node, with its source position if known."""
    source = source_of(node)
    return f"{node.name} ({source})" if source else node.name
