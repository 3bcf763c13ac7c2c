"""How the names of generated files end."""

from __future__ import annotations

MODULE = ".py"
SOURCE_MAP = ".map.json"
COVERAGE_MODEL = ".coverage.json"
XML = ".xosc"
PARAMETERS = ".params.xosc"
LOSS_REPORT = ".xosc.report.json"


def is_committed(name: str) -> bool:
    """Whether a file belongs into version control: source maps hold line numbers."""
    return not name.endswith(SOURCE_MAP)


def module_of(source_map: str) -> str:
    """Return the name of the module that a source map lies beside."""
    return source_map.removesuffix(SOURCE_MAP) + MODULE


def source_map_of(module: str) -> str:
    """Return the name of the source map of a module."""
    return module.removesuffix(MODULE) + SOURCE_MAP
