"""The standard library against the tables of the standard, name by name."""

from dataclasses import fields

import pytest

from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.scope import Scope
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EnumSymbol,
    FieldSymbol,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    PhysicalTypeSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
)
from osc2tx.semantics.types import SI_BASES
from osc2tx.stdlib import EXTENSIONS
from osc2tx.syntax import ast
from tests.unit.stdlib.standard_tables import Compound, Method, Parameter, Tables, Unit, read_tables

# What the library has and the tables have not, with the reason.
FIELDS = {
    ("physical_object", "initial_bm"): "8.6 describes the field, the table of 8.7.3 forgets it",
    ("bm_engine", "name"): "8.6 leaves what is in it to the implementation",
}
SYNC = "set_bulb_state set_state set_semantic_state set_group_bulb_state set_group_state"
DEFAULTS = {
    ("hitch_receiver", "hitch_type"): ("none", "prose of 8.7.13"),
    ("geodetic_point", "altitude"): ("0m", "prose of 8.12.28: missing is 0"),
    ("traffic_light_stop_line", "secondary_stop_offset"): ("offset", "prose of 8.15.5.2"),
    ("traffic_light_stop_line", "secondary_stop_line_marking"): (
        "primary_stop_line_marking",
        "prose of 8.15.5.2",
    ),
    ("map.lane_side", "count"): ("1", "the examples leave it out"),
    ("map.compound_lane_side", "count"): ("1", "the examples leave it out"),
    ("map.crossing_connects", "start_angle"): ("90deg", "prose of 8.12.2.2.9"),
    ("string.substring", "end"): ("9223372036854775807", "optional: to the end of the text"),
    ("map.odr_to_route_point", "lane_id"): ('""', "optional, and a method needs a default"),
    ("map.create_odr_point", "lane_id"): ('""', "optional, and a method needs a default"),
    ("map.create_route", "connect_points_by"): ("waypoint", "prose of 8.12.2.1.6"),
    ("map.create_route", "legal_route"): ("true", "prose of 8.12.2.1.6"),
    **{
        (f"traffic_light_controller.{action}", "sync"): ("false", "the examples leave it out")
        for action in (*SYNC.split(), "set_group_semantic_state")
    },
}
# Units whose printed factor is further off than its nine digits allow, with the exact one.
EXACT = {
    **dict.fromkeys(("mmph", "millimeter_per_hour"), 1 / 3.6e6),
    **dict.fromkeys(("mph", "miph", "mile_per_hour", "miphps", "mile_per_hour_per_sec"), 0.44704),
}


@pytest.fixture(params=["2.1", "2.2"])
def standard(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def expected(standard: str) -> Tables:
    return read_tables(standard)


@pytest.fixture
def library(standard: str) -> Tables:
    """The loaded library in the form of the tables; tests print them, and a scope is endless."""
    return as_tables(shared_library(standard, "asam", "all").scope)


def is_of_the_standard(symbol: Symbol) -> bool:
    return symbol.span.source.name != f"<library>/{EXTENSIONS}"


def declared_by_the_standard(scope: Scope) -> list[Symbol]:
    """Return what the library declares, without the additions of osc2tx."""
    return list(filter(is_of_the_standard, scope.declared))


def as_tables(scope: Scope) -> Tables:
    tables = Tables()
    places = {
        StructSymbol: tables.structs,
        ActorSymbol: tables.actors,
        ActionSymbol: tables.actions,
        ModifierSymbol: tables.modifiers,
    }
    for symbol in declared_by_the_standard(scope):
        match symbol:
            case PhysicalTypeSymbol():
                powers = zip(SI_BASES, symbol.dimension.exponents, strict=True)
                tables.types[symbol.name] = {base: power for base, power in powers if power}
            case EnumSymbol():
                members = [(member.name, member.value) for member in symbol.members.values()]
                tables.enums[symbol.name] = members
            case TypeSymbol():
                name = qualified(symbol)
                place = places[type(symbol)]
                assert name not in place
                place[name] = as_compound(symbol)
    for owner in (*declared_by_the_standard(scope), *scope.primitives.values()):
        for member in owner.members.values() if isinstance(owner, TypeSymbol) else ():
            if isinstance(member, MethodSymbol):
                parameters = tuple(map(as_parameter, member.parameters))
                method = Method(parameters, str(member.result))
                tables.methods[f"{owner.name}.{member.name}"] = method
    for unit in filter(is_of_the_standard, scope.units.values()):
        tables.units[unit.name] = Unit(str(unit.type), unit.factor, unit.offset)
    return tables


def qualified(symbol: Symbol) -> str:
    return getattr(symbol, "qualified_name", symbol.name)


def as_compound(symbol: TypeSymbol) -> Compound:
    fields = [m for m in symbol.members.values() if isinstance(m, FieldSymbol) and m.node]
    base = symbol.target if isinstance(symbol, ModifierSymbol) else getattr(symbol, "base", None)
    return Compound(qualified(base) if base else None, tuple(map(as_parameter, fields)))


def as_parameter(symbol: FieldSymbol | ParameterSymbol) -> Parameter:
    default = None
    if symbol.default is not None:
        assert isinstance(symbol.default, ast.Node)
        default = symbol.default.span.text
    is_variable = isinstance(symbol, FieldSymbol) and symbol.is_variable
    return Parameter(symbol.name, str(symbol.type), default, is_variable)


def with_additions(name: str, compound: Compound, actual: Compound) -> Compound:
    """Return a compound of the tables with the deliberate additions of the library."""
    known = {field.name for field in compound.fields}
    fields = [with_default(name, field) for field in compound.fields]
    for place, field in enumerate(actual.fields):
        if field.name not in known and (name, field.name) in FIELDS:
            fields.insert(place, field)
    return Compound(compound.base, tuple(fields))


def with_default(name: str, parameter: Parameter) -> Parameter:
    default = parameter.default
    if (name, parameter.name) in DEFAULTS:
        assert default is None, f"the tables give {name}.{parameter.name} a default by now"
        default, _ = DEFAULTS[name, parameter.name]
    if parameter.type == "float" and default is not None:
        default = str(float(default))
    return Parameter(parameter.name, parameter.type, default, parameter.is_variable)


def test_every_table_of_the_page_is_read(expected: Tables) -> None:
    assert [part.name for part in fields(expected) if not getattr(expected, part.name)] == []


def test_physical_types(library: Tables, expected: Tables) -> None:
    assert library.types == expected.types


def test_units(library: Tables, expected: Tables) -> None:
    assert library.units.keys() == expected.units.keys()
    for name, printed in expected.units.items():
        unit = library.units[name]
        factor = EXACT.get(name, printed.factor)
        assert factor == pytest.approx(printed.factor, rel=1e-3)
        assert unit.type == printed.type, name
        assert unit.factor == pytest.approx(factor, rel=1e-6), name
        assert unit.offset == pytest.approx(printed.offset, rel=1e-6), name


def test_enums(library: Tables, expected: Tables) -> None:
    assert library.enums.keys() == expected.enums.keys()
    for name, members in expected.enums.items():
        assert library.enums[name] == members, name


@pytest.mark.parametrize("kind", ["structs", "actors", "actions", "modifiers"])
def test_compounds(library: Tables, expected: Tables, kind: str) -> None:
    found: dict[str, Compound] = getattr(library, kind)
    wanted: dict[str, Compound] = getattr(expected, kind)
    assert found.keys() == wanted.keys(), "additions of osc2tx belong into stdlib/extensions.osc"
    for name, compound in wanted.items():
        assert found[name] == with_additions(name, compound, found[name]), name


def test_methods(library: Tables, expected: Tables) -> None:
    assert library.methods.keys() == expected.methods.keys()
    for name, method in expected.methods.items():
        parameters = tuple(with_default(name, parameter) for parameter in method.parameters)
        assert library.methods[name] == Method(parameters, method.result), name


def test_namespaces(expected: Tables, standard: str) -> None:
    scope = shared_library(standard, "asam", "all").scope
    found = {(type(s).__name__, qualified(s)): s.namespace for s in declared_by_the_standard(scope)}
    extensions = {s.namespace for s in scope.declared} - {"std", "stdtypes"}
    del scope
    assert extensions <= {"osc2tx"}
    for (kind, name), namespace in found.items():
        is_basic = kind == "StructSymbol" and name in expected.basic
        wanted = is_basic or kind in ("PhysicalTypeSymbol", "UnitSymbol")
        assert namespace == ("stdtypes" if wanted else "std"), name


def test_additions_are_needed(library: Tables, standard: str) -> None:
    """Nothing stands in the tables of additions that the library does not have."""
    compounds = library.structs | library.actors | library.actions | library.modifiers
    found = {(name, f.name) for name, compound in compounds.items() for f in compound.fields}
    found |= {(name, p.name) for name, method in library.methods.items() for p in method.parameters}
    missing = (FIELDS.keys() | DEFAULTS.keys()) - found
    assert missing == ({("string.substring", "end")} if standard == "2.1" else set())
