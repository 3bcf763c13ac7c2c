"""Who may import whom: read from the sources, so that no import stays unseen."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
COMPILER = REPOSITORY / "osc2tx"
RUNTIME = REPOSITORY / "runtime_lib" / "osc2tx_runtime"
RULES = REPOSITORY / "runtime_lib" / "osc2tx_rules"

# Leaves that every stage may use; they import nothing of ours but `diagnostics` itself.
LEAVES = {"diagnostics", "options", "resources", "support"}

# Part of osc2tx -> what else of osc2tx it may import. `a.b` means that module and those below it.
MAY_IMPORT = {
    "support": {"support"},
    "diagnostics": {"diagnostics", "support"},
    "options": {"support"},
    "resources": set[str](),
    "syntax": {"syntax", "stdlib"} | LEAVES,
    "stdlib": {"", "stdlib", "syntax"} | LEAVES,
    "catalogue": {"catalogue", "support"},
    "semantics": {"semantics", "syntax.ast", "stdlib", "catalogue"} | LEAVES,
    "analysis": {"analysis", "semantics", "syntax.ast", "catalogue"} | LEAVES,
    "ir": {"ir", "diagnostics", "support"},
    "lowering": {"lowering", "ir", "analysis", "semantics", "syntax.ast", "catalogue"} | LEAVES,
    "backends": {"backends", "ir", "catalogue"} | LEAVES,
    "formatter": {"formatter", "syntax"} | LEAVES,
    # the shell around the stages
    "config": {"config", "options", "diagnostics.suggestions", "support"},
    "compilation": {"syntax", "semantics", "analysis", "lowering", "ir", "backends", "formatter"}
    | {"compilation"}
    | LEAVES,
    "building": {"", "building", "config", "compilation"} | LEAVES,
    "cli": {"", "backends", "building", "cli", "compilation", "config"} | LEAVES,
    "__main__": {"cli"},
    "api": {"building", "config", "compilation"} | LEAVES,
    "testing": {"building", "cli", "compilation", "config"} | LEAVES,
    "": {"api", "diagnostics"},
}

# Part or folder -> packages of others that it may import, besides the standard library.
OTHERS = {
    "syntax": {"antlr4"},
    # the rules of calls are one, and need neither the runtime nor anything else
    "catalogue": {"osc2tx_rules"},
    "semantics": {"pint", "osc2tx_rules"},
    "backends": {"jinja2", "black", "lxml", "osc2tx_rules"},
    "backends/xosc/facts": {"osc2tx_runtime"},  # sizes, courses and maps are the world's own
    "cli": {"click", "rich", "osc2tx_runtime"},
    "testing": {"pytest", "osc2tx_runtime"},
}
RUNTIME_OTHERS = {"numpy", "osc2tx_rules", "py_trees"}


def imported_names(path: Path, package: str) -> Iterator[str]:
    """Yield every module that a file imports; of `from a import b` both `a` and `a.b`."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                here = package.split(".")[: -(node.level - 1) or None]
                base = ".".join([*here, base]) if base else ".".join(here)
            yield from (f"{base}.{alias.name}" for alias in node.names)


def files_of(root: Path) -> list[Path]:
    return sorted(path for path in root.rglob("*.py") if "_antlr" not in path.parts)


def package_of(path: Path, root: Path) -> str:
    return ".".join(path.parent.relative_to(root.parent).parts)


def is_below(name: str, packages: set[str]) -> bool:
    return any(name == package or name.startswith(f"{package}.") for package in packages)


def part_of(path: Path) -> str:
    first = path.relative_to(COMPILER).parts[0].removesuffix(".py")
    return "" if first == "__init__" else first


def identify(path: Path) -> str:
    return path.relative_to(REPOSITORY).as_posix()


@pytest.mark.parametrize("path", files_of(COMPILER), ids=identify)
def test_compiler(path: Path) -> None:
    part = part_of(path)
    folder = path.relative_to(COMPILER).parent.as_posix()
    assert part in MAY_IMPORT, f"say in MAY_IMPORT what `{part}` may import"
    for name in imported_names(path, package_of(path, COMPILER)):
        first, _, rest = name.partition(".")
        if first == "osc2tx":
            is_own_name = "" in MAY_IMPORT[part] and rest.startswith("__")
            assert is_own_name or is_below(rest, MAY_IMPORT[part]), f"{part} imports {name}"
        elif first not in sys.stdlib_module_names:
            allowed = OTHERS.get(part, set()) | OTHERS.get(folder, set())
            assert first in allowed, f"{part} imports {name}"


@pytest.mark.parametrize("path", files_of(RULES), ids=identify)
def test_rules(path: Path) -> None:
    for name in imported_names(path, package_of(path, RULES)):
        first = name.partition(".")[0]
        assert first == "osc2tx_rules" or first in sys.stdlib_module_names, name


@pytest.mark.parametrize("path", files_of(RUNTIME), ids=identify)
def test_runtime(path: Path) -> None:
    allowed = set(RUNTIME_OTHERS)
    if path.is_relative_to(RUNTIME / "opendrive"):
        allowed.add("lxml")
    for name in imported_names(path, package_of(path, RUNTIME)):
        first = name.split(".")[0]
        if first != "osc2tx_runtime" and first not in sys.stdlib_module_names:
            assert first in allowed, f"the runtime imports {name}"


def test_the_table_has_no_row_too_many() -> None:
    parts = {part_of(path) for path in files_of(COMPILER)}
    assert set(MAY_IMPORT) <= parts
    folders = {path.relative_to(COMPILER).parent.as_posix() for path in files_of(COMPILER)}
    assert set(OTHERS) <= parts | folders
