"""Files of scenarios and their documents, each made once however many tests look at it."""

from dataclasses import replace
from functools import cache
from pathlib import Path

from osc2tx import ir
from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, XmlOptions

PLAIN = CompileOptions()


@cache
def compiled(path: Path, options: CompileOptions = PLAIN, name: str | None = None) -> Compilation:
    """Return the compilation of a file, by default under its own name."""
    return Compilation(path, name or path.name, options)


def module_of(compilation: Compilation) -> ir.Module:
    """Return what the scenarios of a file mean; there must not be an error in it."""
    assert compilation.ir is not None, compilation.diagnostics
    return compilation.ir


@cache
def documents(compilation: Compilation, options: XmlOptions) -> tuple[XmlScenario, ...]:
    """Return the documents of a file, exact ones also where approximations are allowed."""
    if options.allow_approx:
        exact = documents(compilation, replace(options, allow_approx=False))
        if all(each.xml is not None for each in exact):
            return exact
    return emit(module_of(compilation), options, compilation.path.parent)
