"""Which part of the compiler may import which: the table is exact, and there are no circles."""

import sys
from pathlib import Path

from tests.architecture.module_graph import (
    COMPILER,
    REPOSITORY,
    circles,
    files_of,
    graph_of,
    imported_names,
)

# Part of osc2tx -> what else of osc2tx it imports. `a.b` means that module and those below it.
MAY_IMPORT: dict[str, set[str]] = {
    # leaves
    "resources": set(),
    "support": set(),
    "version": set(),
    "diagnostics": {"support"},
    "options": set(),
    # stages, in the order in which they run
    "syntax": {"diagnostics", "support"},
    "stdlib": {"diagnostics", "syntax"},
    "catalogue": set(),
    "semantics": {
        "catalogue",
        "diagnostics",
        "stdlib",
        "support",
        "syntax.ast",
        "syntax.si_notation",
    },
    "analysis": {"catalogue", "diagnostics", "options", "semantics", "syntax.ast"},
    "ir": {"catalogue", "diagnostics"},
    "lowering": {"analysis", "catalogue", "ir", "semantics", "syntax.ast"}
    | {"diagnostics", "options"},
    "xosc": {"diagnostics", "options"},
    "importing": {"options", "stdlib", "xosc"},
    "rules": {"catalogue", "diagnostics", "ir"},
    "losses": {"diagnostics", "ir", "options", "xosc"},
    "backends": {"catalogue", "diagnostics", "ir", "losses", "options", "resources", "support"}
    | {"xosc"},
    # what runs them
    "module_loading": {"backends", "support"},
    "grading": {"backends", "catalogue", "diagnostics", "ir", "losses", "module_loading"}
    | {"options", "support", "xosc"},
    "formatter": {"diagnostics", "syntax"},
    "config": {"diagnostics", "options", "support"},
    "compilation": {"syntax", "semantics", "analysis", "ir", "lowering", "backends", "grading"}
    | {"diagnostics", "formatter", "options", "rules", "support"},
    "building": {"compilation", "config", "ir", "module_loading"}
    | {"diagnostics", "options", "resources", "support", "version"},
    "reference": {"catalogue", "stdlib", "syntax"},
    "campaigns": {"version"},
    "language_server": {"building", "catalogue", "compilation", "config", "diagnostics"}
    | {"reference", "semantics", "stdlib", "support", "syntax", "version"},
    "mcp_server": {"api", "building", "compilation", "config", "diagnostics", "importing"}
    | {"module_loading", "reference", "version"},
    "cli": {"building", "campaigns", "compilation", "config", "grading", "importing", "reference"}
    | {
        "language_server",
        "mcp_server",
        "diagnostics",
        "module_loading",
        "options",
        "resources",
        "support",
        "version",
    },
    "start": {"building", "cli"},
    "__main__": {"start"},
    "api": {"building", "compilation", "config", "diagnostics", "options", "support"},
    "testing": {"building", "cli", "compilation", "config", "diagnostics"}
    | {"campaigns", "module_loading", "support"},
    "": {"api", "diagnostics", "version"},
}

# Part or folder -> packages of others that it imports, besides the standard library and
# `osc2tx_shared`.
OTHERS = {
    "syntax": {"antlr4"},
    "semantics": {"pint"},
    "backends/py_trees": {"black", "jinja2"},
    "backends/xosc/facts": {"osc2tx_runtime"},  # sizes, courses and maps are the world's own
    "xosc/player": {"osc2tx_runtime"},  # the reader of maps alone
    "importing": {"osc2tx_runtime"},  # likewise
    "grading": {"osc2tx_runtime"},  # the runs that documents are compared with
    "module_loading": {"osc2tx_runtime"},  # the class of scenarios
    # rows are chosen here, run there
    "building": {"osc2tx_runtime"},  # runs are prepared as `run` does
    "campaigns": {"distributed", "optuna", "osc2tx_runtime", "scipy"},
    "cli": {"click", "osc2tx_runtime", "pytest", "rich"},
    "testing": {"osc2tx_runtime", "pytest"},
    "language_server": {"lsprotocol", "pygls"},
    "mcp_server": {"mcp", "osc2tx_runtime", "pydantic"},  # it runs and draws scenarios
}

FILES = files_of(COMPILER)


def part_of(path: Path) -> str:
    """Return the part that a module belongs to; `""` for the package itself."""
    first = path.relative_to(COMPILER).parts[0].removesuffix(".py")
    return "" if first == "__init__" else first


def part_and_folder(path: Path) -> tuple[str, str]:
    return part_of(path), path.relative_to(COMPILER).parent.as_posix()


def is_below(name: str, package: str) -> bool:
    return name == package or name.startswith(f"{package}.")


def imports_of(path: Path) -> tuple[set[str], set[str]]:
    """Return what a module imports of other parts of osc2tx, and the packages of others."""
    inside, outside = set(), set()
    for name in imported_names(path, COMPILER):
        first, _, rest = name.partition(".")
        if first == "osc2tx" and not is_below(rest, part_of(path)):
            inside.add(rest)
        elif first not in {"osc2tx", "osc2tx_shared", *sys.stdlib_module_names}:
            outside.add(first)
    return inside, outside


def test_imports_are_in_the_table() -> None:
    assert {part_of(path) for path in FILES} <= set(MAY_IMPORT)
    wrong = [
        f"{path.relative_to(REPOSITORY)} imports {name}"
        for path in FILES
        for name in sorted(imports_beyond_the_table(path))
    ]
    assert not wrong


def imports_beyond_the_table(path: Path) -> set[str]:
    inside, outside = imports_of(path)
    entries = MAY_IMPORT[part_of(path)]
    packages = {package for key in part_and_folder(path) for package in OTHERS.get(key, ())}
    return (outside - packages) | {
        name for name in inside if not any(is_below(name, entry) for entry in entries)
    }


def test_the_table_allows_nothing_that_is_not_used() -> None:
    """A row or an entry that no import needs any more goes."""
    inside: dict[str, set[str]] = {}
    outside: dict[str, set[str]] = {}
    for path in FILES:
        of_ours, of_others = imports_of(path)
        inside.setdefault(part_of(path), set()).update(of_ours)
        for key in part_and_folder(path):
            outside.setdefault(key, set()).update(of_others)
    needless = {
        (part, entry)
        for part, entries in MAY_IMPORT.items()
        for entry in entries
        if not any(is_below(name, entry) for name in inside.get(part, ()))
    }
    assert not needless
    assert set(MAY_IMPORT) == set(inside)
    assert not {key for key, packages in OTHERS.items() if not packages <= outside.get(key, set())}


def test_the_table_has_no_circle() -> None:
    parts = {
        part: {entry.split(".")[0] for entry in entries} for part, entries in MAY_IMPORT.items()
    }
    assert not circles(parts)


def test_no_circle_between_modules() -> None:
    assert not circles(graph_of(COMPILER))
