"""Nodes of the behavior tree: py_trees behaviours with the meaning of the scenario language."""

from __future__ import annotations

from osc2tx_runtime.behaviour.base import Behaviour, Leaf, Node, Status
from osc2tx_runtime.behaviour.compositions import OneOf, Serial
from osc2tx_runtime.behaviour.conditions import Condition, elapsed, every, fall, rise
from osc2tx_runtime.behaviour.directives import Call, Emit, Until, Wait
from osc2tx_runtime.behaviour.ending import End, Fail
from osc2tx_runtime.behaviour.events import Event, Trigger
from osc2tx_runtime.behaviour.limits import Duration
from osc2tx_runtime.behaviour.on import On
from osc2tx_runtime.behaviour.parallel import Parallel

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
