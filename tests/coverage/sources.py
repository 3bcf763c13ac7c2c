"""The scenario files of this repository, compiled: what coverage is computed from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.roots import Roots
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx.options import CompileOptions
from osc2tx.syntax import ast

REPOSITORY = Path(__file__).parent.parent.parent
SCENARIOS = REPOSITORY / "scenarios"
CAPABILITIES = SCENARIOS / "capabilities"
GOLDENS = REPOSITORY / "tests" / "golden"


@dataclass(frozen=True)
class Source:
    """A compiled file.

    Attributes:
        path: Where it is.
        compilation: Its compilation, all stages done.
    """

    path: Path
    compilation: Compilation

    @property
    def place(self) -> str:
        """Its path in the repository."""
        return self.path.relative_to(REPOSITORY).as_posix()

    @property
    def builds(self) -> bool:
        """Whether it makes a module."""
        return self.compilation.module is not None

    @property
    def errors(self) -> tuple[str, ...]:
        """Codes of its errors, each once."""
        found = self.compilation.diagnostics
        return tuple(sorted({d.code for d in found if d.severity is Severity.ERROR}))


@cache
def scenarios() -> Sequence[Source]:
    """All of `scenarios/`, with the options of its settings file, in order of path."""
    configs = ConfigFiles()
    sources = []
    for path in sorted(SCENARIOS.rglob("*.osc")):
        options = configs.for_source(path).options_for(path, GivenOptions())
        sources.append(_compiled(path, options))
    return sources


@cache
def goldens() -> Sequence[Source]:
    """The inputs of the golden tests but those of the XML, those of whole modules first.

    What is DSL 2.2 or another dialect is told by name.
    """
    sources = []
    paths = [path for path in GOLDENS.rglob("input.osc") if GOLDENS / "xosc" not in path.parents]
    for path in sorted(paths, key=lambda p: (GOLDENS / "py_trees" not in p.parents, p)):
        name = path.parent.name
        standard = "2.2" if "2_2" in name or "newer_standard" in name else "2.1"
        dialect = "carla" if name.startswith("carla") else "asam"
        sources.append(_compiled(path, CompileOptions(standard, dialect)))
    return sources


def _compiled(path: Path, options: CompileOptions) -> Source:
    compilation = Compilation(path, path.name, options, roots=Roots((SCENARIOS,)))
    compilation.check()
    return Source(path, compilation)


def children(node: object) -> Iterator[object]:
    """What the attributes of an AST node hold, tuples taken apart."""
    for kind in type(node).__mro__:
        for name in getattr(kind, "__slots__", ()):
            value = getattr(node, name)
            yield from value if isinstance(value, tuple) else (value,)


def walk(node: ast.Node) -> Iterator[ast.Node]:
    """A node and all below it."""
    pending: list[object] = [node]
    while pending:
        current = pending.pop()
        if isinstance(current, ast.Node):
            yield current
            pending.extend(children(current))
