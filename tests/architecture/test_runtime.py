"""What the runtime imports: arrows between its floors only point downwards, without circles."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.architecture.module_graph import (
    REPOSITORY,
    RUNTIME,
    circles,
    files_of,
    graph_of,
    imported_names,
)

SHARED = RUNTIME.parent / "osc2tx_shared"
OTHERS = {"osc2tx_shared", "py_trees"}
ONLY_IN = {
    "carla": "simulators/carla/client",
    "lxml": "opendrive",
    "numpy": "kpis",
}


def table(text: str) -> dict[str, set[str]]:
    """Return the sets of names after `name:`; indented lines continue the one above."""
    rows = (row.partition(":") for row in text.replace("\n    ", " ").strip().splitlines())
    return {name: set(imported.split()) for name, _, imported in rows}


# Part of the runtime -> what else of it that imports, from the ground up. The floor of the domain
# model is told by its folders.
MAY_IMPORT = table("""
clock:
enums:
errors:
interrupts:
plain_numbers:
units:
opendrive: enums errors plain_numbers
world: clock enums errors opendrive
language: clock errors units world
domain.points_and_poses: errors
domain.shapes: enums errors world
domain.map: domain.points_and_poses enums errors language opendrive world
domain.paths: domain.points_and_poses enums errors opendrive world
domain.routes: domain.map domain.paths domain.points_and_poses enums errors language opendrive
    world
domain.signals: domain.map domain.points_and_poses enums errors language opendrive world
domain.measuring: domain.map domain.paths domain.points_and_poses domain.routes enums errors
    language opendrive world
domain.objects: domain.measuring domain.points_and_poses enums errors language world
domain.modifiers: domain.map domain.objects domain.paths domain.points_and_poses domain.shapes
    enums errors language world
domain.methods: domain.map domain.measuring domain.modifiers domain.objects domain.paths
    domain.points_and_poses domain.signals enums language world
domain.actors: domain.map domain.measuring domain.methods domain.objects domain.paths
    domain.points_and_poses domain.routes domain.signals enums errors language opendrive world
domain.capability_tables: domain.actors domain.map domain.measuring domain.objects domain.paths
    domain.points_and_poses domain.shapes domain.signals world
domain.placing: domain.actors domain.map domain.modifiers domain.paths domain.points_and_poses
    domain.routes domain.signals enums errors language opendrive world
domain.scenario: domain.actors domain.map domain.modifiers domain.placing errors language
domain.planning: domain.actors domain.map domain.modifiers domain.objects domain.paths
    domain.placing domain.points_and_poses domain.routes domain.shapes enums errors language
    opendrive world
domain.actions: domain.actors domain.map domain.measuring domain.modifiers domain.objects
    domain.paths domain.placing domain.planning domain.points_and_poses domain.routes
    domain.signals enums errors language opendrive world
domain.monitoring: domain.actions domain.map domain.modifiers domain.paths domain.placing
    domain.routes enums errors language opendrive world
domain.capabilities: domain.actions domain.actors domain.capability_tables domain.modifiers enums
    language units
worlds: errors opendrive world
simulators: enums errors opendrive plain_numbers world worlds
report: language opendrive
running: domain.map domain.monitoring domain.objects domain.placing domain.scenario errors
    interrupts language opendrive plain_numbers report world worlds
kpis: errors language opendrive running world
campaigns: domain.map domain.monitoring domain.scenario errors kpis language opendrive
    plain_numbers running
fields: domain.actors domain.measuring domain.objects domain.signals enums
modifiers: domain.modifiers
__init__: domain.actions domain.actors domain.map domain.measuring domain.modifiers domain.objects
    domain.paths domain.points_and_poses domain.scenario domain.shapes domain.signals errors
    interrupts language running world
""")

# The same inside `world`: its folders and modules, from the ground up.
IN_WORLD = table("""
actor_dimensions:
surroundings:
state: actor_dimensions
geometry: actor_dimensions state
step_inputs: actor_dimensions state surroundings
commands: geometry
grip: actor_dimensions geometry state
measuring: actor_dimensions geometry state step_inputs
protocol: actor_dimensions commands geometry grip measuring state surroundings
checks: commands protocol
lateral: actor_dimensions commands geometry measuring protocol state step_inputs
longitudinal: actor_dimensions commands geometry measuring protocol state step_inputs surroundings
tracking: commands geometry lateral longitudinal measuring protocol state step_inputs
motion: actor_dimensions commands geometry grip lateral longitudinal measuring protocol state
    step_inputs tracking
plant: actor_dimensions checks geometry grip measuring motion protocol state surroundings tracking
drivers: actor_dimensions checks geometry grip measuring plant protocol state surroundings
embedded: actor_dimensions checks commands geometry grip longitudinal measuring motion plant
    protocol state step_inputs surroundings
recorded: embedded protocol state
""")

FILES = files_of(RUNTIME)


def part_of(module: str) -> str:
    """Return the part that a module belongs to."""
    first, *rest = [*module.split(".")[1:], "", ""]
    return f"{first}.{rest[0]}".rstrip(".") if first == "domain" else first or "__init__"


def part_of_world(module: str) -> str:
    """Return the folder or module of `world` that a module belongs to; `""` for any other."""
    part, *rest = [*module.split(".")[1:], "", ""]
    return rest[0] if part == "world" else ""


def imports_by_part(part: Callable[[str], str]) -> dict[str, set[str]]:
    """Return which other parts each part imports."""
    found: dict[str, set[str]] = {}
    for module, imported in graph_of(RUNTIME).items():
        found.setdefault(part(module), set()).update(map(part, imported))
    return {importer: parts - {importer} for importer, parts in found.items()}


def test_the_table_is_what_the_parts_import() -> None:
    """Both ways: an entry that no import needs any more goes."""
    found = imports_by_part(part_of)
    del found["domain"]  # the empty package
    assert found == MAY_IMPORT


def test_the_table_of_the_world_is_what_its_parts_import() -> None:
    found = imports_by_part(part_of_world)
    del found[""]
    assert {part: imported - {""} for part, imported in found.items()} == IN_WORLD


@pytest.mark.parametrize("table", [MAY_IMPORT, IN_WORLD], ids=["runtime", "world"])
def test_the_tables_have_no_circle(table: dict[str, set[str]]) -> None:
    assert not circles(table)


def test_no_circle_between_modules() -> None:
    assert not circles(graph_of(RUNTIME))


def test_packages_of_others() -> None:
    wrong = [
        f"{path.relative_to(REPOSITORY)} imports {name}"
        for path in FILES
        for name in sorted(packages_of(path) - {"osc2tx_runtime", *OTHERS, *allowed_in(path)})
    ]
    assert not wrong


def packages_of(path: Path) -> set[str]:
    """Return the packages that a module imports, besides the standard library."""
    names = {name.partition(".")[0] for name in imported_names(path, RUNTIME)}
    return names - sys.stdlib_module_names


def allowed_in(path: Path) -> set[str]:
    return {name for name, folder in ONLY_IN.items() if path.is_relative_to(RUNTIME / folder)}


@pytest.mark.parametrize("path", files_of(SHARED), ids=lambda path: path.stem)
def test_what_the_compiler_shares_needs_nothing(path: Path) -> None:
    """It is imported for each check."""
    for name in imported_names(path, SHARED):
        assert name.partition(".")[0] in {SHARED.name, *sys.stdlib_module_names}, name
