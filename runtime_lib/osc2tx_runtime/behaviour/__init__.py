"""Nodes of the behavior tree: py_trees behaviours with the meaning of the scenario language."""

from __future__ import annotations

from osc2tx_runtime.behaviour.base import Behaviour, Leaf, Node, Status
from osc2tx_runtime.behaviour.compositions import OneOf, Parallel, Serial
from osc2tx_runtime.behaviour.conditions import Condition, elapsed, every, fall, rise
from osc2tx_runtime.behaviour.directives import Call, Emit, On, Until, Wait
from osc2tx_runtime.behaviour.events import Event, Trigger
from osc2tx_runtime.behaviour.limits import Duration

__all__ = [
    "Behaviour",
    "Call",
    "Condition",
    "Duration",
    "Emit",
    "Event",
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
