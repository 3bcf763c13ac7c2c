"""The modules of imported files, from which the module of a file may import.

Each imported file is compiled for itself, as a build compiles it. Its module can be imported if
there will be one: in the folder of the outputs, under a name that Python can import, made with the
same settings, and not itself in need of the module that is to import it.
"""

from __future__ import annotations

import keyword
from collections.abc import Callable, Iterator
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Protocol

from osc2tx.diagnostics import SourceFile
from osc2tx.options import CompileOptions
from osc2tx.support.paths import real_path
from osc2tx.support.python_modules import is_taken

if TYPE_CHECKING:
    from osc2tx.backends.py_trees.sharing import Declarations, Sharing, Sibling
    from osc2tx.ir import Module


class Alone(Protocol):
    """A file, compiled for itself."""

    path: Path
    options: CompileOptions

    @property
    def files(self) -> frozenset[Path]:
        """The files of its program, links followed."""

    @property
    def has_module(self) -> bool:
        """Whether it makes a module."""

    @property
    def declared(self) -> Declarations:
        """The declarations of its program."""

    @property
    def sharing(self) -> Sharing:
        """Where its module has the classes of other files from."""


def find_siblings(
    module: Module,
    own: Alone,
    alone: Callable[[SourceFile], Alone],
    is_source: Callable[[str], bool],
) -> tuple[dict[str, Sibling], dict[str, str]]:
    """Return the modules that the module of a file may import, and why it cannot import the others.

    Both by the names of their sources.

    Args:
        module: The IR of the file.
        own: The file.
        alone: Compiles an imported file separately.
        is_source: Whether the built folder has a file of a name.
    """
    from osc2tx.backends.py_trees.sharing import Sibling

    siblings: dict[str, Sibling] = {}
    apart: dict[str, str] = {}
    for source in _imported_sources(module):
        other, name = alone(source), _module_name(source.name)
        if name is None or any(map(is_source, _hiding(source.name))):
            apart[source.name] = "its module lies where this one cannot import it from"
        elif not _fits(other.options, own.options):
            apart[source.name] = "it has other settings"
        elif real_path(own.path) in other.files:
            apart[source.name] = "it imports this file as well"
        elif other.has_module:
            siblings[source.name] = Sibling(name, other.declared, other.sharing)
        else:
            apart[source.name] = "that file makes no module by itself"
    return siblings, apart


def _imported_sources(module: Module) -> Iterator[SourceFile]:
    """Yield the other files whose declarations a module consists of."""
    from osc2tx.backends.py_trees.own_names import declarations

    found = {part.span.source.name: part.span.source for part in declarations(module)}
    found.pop(module.source, None)
    return (source for _, source in sorted(found.items()))


def _module_name(source: str) -> str | None:
    """Return the name of the module of a source, from the folder of the outputs on."""
    from osc2tx.backends.py_trees.naming import module_name

    path = PurePosixPath(source)
    folders = path.parts[:-1]
    if not all(part.isidentifier() and not keyword.iskeyword(part) for part in folders):
        return None
    if folders and is_taken(folders[0]):
        return None
    return ".".join((*folders, module_name(source)))


def _hiding(source: str) -> Iterator[str]:
    """Yield the sources whose modules would hide a folder: Python finds `lib.py` before `lib/`."""
    folders = PurePosixPath(source).parents
    return (f"{folder}.osc" for folder in folders if folder.name)


def _fits(one: CompileOptions, other: CompileOptions) -> bool:
    """Return whether a module made with some options does in one made with others."""
    same = (one.standard, one.dialect, one.one_of) == (other.standard, other.dialect, other.one_of)
    return same and one.target != "xosc"
