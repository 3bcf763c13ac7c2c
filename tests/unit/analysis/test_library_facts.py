"""The tables of facts agree with the library, and with the runtime."""

from osc2tx.analysis import library_facts as facts
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.library import shared_library
from osc2tx_runtime.language.registry import methods

CARLA = shared_library("2.2", "carla", "all").scope
NOT_DECLARED = {("animal", "walk")}


def declared_actions() -> set[tuple[str, str]]:
    return {
        (symbol.actor.name, symbol.name)
        for symbol in CARLA.declared
        if isinstance(symbol, sym.ActionSymbol) and symbol.actor is not None
    }


def test_actions_exist() -> None:
    listed = {*facts.OPEN_ENDED, *facts.INSTANT} - NOT_DECLARED
    assert listed <= declared_actions()
    names = {name for _, name in declared_actions()}
    assert {*facts.PLACING_ACTIONS, *facts.UNPACED_ACTIONS} <= names
    assert not set(facts.OPEN_ENDED) & set(facts.INSTANT)


def test_modifiers_and_their_parameters_exist() -> None:
    for name in {*facts.PLACING_MODIFIERS, *facts.PACING_MODIFIERS}:
        assert CARLA.modifiers_named(name), name
    for (name, parameter), amounts in facts.RELATIONS.items():
        (modifier,) = CARLA.modifiers_named(name)
        assert {parameter, *amounts} <= set(modifier.members)


def test_the_runtime_agrees() -> None:
    for method in methods.all():
        key = (method.kind, method.name)
        if key in declared_actions() | NOT_DECLARED:
            assert (method.ends == "open") == (key in facts.OPEN_ENDED), key
            assert method.ends != "instant" or key in facts.INSTANT, key
