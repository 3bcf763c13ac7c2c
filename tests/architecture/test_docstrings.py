"""What the docstring of a package says about its modules is true."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
ROOTS = (REPOSITORY / "osc2tx", REPOSITORY / "runtime_lib" / "osc2tx_runtime")
PACKAGES = sorted(
    path for root in ROOTS for path in root.rglob("__init__.py") if "_antlr" not in path.parts
)
# A plain word in backticks that looks like a module: lower case, perhaps with dots or `_`.
WORD = re.compile(r"`([a-z_][a-z0-9_]*(?:\.[a-z0-9_]+)*)`")


@cache
def module_names() -> frozenset[str]:
    """Return the names of all modules, each with all its ends."""
    names = set()
    for root in ROOTS:
        for path in root.rglob("*.py"):
            parts = path.relative_to(root.parent).with_suffix("").parts
            parts = parts[:-1] if parts[-1] == "__init__" else parts
            names |= {".".join(parts[start:]) for start in range(len(parts))}
    return frozenset(names)


def known_names(init: Path) -> set[str]:
    """Return the names of all modules, and of what lies in the folder of a package."""
    return module_names() | {path.name for path in init.parent.iterdir()}


@cache
def names_in(path: Path) -> frozenset[str]:
    """Return the functions, methods, classes and attributes that a module defines."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.alias):
            names.add(node.asname or node.name)
        elif isinstance(node, ast.arg):
            names.add(node.arg)
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            names.add(node.target.id)
    return frozenset(names)


def undefined(names: set[str], init: Path) -> set[str]:
    """Return those names that no module of a package defines; few modules have to be parsed."""
    left = set(names)
    for path in init.parent.rglob("*.py") if left else ():
        text = path.read_text(encoding="utf-8")
        if any(name in text for name in left):
            left -= names_in(path)
    return left


def names_member(name: str, modules: set[str]) -> bool:
    """Return whether a dotted name is that of something in a module."""
    module, dot, _ = name.rpartition(".")
    return bool(dot) and module in modules


# Words in backticks that are no Python names: keywords and names of the language.
LANGUAGE = {"keep", "do", "wait", "emit", "use", "with", "on", "until", "serial", "parallel"}
LANGUAGE |= {"one_of", "it", "start", "carla", "asam", "null"}


@pytest.mark.parametrize("init", PACKAGES, ids=lambda p: p.relative_to(REPOSITORY).as_posix())
def test_package(init: Path) -> None:
    docstring = ast.get_docstring(ast.parse(init.read_text(encoding="utf-8")))
    assert docstring, "a package says what it is for"
    named = set(WORD.findall(docstring)) - LANGUAGE
    modules = known_names(init)
    left = {name for name in named - modules if not names_member(name, modules)}
    unknown = undefined(left, init)
    assert not unknown, f"the docstring names what does not exist: {sorted(unknown)}"
