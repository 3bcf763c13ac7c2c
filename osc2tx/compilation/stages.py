"""The stages between the text and the back ends, each loaded when it first runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx.diagnostics import DiagnosticSink
from osc2tx.support.recursion import allowing_deep_trees

if TYPE_CHECKING:
    from osc2tx.analysis import Analysis
    from osc2tx.compilation.imports import ImportLoader
    from osc2tx.ir import Module
    from osc2tx.options import CompileOptions
    from osc2tx.semantics import SemanticModel
    from osc2tx.syntax.ast import File


def build_model(
    file: File, options: CompileOptions, loader: ImportLoader, sink: DiagnosticSink
) -> SemanticModel:
    """Return the checked program of a file and of its imports."""
    from osc2tx.semantics import DIALECTS, ModelBuilder

    builder = ModelBuilder(
        sink,
        standard=options.standard,
        dialect=DIALECTS[options.dialect],
        load=loader,
        import_help=loader.help_for,
    )
    with allowing_deep_trees():
        return builder.build(file)


def analyse_constraints(
    model: SemanticModel, options: CompileOptions, sink: DiagnosticSink
) -> Analysis:
    """Return the values that constraints allow, and the levels of the scenarios."""
    from osc2tx.analysis import analyse

    with allowing_deep_trees():
        return analyse(model, sink, options.one_of, first_come=options.dialect == "carla")


def lower_and_verify(
    model: SemanticModel, analysis: Analysis, options: CompileOptions, sink: DiagnosticSink
) -> Module | None:
    """Return the program in the IR; `None` if a part of it cannot be lowered."""
    from osc2tx.ir import verify
    from osc2tx.lowering import lower

    with allowing_deep_trees():
        module = lower(model, analysis.constraints, options, sink)
        if sink.has_errors:
            return None
        verify(module)
    return module


def check_library_rules(module: Module, sink: DiagnosticSink) -> bool:
    """Report the calls that break a rule of the library; return whether there are none."""
    from osc2tx.rules import check_rules

    with allowing_deep_trees():
        check_rules(module, sink)
    return not sink.has_errors
