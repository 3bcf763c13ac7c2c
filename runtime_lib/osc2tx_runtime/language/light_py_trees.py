"""py_trees without the modules of its viewers and demos, which are loaded on first use.

`import py_trees` loads all of its modules, with pydot and multiprocessing: a fifth of the start of
a run, which uses five of them. Imported from here, each of the others is loaded when one of its
names is first used.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import LazyLoader
from types import ModuleType


class _Later:
    """Finder of py_trees modules that are loaded lazily."""

    @staticmethod
    def find_spec(
        name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not name.startswith("py_trees."):
            return None
        spec = PathFinder.find_spec(name, path, target)
        if spec is not None and spec.loader is not None:
            spec.loader = LazyLoader(spec.loader)
        return spec


if "py_trees" not in sys.modules:
    sys.meta_path.insert(0, _Later)
    try:
        import py_trees  # noqa: F401
    finally:
        sys.meta_path.remove(_Later)
