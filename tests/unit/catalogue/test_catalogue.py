"""The tables of the catalogue are what their three sources say."""

import runpy
from pathlib import Path

from osc2tx.catalogue import catalogue
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.declarations.library import shared_library
from osc2tx_runtime import modifiers as by_name
from osc2tx_runtime.domain.modifiers import MODIFIERS
from osc2tx_runtime.language.actions.registry import methods

REPOSITORY = Path(__file__).parents[3]
SCOPE = shared_library("2.2", "carla", "all").scope


def test_the_tables_are_fresh() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools" / "make_catalogue.py"))
    for path, text in tool["render"]().items():
        assert path.read_text(encoding="utf-8") == text, "run `python tools/make_catalogue.py`"


def test_every_declared_action_is_in_exactly_one_place() -> None:
    library = catalogue()
    declared = {
        symbol.qualified_name for symbol in SCOPE.declared if isinstance(symbol, sym.ActionSymbol)
    }
    undeclared = {f"{m.kind}.{m.name}" for m in methods.all() if m.undeclared}
    places = (*library.actions, *library.abstract, *library.lowered)
    assert sorted(places) == sorted(declared | undeclared)


def test_parameters_are_those_of_the_library() -> None:
    library = catalogue()
    for symbol in SCOPE.declared:
        if isinstance(symbol, sym.ActionSymbol) and symbol.qualified_name in library.actions:
            assert library.actions[symbol.qualified_name].arguments <= set(symbol.members)
    for name, entry in library.modifiers.items():
        for parameters in (entry.orders, entry.amounts, *(rule.of for rule in entry.rules)):
            assert set(parameters) <= entry.parameters, name


def test_what_the_catalogue_says_the_standard_says() -> None:
    """Some of each kind, read in the standard."""
    actions, modifiers = catalogue().actions, catalogue().modifiers
    assert actions["vehicle.drive"].section == "8.8.3.1"
    assert modifiers["speed"].section == "8.9.4"
    assert modifiers["start_lane"].owner == "map"
    ends = {name: entry.ends for name, entry in actions.items()}
    assert {ends[f"vehicle.{name}"] for name in ("drive", "follow_lane", "keep_time_gap")} == {
        "open"
    }
    assert ends["movable_object.remain_stationary"] == ends["person.walk"] == "open"
    assert ends["traffic_light_controller.play_cycles"] == "open"
    assert ends["environment.rain"] == ends["traffic_light_controller.set_state"] == "instant"
    assert ends["movable_object.change_speed"] == "goal"
    assert ends["vehicle.connect_trailer"] == ends["movable_object.assign_speed"] == "at_once"
    assert {name for name, entry in modifiers.items() if entry.bounds} == {
        *("along", "along_trajectory", "distance"),  # §8.9.11 to §8.9.13
        "change_lane",  # §8.9.15
    }


def test_modifiers_can_be_imported_by_their_names() -> None:
    assert {name: getattr(by_name, name) for name in MODIFIERS} == MODIFIERS
