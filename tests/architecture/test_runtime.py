"""What the runtime imports: little of others, and nothing of the compiler."""

import sys
from pathlib import Path

import pytest

from tests.architecture.module_graph import REPOSITORY, RUNTIME, files_of, imported_names

RULES = RUNTIME.parent / "osc2tx_rules"
OTHERS = {"numpy", "osc2tx_rules", "py_trees"}


@pytest.mark.parametrize(
    "path", files_of(RUNTIME), ids=lambda path: path.relative_to(REPOSITORY).as_posix()
)
def test_packages_of_others(path: Path) -> None:
    allowed = OTHERS | ({"lxml"} if path.is_relative_to(RUNTIME / "opendrive") else set())
    for name in imported_names(path, RUNTIME):
        first = name.split(".")[0]
        if first != "osc2tx_runtime" and first not in sys.stdlib_module_names:
            assert first in allowed, f"the runtime imports {name}"


@pytest.mark.parametrize("path", files_of(RULES), ids=lambda path: path.name)
def test_the_rules_need_nothing(path: Path) -> None:
    """The compiler imports them too, for each check."""
    for name in imported_names(path, RULES):
        first = name.partition(".")[0]
        assert first == "osc2tx_rules" or first in sys.stdlib_module_names, name
