"""What `asam` says about the names of a prelude, and what `carla` lets pass."""

from osc2tx.semantics.dialects import PRELUDE_BEHAVIORS, PRELUDE_MEMBERS, PRELUDE_PARAMETERS
from osc2tx.semantics.library import shared_library
from osc2tx.semantics.lookup import member_names
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    FieldSymbol,
    ModifierSymbol,
    TypeSymbol,
)
from tests.unit.semantics.support import build_text, codes

HEAD = "import osc.standard\n\n"


def prelude_names() -> tuple[set[str], set[tuple[str, str]], set[tuple[str, str]]]:
    members, parameters, behaviors = set(), set(), set()
    for symbol in shared_library("2.1", "carla", "all").scope.declared:
        if isinstance(symbol, ActionSymbol) and symbol.origin == "prelude":
            assert symbol.actor is not None
            behaviors.add((symbol.actor.name, symbol.name))
        if not isinstance(symbol, TypeSymbol):
            continue
        for member in symbol.members.values():
            if isinstance(member, FieldSymbol) and member.origin == "prelude":
                if isinstance(symbol, ModifierSymbol):
                    parameters.add((symbol.name, member.name))
                elif isinstance(symbol, ActorSymbol):
                    members.add(member.name)
    return members, parameters, behaviors


def standard_members() -> set[str]:
    scope = shared_library("2.1", "asam", "all").scope
    actors = [s for s in scope.declared if isinstance(s, ActorSymbol)]
    return {name for actor in actors for name in member_names(actor)}


def test_asam_knows_what_the_prelude_adds() -> None:
    members, parameters, behaviors = prelude_names()
    assert members - standard_members() <= set(PRELUDE_MEMBERS)
    assert parameters == set(PRELUDE_PARAMETERS)
    assert behaviors == set(PRELUDE_BEHAVIORS)


def test_relaxations_are_reported_once_per_file() -> None:
    text = HEAD + "scenario s:\n    a: speed = 3\n    b: length = 4\n    do wait elapsed(5)\n"
    assert codes(build_text(text, dialect="carla")[1]) == ["OSC605"]
    assert codes(build_text(text)[1]) == ["OSC303"] * 3


def test_carla_needs_no_import() -> None:
    text = "scenario s:\n    v: vehicle\n    do v.drive()\n"
    assert codes(build_text(text, dialect="carla")[1]) == []


def test_use_statement_is_understood_after_its_report() -> None:
    text = "import osc.standard.all\n\nuse std.stdtypes\n\nscenario s:\n    v: vehicle\n"
    assert codes(build_text(text)[1]) == ["OSC110"]
    assert codes(build_text(text, dialect="carla")[1]) == ["OSC601"]


def test_events_are_declared_by_their_first_use() -> None:
    text = HEAD + (
        "scenario s:\n    do serial:\n        wait @go\n        emit go\n        emit stop(3)\n"
    )
    model, sink = build_text(text, dialect="carla")
    assert codes(sink) == ["OSC603", "OSC603"]
    assert [n for n, m in model.scenarios[0].members.items() if getattr(m, "is_implicit", 0)] == [
        "go",
        "stop",
    ]
    assert codes(build_text(text)[1]) == ["OSC210", "OSC210"]
