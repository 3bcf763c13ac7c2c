"""The world of this package, which needs no simulator."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError
from osc2tx_runtime.world.drivers.drivers import DriversPlant
from osc2tx_runtime.world.drivers.driving import Driver
from osc2tx_runtime.world.embedded import EmbeddedWorld

from .world_type import Option, WorldRequest, WorldType, parse_pair

EXAMPLE = "hero=my_stack.drivers:Careful"


def parse_ego(text: str) -> tuple[str, str]:
    """Read `hero=package.module:Driver`."""
    actor, driver = parse_pair(text, "--ego", "ACTOR=PACKAGE.MODULE:CLASS", EXAMPLE)
    module, colon, name = driver.partition(":")
    if not (module and colon and name.isidentifier()):
        raise SettingsError(
            f"--ego {text}: write ACTOR=PACKAGE.MODULE:CLASS, as in --ego {EXAMPLE}"
        )
    return actor, driver


def make(request: WorldRequest) -> EmbeddedWorld:
    """Create the world on the map of the scenario.

    Raises:
        SettingsError: A driver cannot be created, or an actor has none.
    """
    egos: Mapping[str, str] = request.options.get("ego", {})
    for actor, control in request.control.items():
        if control == "external" and actor not in egos:
            raise SettingsError(
                f"--control {actor}=external: no driver for {actor or 'the others'}; name one:"
                f" --ego {actor or 'ACTOR'}=PACKAGE.MODULE:CLASS"
            )
        if control == "exact" and actor in egos:
            raise SettingsError(f"--control {actor}=exact contradicts --ego {actor}={egos[actor]}")
    plant = DriversPlant({actor: driver_of(actor, path) for actor, path in egos.items()})
    return EmbeddedWorld(request.road_map(), request.dt, plant if egos else None)


def driver_of(actor: str, path: str) -> Driver:
    """Create the driver of an actor.

    Raises:
        SettingsError: It cannot be created.
    """
    module, _, name = path.partition(":")
    try:
        with OwnCode("cannot be made:"):
            driver: Driver = getattr(import_module(module), name)()
            has_step = callable(getattr(driver, "step", None))
    except ScenarioError as error:
        is_missing = isinstance(error.__cause__, ModuleNotFoundError)
        advice = "; name its folder, PYTHONPATH=FOLDER, or install it" if is_missing else ""
        raise SettingsError(f"--ego {actor}={path}: {error.message}{advice}") from error
    if not has_step:
        raise SettingsError(f"--ego {actor}={path}: has no method step(observation, dt)")
    return driver


EMBEDDED = WorldType(
    "embedded",
    make,
    controls=("exact", "external"),
    options=(
        Option(
            "ego",
            "ACTOR=MODULE:CLASS",
            "Python class that drives an actor",
            parse_ego,
            dict,
            is_trusted=True,
        ),
    ),
)
