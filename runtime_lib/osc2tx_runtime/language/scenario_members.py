"""Names of declared members; checks of arguments and settings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.declared import BaseActor, DeclaredObject
from osc2tx_runtime.language.settings import check_known, near
from osc2tx_runtime.language.tree.events import Event

if TYPE_CHECKING:
    from osc2tx_runtime.language.scenario_parts import ScenarioParts


def name_members(scenario: ScenarioParts) -> None:
    """Set the names of actors, map objects and events, and register them."""
    place_of = scenario._source_map.of_field
    handed_in = {id(actor) for actor in scenario._arguments.values()}
    handed_in.update(id(actor) for actor in scenario._root.actors.values())
    shared = {id(value): name for name, value in scenario._shared_objects.items()}
    for attribute, value in vars(scenario).items():
        own = attribute  # unless an attribute cannot have the name of the scenario
        if isinstance(value, Event):
            own = value.name or own
        elif isinstance(value, BaseActor):
            own = scenario._roles.get(id(value), own)
        path = f"{scenario._path}.{own}" if scenario._path else own
        if isinstance(value, BaseActor) and id(value) not in handed_in:
            name = shared.get(id(value))
            if name is not None:  # as in the main scenario, if nothing hides it there
                path = name if _is_free(name, value, scenario) else f"::{name}"
            value.id = path
            value.source = place_of(attribute)
            scenario.actors[path if name else own] = scenario._root.actors[path] = value
        elif isinstance(value, DeclaredObject):
            value.source = place_of(attribute)
            scenario._root.map_objects.append(value)
        elif isinstance(value, Event):
            value.name = path
            scenario.events[own] = scenario._root.events[path] = value


def _is_free(name: str, actor: BaseActor, scenario: ScenarioParts) -> bool:
    return vars(scenario._root).get(name, actor) is actor and name not in scenario._root.actors


def check_arguments(scenario: ScenarioParts) -> None:
    """Reject arguments that are neither parameters nor actors of the scenario.

    Raises:
        TypeError: A program passes them.
        ScenarioError: An invocation passes them.
    """
    fixed = (name for name, narrowed in scenario._narrowed.items() if narrowed.is_fixed)
    known = (*scenario.parameters, *scenario._composite, *fixed)
    for name in scenario._arguments:
        if name not in known and not isinstance(vars(scenario).get(name), BaseActor):
            if scenario._caller is None:
                raise TypeError(f"{type(scenario).__name__}() has no parameter {name!r}")
            hint = near(name, known)
            raise ScenarioError(
                f"{scenario._path}: scenario {scenario.name} has no parameter {name}{hint}",
                scenario._caller.scenario.source,
            )


def check_settings(scenario: ScenarioParts) -> None:
    """Report settings with names that the scenario does not have."""
    settings = scenario.settings
    check_known("--set", "parameter", settings.set, scenario.parameters)
    check_known("--signal", "event", settings.signal, scenario.events)
    check_known("--spawn", "actor", settings.spawn, scenario.actors)
    check_known("--destination", "actor", settings.destination, scenario.actors)
