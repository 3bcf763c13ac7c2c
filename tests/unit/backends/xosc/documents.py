"""Files of scenarios and their documents, each made once however many tests look at it."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, lru_cache, partial
from pathlib import Path

from osc2tx import ir
from osc2tx.backends.py_trees import emitter as module_emitter
from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.grading import Source, graded, unplayed
from osc2tx.options import CompileOptions, XmlOptions
from tests.unit.backends.xosc.kept_runs import kept_runs

PLAIN = CompileOptions()


@cache
def compiled(path: Path, options: CompileOptions = PLAIN, name: str | None = None) -> Compilation:
    """Return the compilation of a file, by default under its own name."""
    return Compilation(path, name or path.name, options)


def module_of(compilation: Compilation) -> ir.Module:
    """Return what the scenarios of a file mean; there must not be an error in it."""
    assert compilation.ir is not None and compilation.keeps_rules, compilation.diagnostics
    return compilation.ir


@lru_cache(maxsize=4)
def generated(compilation: Compilation) -> GeneratedModule:
    """Return the Python module of a file."""
    return module_emitter.emit(module_of(compilation))


@cache
def documents(compilation: Compilation, options: XmlOptions) -> tuple[XmlScenario, ...]:
    """Return the documents of a file, exact ones also where approximations are allowed.

    None is played: what playing it would show is approximated.
    """
    if options.allow_approx:
        exact = documents(compilation, replace(options, allow_approx=False))
        if all(each.xml is not None for each in exact):
            return exact
    return unplayed_documents(module_of(compilation), options, compilation.path.parent)


def unplayed_documents(
    module: ir.Module, options: XmlOptions, folder: Path
) -> tuple[XmlScenario, ...]:
    """Return the documents of a program, none of which is played."""
    source = _source(module, CompileOptions(), options, folder, lambda: module_emitter.emit(module))
    found = unplayed(emit(module, options, folder), source, DiagnosticSink())
    for each in found:
        if each.xml is None and any(entry.is_open for entry in each.report.entries):
            each.report.leave_unmeasured("there is no document")
    return found


@cache
def graded_documents(compilation: Compilation, options: XmlOptions) -> tuple[XmlScenario, ...]:
    """Return the documents of a file as builds grade them; each keeps to its report."""
    module, folder, sink = module_of(compilation), compilation.path.parent, DiagnosticSink()
    generate = partial(generated, compilation)
    source = _source(module, compilation.options, options, folder, generate)
    with kept_runs():
        found = graded(emit(module, options, folder), source, sink)
    assert not sink.has_errors, sink.sorted()
    return found


def _source(
    module: ir.Module,
    options: CompileOptions,
    xml: XmlOptions,
    folder: Path,
    generate: Callable[[], GeneratedModule],
) -> Source:
    options = replace(options, xml=xml, target="all")
    return Source(module, options, folder, generate)
