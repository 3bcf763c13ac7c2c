"""Imports generated modules from files."""

from __future__ import annotations

import ast
import importlib.util
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from osc2tx.support.paths import COVERAGE_MODEL, SOURCE_MAP, real_path
from osc2tx_runtime import Scenario, ScenarioError
from osc2tx_shared.own_folders import RUN, own_folder

if TYPE_CHECKING:
    from osc2tx.backends.py_trees.emitter import GeneratedModule


@contextmanager
def scenarios_of_module(
    module: GeneratedModule, siblings: Sequence[GeneratedModule] = ()
) -> Iterator[Mapping[str, type[Scenario]]]:
    """Give the scenario classes of a module that was just generated, by names in the source.

    Args:
        module: The module.
        siblings: All modules that it needs.

    Raises:
        ScenarioError: A value of a type cannot be computed.
    """
    files, main = module_files(module, siblings)
    with own_folder(RUN) as folder:
        for name, text in files.items():
            Path(folder, name).parent.mkdir(parents=True, exist_ok=True)
            Path(folder, name).write_text(text, encoding="utf-8")
        place = Path(folder, main)
        with ExitStack() as imported:
            try:
                scenarios = imported.enter_context(scenarios_of_file(place, Path(folder).name))
            except ArithmeticError as error:
                message = f"a value cannot be computed: {error}"
                raise ScenarioError(message, module.source) from error
            yield scenarios


def module_files(
    module: GeneratedModule, siblings: Sequence[GeneratedModule] = ()
) -> tuple[dict[str, str], str]:
    """Return the files of a module that was just generated, by path, and the path of its own.

    Args:
        module: The module.
        siblings: All modules that it needs.
    """
    files = {}
    for each in (*siblings, module):
        place = Path(each.source).with_name(f"{each.stem}.py")
        files[place.as_posix()] = each.python
        files[place.with_suffix(SOURCE_MAP).as_posix()] = each.source_map
        if each.coverage_model is not None:
            files[place.with_suffix(COVERAGE_MODEL).as_posix()] = each.coverage_model
    return files, place.as_posix()


@contextmanager
def scenarios_of_file(place: Path, name: str) -> Iterator[Mapping[str, type[Scenario]]]:
    """Give the scenario classes of a written module; it is imported under a name of its own.

    Raises:
        ImportError, SyntaxError, ValueError, OSError: If it cannot be imported.
    """
    spec = importlib.util.spec_from_file_location(name, place)
    assert spec is not None and spec.loader is not None, "every .py file has a loader"
    module = importlib.util.module_from_spec(spec)
    with _found_siblings(place):
        sys.modules[name] = module
        try:
            spec.loader.exec_module(module)
            yield _scenarios_in(module)
        finally:
            del sys.modules[name]


@contextmanager
def _found_siblings(place: Path) -> Iterator[None]:
    """Let a module find the modules beside it, as its script does.

    Other modules of the same names are hidden meanwhile, and imported modules are removed
    afterwards: each of several folders has modules of its own.
    """
    files, folders = sibling_files(place)
    path, writes_none = list(sys.path), sys.dont_write_bytecode
    hidden = {
        name: module
        for name, module in sys.modules.items()
        if name in files and getattr(module, "__file__", None) != files[name]
    }
    kept = files.keys() & (sys.modules.keys() - hidden.keys())
    for name in hidden:
        del sys.modules[name]
    sys.path[:0] = folders
    sys.dont_write_bytecode = True  # reading a folder leaves nothing in it
    importlib.invalidate_caches()
    try:
        yield
    finally:
        sys.path[:], sys.dont_write_bytecode = path, writes_none
        for name in files.keys() - kept:
            sys.modules.pop(name, None)
        sys.modules.update(hidden)


def sibling_files(place: Path) -> tuple[dict[str, str | None], list[str]]:
    """Return the modules that a module imports from around it, and their folders.

    Returns:
        Modules and packages with their files, and the folders for the path of the search.
    """
    found: dict[str, str | None] = {}
    folders = [str(place.parent)]
    pending = [real_path(place)]
    while pending:
        importing = pending.pop()
        tree = ast.parse(importing.read_bytes(), str(importing))
        statements = (each for each in tree.body if isinstance(each, ast.ImportFrom))
        for name in (each.module for each in statements if each.module and not each.level):
            root = _root_of(name, importing.parent)
            if root is not None and name not in found:
                folders += [str(root)] if str(root) not in folders else []
                found[name] = str(root / _file_of(name))
                pending.append(root / _file_of(name))
                packages = name.split(".")[:-1]
                found |= {".".join(packages[: i + 1]): None for i in range(len(packages))}
    return found, folders


def _root_of(name: str, folder: Path) -> Path | None:
    """Return the folder from which the name of a module counts: one that holds another module."""
    inner = _file_of(name)
    return next((root for root in (folder, *folder.parents) if (root / inner).is_file()), None)


def _file_of(name: str) -> Path:
    return Path(*name.split(".")).with_suffix(".py")


def _scenarios_in(module: ModuleType) -> dict[str, type[Scenario]]:
    return {
        value.name: value
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Scenario)
        and value.__module__ == module.__name__
        and not value.is_abstract()
    }
