"""Imports generated modules, from files and from the texts just generated."""

from __future__ import annotations

import ast
import importlib.util
import linecache
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import lru_cache
from importlib.machinery import ModuleSpec
from pathlib import Path, PurePosixPath
from types import CodeType, ModuleType
from typing import TYPE_CHECKING, cast

from osc2tx.support.paths import COVERAGE_MODEL, SOURCE_MAP, real_path
from osc2tx_runtime import Scenario, ScenarioError

if TYPE_CHECKING:
    from importlib.abc import Loader

    from osc2tx.backends.py_trees.emitter import GeneratedModule


@contextmanager
def scenarios_of_module(
    module: GeneratedModule, siblings: Sequence[GeneratedModule] = ()
) -> Iterator[Mapping[str, type[Scenario]]]:
    """Give the scenario classes of a module that was just generated, by names in the source.

    Nothing is written: the modules are imported from their texts.

    Args:
        module: The module.
        siblings: All modules that it needs.

    Raises:
        ScenarioError: A value of a type cannot be computed.
    """
    texts = {_dotted(each): each for each in siblings}
    name = f"osc2tx:{_dotted(module)}"  # no other module has such a name
    loader = _TextLoader({**texts, name: module})
    with _own_modules(loader.names), ExitStack() as stack:
        sys.meta_path.insert(0, loader)
        stack.callback(sys.meta_path.remove, loader)
        stack.callback(loader.forget_lines)
        try:
            scenarios = _scenarios_in(importlib.import_module(name))
        except ArithmeticError as error:
            message = f"a value cannot be computed: {error}"
            raise ScenarioError(message, module.source) from error
        yield scenarios


def _dotted(module: GeneratedModule) -> str:
    """Return the name of a module from the folder of the outputs on."""
    return ".".join((*PurePosixPath(module.source).parts[:-1], module.stem))


class _TextLoader:
    """Finds and loads modules from given texts, with their packages.

    It has the methods of `importlib.abc`, which takes longer to import than a module to load.

    Attributes:
        names: Of all of them.
    """

    def __init__(self, modules: Mapping[str, GeneratedModule]) -> None:
        self._modules = modules
        packages = (name.split(".")[:-1] for name in modules)
        self._packages = {".".join(p[: i + 1]) for p in packages for i in range(len(p))}
        self.names = self._packages | modules.keys()

    def find_spec(
        self, fullname: str, path: object = None, target: object = None
    ) -> ModuleSpec | None:
        """Return how to load a module; a package is a namespace."""
        if fullname in self._packages:
            return ModuleSpec(fullname, None, is_package=True)
        if fullname not in self._modules:
            return None
        spec = ModuleSpec(fullname, cast("Loader", self), origin=self._place(fullname))
        spec.has_location = True
        return spec

    def get_source(self, fullname: str) -> str:
        """Return the text of a module, also for messages that quote a line."""
        return self._modules[fullname].python

    def create_module(self, spec: ModuleSpec) -> None:
        """Leave it to Python to create a module."""

    def exec_module(self, module: ModuleType) -> None:
        """Execute a module; those of libraries are compiled once for many scenarios."""
        name = module.__name__
        exec(_compiled(self.get_source(name), self._place(name)), module.__dict__)

    def get_data(self, path: str) -> bytes:
        """Return the source map of a module.

        Raises:
            OSError: There is no such file.
        """
        for name, module in self._modules.items():
            if Path(self._place(name)).with_suffix(SOURCE_MAP) == Path(path):
                return module.source_map.encode()
        raise FileNotFoundError(path)

    def forget_lines(self) -> None:
        """Drop the quoted lines of messages, which other modules may replace."""
        for name in self._modules:
            linecache.cache.pop(self._place(name), None)

    def _place(self, name: str) -> str:
        module = self._modules[name]
        return str(PurePosixPath("osc2tx:", module.source).with_name(f"{module.stem}.py"))


@lru_cache(maxsize=256)
def _compiled(text: str, place: str) -> CodeType:
    return compile(text, place, "exec", dont_inherit=True)


def module_files(
    module: GeneratedModule, siblings: Sequence[GeneratedModule] = ()
) -> tuple[dict[str, str], str]:
    """Return the files of a generated module, by path, and its own path.

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
    """Return the scenario classes of a written module, which is imported under a unique name.

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
    """Make the modules beside a module importable, as its script does."""
    files, folders = sibling_files(place)
    kept = {
        name
        for name in files.keys() & sys.modules.keys()
        if getattr(sys.modules[name], "__file__", None) == files[name]
    }
    path, writes_none = list(sys.path), sys.dont_write_bytecode
    with _own_modules(files.keys() - kept):
        sys.path[:0] = folders
        sys.dont_write_bytecode = True  # reading a folder leaves nothing in it
        importlib.invalidate_caches()
        try:
            yield
        finally:
            sys.path[:], sys.dont_write_bytecode = path, writes_none


@contextmanager
def _own_modules(names: Collection[str]) -> Iterator[None]:
    """Import modules for a while: others of their names are hidden, and none of them stays."""
    hidden = {name: sys.modules.pop(name) for name in names if name in sys.modules}
    try:
        yield
    finally:
        for name in names:
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
