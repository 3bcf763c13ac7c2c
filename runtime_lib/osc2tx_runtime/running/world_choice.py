"""The world of the settings: created for a run, or checked against the requirements of runs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
from osc2tx_runtime.errors import OwnCode, SettingsError, SimulatorError
from osc2tx_runtime.language.settings import RunSettings, check_known
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.worlds import CheckRequest, CheckResult, WorldRequest, find_world

if TYPE_CHECKING:
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.world.protocol import ActorSpec


def make_world(scenario: Scenario, read: Callable[[Path], RoadMap] = read_map) -> object:
    """Create the world of the settings, for the scenario's map.

    Raises:
        SimulatorError: It cannot be created.
    """
    settings = scenario.settings
    request = _request(scenario.map_file(), settings, read)
    found = find_world(settings.world)
    for actor, control in settings.control.items():
        if control not in found.controls:
            raise SettingsError(
                f"--control {control}: the world {found.name} has {' and '.join(found.controls)}"
            )
        if actor:
            check_known("--control", "actor", [actor], scenario.actors)
    with OwnCode(f"the world {settings.world} raised", error=SimulatorError):
        return found.make(request)


def check_world(
    scenario_class: Callable[[RunSettings], Scenario] | None,
    settings: RunSettings,
    *,
    drives: bool = False,
    fixes: bool = False,
) -> Iterator[CheckResult]:
    """Check the simulator of a world against the requirements of runs.

    Args:
        scenario_class: A generated class with requirements; None: those of all runs.
        settings: Of a run; they choose the world.
        drives: Whether actors may be spawned and moved.
        fixes: Whether remnants of other clients are removed.

    Raises:
        SettingsError: The world has no such check.
        SimulatorError: It cannot be inspected.
    """
    found = find_world(settings.world)
    if found.check is None:
        raise SettingsError(f"the world {found.name} has nothing to check")
    actors: tuple[ActorSpec, ...] = ()
    map_file = None
    if scenario_class is not None:
        scenario = scenario_class(settings)
        scenario.create_tree()
        map_file = scenario.map_file()
        objects = scenario.actors.values()
        actors = tuple(each.spec() for each in objects if isinstance(each, PhysicalObject))
    request = _request(map_file, settings, read_map)
    yield from found.check(CheckRequest(request, actors, drives, fixes))


def _request(
    map_file: str | None, settings: RunSettings, read: Callable[[Path], RoadMap]
) -> WorldRequest:
    """Return the request of a run to its world."""
    return WorldRequest(
        map_file,
        lambda: find_map(map_file, settings.map_path),
        settings.dt,
        settings.seed,
        settings.control,
        settings.world_options,
        read,
    )
