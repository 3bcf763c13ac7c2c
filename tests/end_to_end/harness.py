"""Compile, load and run scenarios as a user would, and look at the trace."""

import json
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from osc2tx import ir
from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.options import CompileOptions
from osc2tx.testing import Run
from osc2tx_runtime import RunSettings, Scenario, run_scenario
from tests.traces import whatever_the_order

REPOSITORY = Path(__file__).parent.parent.parent
SCENARIOS = REPOSITORY / "scenarios"


@dataclass(frozen=True)
class Trace(Run):
    """What we offer to tests of scenarios, and what only ours ask.

    Attributes:
        text: The trace as it is written to a file.
    """

    text: str

    @property
    def ordered(self) -> list[str]:
        """What does not depend on the order of the members of a `parallel`."""
        return whatever_the_order(self.text.splitlines())

    def action(self, source: str, status: str) -> float:
        """Return when the action of a source line has a status; it has it once."""
        (time,) = self.actions(source, status)
        return float(time)


@cache
def compilation_of(path: Path) -> Compilation:
    """Return the compilation of a scenario of the repository, with its settings, made once."""
    options = ConfigFiles().for_source(path).options_for(path, GivenOptions())
    return Compilation(path, path.name, options)


def compile_scenario(path: Path) -> ir.Module:
    compilation = compilation_of(path)
    assert compilation.ir is not None, compilation.diagnostics
    return compilation.ir


@cache
def generate(path: Path) -> GeneratedModule:
    """Return the module of a scenario of the repository."""
    return emit(compile_scenario(path))


def run(scenario: type[Scenario], settings: RunSettings | None = None) -> Trace:
    result = run_scenario(scenario, settings or RunSettings())
    text = "\n".join(result.trace_lines) + "\n"
    lines = tuple(json.loads(line) for line in result.trace_lines)
    return Trace(result.status, result.reason, result.time, lines, result.warnings, text)


def permuted(node: ir.Behavior) -> ir.Behavior:
    """Return the tree with the members of every `parallel` in reverse order."""
    if not isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
        return node
    members = tuple(permuted(member) for member in node.members)
    if isinstance(node, ir.Parallel):
        members = members[::-1]
    return replace(node, members=members)


def permuted_module(module: ir.Module) -> GeneratedModule:
    scenarios = tuple(replace(s, body=permuted(s.body)) for s in module.scenarios)
    return emit(replace(module, scenarios=scenarios))


def asam(text: str, folder: Path) -> ir.Module:
    """Compile a text in dialect `asam`."""
    path = folder / "case.osc"
    path.write_text(text, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert compilation.ir is not None, compilation.diagnostics
    return compilation.ir
