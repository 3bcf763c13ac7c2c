"""What the compiler believes of the runtime library is so."""

import runpy
from pathlib import Path

import osc2tx_runtime
import osc2tx_runtime.modifiers
import osc2tx_runtime.units
from osc2tx.backends.py_trees.naming import SCENARIO_ATTRIBUTES, identifier
from osc2tx.backends.py_trees.runtime_api import (
    ACTOR_CLASSES,
    API_LEVEL,
    CONSTRUCTOR_KEYWORDS,
    STRUCT_CLASSES,
    runtime_support,
)
from osc2tx.semantics.library import shared_library
from osc2tx_runtime.capabilities import capabilities

REPOSITORY = Path(__file__).parent.parent.parent.parent


def test_the_table_is_fresh() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools" / "make_runtime_api.py"))
    assert tool["TABLE"].read_text(encoding="utf-8") == tool["render"]()


def test_level_and_classes_exist() -> None:
    assert osc2tx_runtime.API_LEVEL == API_LEVEL
    for name in (*ACTOR_CLASSES.values(), *STRUCT_CLASSES.values()):
        assert name in osc2tx_runtime.__all__
    assert {*ACTOR_CLASSES, *STRUCT_CLASSES} == set(capabilities()["objects"])


def test_modifiers_can_be_imported_by_their_names() -> None:
    support = runtime_support()
    for name in {*support.modifiers, *support.placement}:
        assert hasattr(osc2tx_runtime.modifiers, identifier(name))


def test_constructor_keywords_exist() -> None:
    known = set().union(*runtime_support().objects.values())
    assert set(CONSTRUCTOR_KEYWORDS.values()) <= known


def test_scenarios_do_not_hide_what_the_base_uses() -> None:
    base = osc2tx_runtime.Scenario
    public = {name for name in dir(base) if not name.startswith("_")}
    public |= {name for name in vars(base()) if not name.startswith("_")}
    assert public <= SCENARIO_ATTRIBUTES


def test_every_unit_of_the_library_has_the_same_value_at_run_time() -> None:
    units = shared_library("2.1", "asam", "all").scope.units
    assert len(units) == 84
    for name, unit in units.items():
        constant = getattr(osc2tx_runtime.units, identifier(name))
        si = constant(1.0) if callable(constant) else 1.0 * constant
        assert abs(si - (unit.factor + unit.offset)) <= 1e-12 * abs(si)


def test_what_the_table_names_the_library_declares() -> None:
    scope = shared_library("2.1", "carla", "all").scope
    declared = {symbol.qualified_name for group in scope.behaviors.values() for symbol in group}
    assert set(runtime_support().actions) <= declared | {"animal.walk"}
