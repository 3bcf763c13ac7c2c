"""Nodes of the behavior tree: py_trees behaviours with the meaning of the scenario language."""

from __future__ import annotations

from osc2tx_runtime.language.tree.base import Behaviour, Leaf, Node, Status
from osc2tx_runtime.language.tree.compositions import Serial
from osc2tx_runtime.language.tree.conditions import Condition, elapsed, every, fall, rise
from osc2tx_runtime.language.tree.directives import Call, Emit, Until, Wait
from osc2tx_runtime.language.tree.duration_limits import Duration
from osc2tx_runtime.language.tree.ending import End, Fail
from osc2tx_runtime.language.tree.events import Event, Trigger
from osc2tx_runtime.language.tree.on import On
from osc2tx_runtime.language.tree.one_of import OneOf
from osc2tx_runtime.language.tree.parallel import Parallel

__all__ = [
    "Behaviour",
    "Call",
    "Condition",
    "Duration",
    "Emit",
    "End",
    "Event",
    "Fail",
    "Leaf",
    "Node",
    "On",
    "OneOf",
    "Parallel",
    "Serial",
    "Status",
    "Trigger",
    "Until",
    "Wait",
    "elapsed",
    "every",
    "fall",
    "rise",
]
