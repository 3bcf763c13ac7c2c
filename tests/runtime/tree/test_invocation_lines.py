"""Nodes of an invoked scenario stand where its own file has them."""

from __future__ import annotations

import importlib.util
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

MODULE = """
from osc2tx_runtime.language.tree import Behaviour, Serial, Wait, elapsed
from osc2tx_runtime.domain.scenario import Scenario


class Inner(Scenario):
    name = "inner"
    source = "inner.osc"

    def behavior(self) -> Behaviour:
        return Serial("inner", Wait("pause", elapsed(0.1)))


class Outer(Scenario):
    name = "outer"
    source = "outer.osc"

    def behavior(self) -> Behaviour:
        return Serial("outer", self.invoke("first", Inner), Wait(elapsed(0.2)))
"""
MAP = {
    "version": 3,
    "scenarios": {
        "inner": {"nodes": [[2, 1], [3, 1]]},
        "outer": {"nodes": [[5, 1], [6, 1], [7, 1]]},
    },
}


@pytest.fixture
def outer(tmp_path: Path) -> Iterator[Any]:
    path = tmp_path / "nested_module.py"
    path.write_text(MODULE)
    path.with_suffix(".map.json").write_text(json.dumps(MAP))
    spec = importlib.util.spec_from_file_location("nested_module", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules["nested_module"] = module
    spec.loader.exec_module(module)
    yield module.Outer
    sys.modules.pop("nested_module", None)


def test_nodes_of_an_invoked_scenario_have_their_own_lines(outer: Any) -> None:
    tree = outer().create_tree()
    assert [(node.name, node.source) for node in reversed(list(tree.iterate()))] == [
        ("outer", "outer.osc:5"),
        ("wait elapsed 0.2 s", "outer.osc:7"),
        ("first", "outer.osc:6"),
        ("inner", "inner.osc:2"),
        ("pause", "inner.osc:3"),
    ]
