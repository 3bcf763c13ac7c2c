"""What the compiler believes of the runtime library is so."""

import runpy
from pathlib import Path
from typing import get_args

import osc2tx_runtime
import osc2tx_runtime.domain.modifiers
import osc2tx_runtime.enums
import osc2tx_runtime.units
from osc2tx.backends.py_trees.naming import (
    EVENT_ATTRIBUTES,
    SCENARIO_ATTRIBUTES,
    class_name,
    identifier,
)
from osc2tx.backends.py_trees.runtime_api import ABSTRACT_TYPES, API_LEVEL
from osc2tx.catalogue import object_tables
from osc2tx.catalogue.constructors import (
    ACTOR_CLASSES,
    FLAT_MEMBERS,
    NESTED_OBJECTS,
    STRUCT_CLASSES,
)
from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.symbols import ActorSymbol, EnumSymbol, FieldSymbol, StructSymbol
from osc2tx.semantics.types import StructType
from osc2tx_runtime.domain.capabilities import objects

REPOSITORY = Path(__file__).parents[3]


def test_the_enums_are_fresh() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools" / "make_enums.py"))
    assert tool["TARGET"].read_text(encoding="utf-8") == tool["render"]()


def test_enums_have_the_members_of_the_library() -> None:
    for standard in ("2.1", "2.2"):
        scope = shared_library(standard, "asam", "all").scope
        symbols = [s for group in scope.types.values() for s in group if isinstance(s, EnumSymbol)]
        assert {class_name(symbol.name) for symbol in symbols} <= set(osc2tx_runtime.enums.__all__)
        for symbol in symbols:
            alias = getattr(osc2tx_runtime.enums, class_name(symbol.name))
            assert set(symbol.members) <= set(get_args(alias))


def test_level_and_classes_exist() -> None:
    assert osc2tx_runtime.API_LEVEL == API_LEVEL
    for name in (*ACTOR_CLASSES.values(), *STRUCT_CLASSES.values()):
        assert name in osc2tx_runtime.__all__
    assert {*ACTOR_CLASSES, *STRUCT_CLASSES} == set(objects()["objects"])


def test_types_without_a_class_are_known_with_what_is_above_them() -> None:
    scope = shared_library("2.2", "asam", "all").scope
    symbols = [each for group in scope.types.values() for each in group]
    classes = {**ACTOR_CLASSES, **STRUCT_CLASSES}
    above = {
        each.name: each.base.name
        for each in symbols
        if isinstance(each, ActorSymbol | StructSymbol) and each.name not in classes
        if each.base is not None
    }
    assert above == ABSTRACT_TYPES


def test_members_that_are_objects_are_so_in_the_library() -> None:
    for (owner, member), type_ in NESTED_OBJECTS.items():
        assert member in object_tables().objects[owner]
        assert type_ in STRUCT_CLASSES
        if (owner, member) != ("physical_object", "center"):  # of the box, which is flat
            assert library_struct(owner, member).name == type_


def test_flat_members_are_taken_apart_by_the_constructors() -> None:
    for owner, member in FLAT_MEMBERS:
        members = library_struct(owner, member).members.values()
        fields = {each.name for each in members if isinstance(each, FieldSymbol)}
        assert fields <= object_tables().objects[owner]


def library_struct(owner: str, member: str) -> StructSymbol:
    """The struct that a member of the library is."""
    (type_,) = shared_library("2.1", "asam", "all").scope.types[owner]
    assert isinstance(type_, ActorSymbol | StructSymbol)
    field = type_.members[member]
    assert isinstance(field, FieldSymbol) and isinstance(field.type, StructType)
    return field.type.symbol


def test_scenarios_do_not_hide_what_the_base_uses() -> None:
    base = osc2tx_runtime.Scenario
    public = {name for name in dir(base) if not name.startswith("_")}
    public |= {name for name in vars(base()) if not name.startswith("_")}
    assert public <= SCENARIO_ATTRIBUTES


def test_parameters_of_events_do_not_hide_what_the_base_uses() -> None:
    event = osc2tx_runtime.Event()
    assert {name for name in dir(event) if not name.startswith("_")} == EVENT_ATTRIBUTES


def test_every_unit_of_the_library_has_the_same_value_at_run_time() -> None:
    units = shared_library("2.1", "asam", "all").scope.units
    constants = {n for n, v in vars(osc2tx_runtime.units).items() if type(v) is not type}
    assert {identifier(name) for name in units} <= constants
    for name, unit in units.items():
        constant = getattr(osc2tx_runtime.units, identifier(name))
        si = constant(1.0) if callable(constant) else 1.0 * constant
        assert abs(si - (unit.factor + unit.offset)) <= 1e-12 * abs(si)
