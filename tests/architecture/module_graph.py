"""Imports as the sources have them: also those for type checkers, and those inside functions."""

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

REPOSITORY = Path(__file__).parents[2]
COMPILER = REPOSITORY / "osc2tx"
RUNTIME = REPOSITORY / "runtime_lib" / "osc2tx_runtime"


def files_of(root: Path) -> list[Path]:
    """Return the modules of a package, generated parsers apart."""
    return sorted(path for path in root.rglob("*.py") if "_antlr" not in path.parts)


def module_name(path: Path, root: Path) -> str:
    """Return the full name of a module; a package has that of its folder."""
    parts = path.relative_to(root.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def imported_names(path: Path, root: Path) -> frozenset[str]:
    """Return what a module imports; of `from a import b` it is `a.b`."""
    return frozenset(_imported_names(path, root))


def _imported_names(path: Path, root: Path) -> Iterator[str]:
    package = path.parent.relative_to(root.parent).parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = ".".join([*above, *([node.module] if node.module else [])])
            yield from (f"{base}.{alias.name}" for alias in node.names)


def graph_of(root: Path) -> dict[str, set[str]]:
    """Return which modules of a package each of its modules imports."""
    paths = {module_name(path, root): path for path in files_of(root)}
    return {
        module: {_home(name, paths) for name in imported_names(path, root)} - {module, ""}
        for module, path in paths.items()
    }


def _home(name: str, modules: Mapping[str, Path]) -> str:
    """Return the module that an imported name is, or is in; `""` for one of another package."""
    above = name.rpartition(".")[0]
    return next((each for each in (name, above) if each in modules), "")


def circles(graph: Mapping[str, set[str]]) -> list[set[str]]:
    """Return the sets of modules that import each other, directly or through others."""
    reached = {module: _reached(graph, module) for module in graph}
    found: list[set[str]] = []
    for module in graph:
        if module in reached[module] and not any(module in circle for circle in found):
            found.append({other for other in reached[module] if module in reached[other]})
    return found


def _reached(graph: Mapping[str, set[str]], start: str) -> set[str]:
    """Return what a module imports, directly or through others."""
    found: set[str] = set()
    pending = list(graph[start])
    while pending:
        module = pending.pop()
        if module not in found:
            found.add(module)
            pending.extend(graph[module])
    return found
