"""What the runtime imports: arrows between its floors only point downwards, without circles."""

import sys
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

RULES = RUNTIME.parent / "osc2tx_rules"
TEXT = RUNTIME.parent / "osc2tx_text"
CLASSES = RUNTIME.parent / "osc2tx_classes"
CACHE = RUNTIME.parent / "osc2tx_cache"
OTHERS = {"osc2tx_classes", "osc2tx_rules", "osc2tx_text", "py_trees"}
ONLY_IN = {
    "carla": "simulators/carla/client",
    "lxml": "opendrive",
    "numpy": "kpis",
    "osc2tx_cache": "opendrive",
}

LEAVES = {"clock", "enums", "errors"}
GROUND = {"opendrive", "world", "language"} | LEAVES

# Part of the runtime -> what else of it that imports, from the ground up. The floor of the domain
# model is told by its folders.
MAY_IMPORT: dict[str, set[str]] = {
    # leaves
    "clock": set(),
    "enums": set(),
    "errors": set(),
    "interrupts": set(),
    "plain_numbers": set(),
    "units": set(),
    # the map, the world on it, the language
    "opendrive": {"enums", "plain_numbers"},
    "world": {"clock", "enums", "errors", "opendrive"},
    "language": {"clock", "errors", "units", "world"},
    # the domain model
    "domain.points_and_poses": {"errors"},
    "domain.shapes": {"enums", "errors", "language", "world"},
    "domain.paths": {"domain.points_and_poses"} | GROUND - {"clock", "language"},
    "domain.routes": {"domain.paths", "domain.points_and_poses"} | GROUND - {"clock"},
    "domain.signals": {"domain.points_and_poses", "domain.routes"} | GROUND - {"clock"},
    "domain.measuring": {"domain.paths", "domain.points_and_poses", "domain.routes"}
    | GROUND - {"clock"},
    "domain.objects": {"domain.measuring", "domain.points_and_poses"}
    | GROUND - {"clock", "opendrive"},
    "domain.modifiers": {"domain.objects", "domain.paths", "domain.points_and_poses"}
    | {"domain.routes", "domain.shapes"}
    | GROUND - {"clock", "opendrive"},
    "domain.methods": {"domain.measuring", "domain.modifiers", "domain.objects", "domain.paths"}
    | {"domain.points_and_poses", "domain.routes", "domain.signals"}
    | GROUND - {"clock", "errors", "opendrive"},
    "domain.actors": {"domain.measuring", "domain.methods", "domain.objects", "domain.paths"}
    | {"domain.points_and_poses", "domain.routes", "domain.signals"}
    | GROUND - {"clock"},
    "domain.placing": {"domain.actors", "domain.modifiers", "domain.paths"}
    | {"domain.points_and_poses", "domain.routes", "domain.signals"}
    | GROUND - {"clock", "enums"},
    "domain.planning": {"domain.actors", "domain.modifiers", "domain.paths", "domain.placing"}
    | {"domain.points_and_poses", "domain.routes", "domain.shapes"}
    | GROUND - {"clock"},
    "domain.actions": {"domain.actors", "domain.measuring", "domain.modifiers", "domain.paths"}
    | {"domain.objects", "domain.placing", "domain.planning", "domain.points_and_poses"}
    | {"domain.routes", "domain.signals"}
    | GROUND - {"clock"},
    "domain.scenario": {"domain.actors", "domain.modifiers", "domain.routes"}
    | {"errors", "language"},
    "domain.capability_tables": {"domain.actors", "domain.measuring", "domain.objects"}
    | {
        "domain.paths",
        "domain.points_and_poses",
        "domain.routes",
        "domain.shapes",
        "domain.signals",
        "world",
    },
    "domain.capabilities": {"domain.actions", "domain.actors", "domain.capability_tables"}
    | {"domain.modifiers", "enums", "language", "units"},
    # what carries a scenario out, and what generated modules import
    "worlds": {"errors", "opendrive", "world"},
    "simulators": {"enums", "errors", "opendrive", "plain_numbers", "world", "worlds"},
    "report": {"language"},
    "running": {"domain.placing", "domain.routes", "domain.scenario", "report"}
    | {"errors", "interrupts", "language", "opendrive", "plain_numbers", "world", "worlds"},
    "kpis": {"errors", "language", "opendrive", "running", "world"},
    "campaigns": {"domain.routes", "domain.scenario", "errors", "kpis", "language", "opendrive"}
    | {"plain_numbers", "running"},
    "modifiers": {"domain.modifiers"},
    "": {"domain.actions", "domain.actors", "domain.measuring", "domain.modifiers"}
    | {
        "domain.objects",
        "domain.paths",
        "domain.points_and_poses",
        "domain.routes",
        "domain.scenario",
        "domain.shapes",
    }
    | {"domain.signals", "errors", "interrupts", "language", "running", "world"},
}

FILES = files_of(RUNTIME)
FOUND_EVERYWHERE = files_of(RULES) + files_of(TEXT) + files_of(CLASSES) + files_of(CACHE)


def part_of(module: str) -> str:
    """Return the part that a module belongs to; `""` for the package itself."""
    first, *rest = [*module.split(".")[1:], ""]
    return f"{first}.{rest[0]}".rstrip(".") if first == "domain" else first


def imports_by_part() -> dict[str, set[str]]:
    """Return which other parts each part imports."""
    found: dict[str, set[str]] = {}
    for module, imported in graph_of(RUNTIME).items():
        parts = {part_of(other) for other in imported} - {part_of(module)}
        found.setdefault(part_of(module), set()).update(parts)
    del found["domain"]  # the empty package
    return found


def test_the_table_is_what_the_parts_import() -> None:
    """Both ways: an entry that no import needs any more goes."""
    found = imports_by_part()
    assert set(found) == set(MAY_IMPORT)
    wrong = {
        (part, other): "is imported" if other in found[part] else "is not imported"
        for part, allowed in MAY_IMPORT.items()
        for other in allowed ^ found[part]
    }
    assert not wrong


def test_the_table_has_no_circle() -> None:
    assert not circles(MAY_IMPORT)


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


@pytest.mark.parametrize("path", FOUND_EVERYWHERE, ids=lambda path: path.name)
def test_what_the_compiler_shares_needs_nothing(path: Path) -> None:
    """It is imported for each check."""
    package = path.parent
    for name in imported_names(path, package):
        first = name.partition(".")[0]
        assert first in {package.name, "osc2tx_classes", *sys.stdlib_module_names}, name
