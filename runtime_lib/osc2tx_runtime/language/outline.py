"""The nodes of a tree in the order of the scenario, with their descriptions."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.tree import Behaviour, OneOf, Parallel, Serial, Until, Wait
from osc2tx_runtime.language.tree.compositions import Composition
from osc2tx_runtime.language.tree.events import describe
from osc2tx_runtime.language.tree.late_invocation import LateInvocation
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class OutlineNode:
    """One node of a tree.

    Attributes:
        node: The node itself.
        last: For each level from the root, whether the branch ends there.
        kind: `serial`, `action`, `wait`, …
        text: Name of the node, or its activity.
        label: The label of an action or a directive, with which `text` begins; empty without one.
            The name of a composition is its text.
        source: Position in the scenario, `file:line`; empty if unknown.
    """

    node: Behaviour
    last: tuple[bool, ...]
    kind: str
    text: str
    label: str
    source: str

    def words(self) -> dict[str, int | str]:
        """Return the fields of the node in the trace: a label only if it has one."""
        words: dict[str, int | str] = {"depth": len(self.last), "kind": self.kind}
        words["text"] = self.text
        if self.label:
            words["label"] = self.label
        words["source"] = self.source
        return words


def outline(root: Behaviour) -> Iterator[OutlineNode]:
    """Yield every node from the top down, parents before their members."""
    pending: list[tuple[Behaviour, tuple[bool, ...]]] = [(root, ())]
    while pending:
        node, last = pending.pop()
        source = getattr(node, "source", "")
        yield OutlineNode(node, last, _kind(node), _text(node), _label(node), source)
        children = list(node.children)
        shown = [(child, (*last, child is children[-1])) for child in children]
        pending += reversed(shown)


_KINDS = (("serial", Serial, LateInvocation), ("parallel", Parallel), ("one_of", OneOf))


def _kind(node: Behaviour) -> str:
    for name, *kinds in _KINDS:
        if isinstance(node, tuple(kinds)):
            return name
    return "action" if isinstance(node, BaseAction) else type(node).__name__.lower()


def _label(node: Behaviour) -> str:
    """The label before it in the scenario, which `until` has taken over."""
    if isinstance(node, (Composition, Until)):
        return ""
    label, above = getattr(node, "label", None), node.parent
    while label is None and isinstance(above, Until):
        label, above = above.label, above.parent
    return label or ""


def _text(node: Behaviour) -> str:
    """The name, without the kind if it repeats it; a label with its activity."""
    kind, label = _kind(node), _label(node)
    if isinstance(node, BaseAction) and label:
        return f"{label}: {node.action_name}"
    if isinstance(node, Wait) and label:
        return f"{label}: {describe(node.trigger, node.condition)}"
    name = node.name.removeprefix(kind).lstrip(" ,")
    return "" if name == kind else name
