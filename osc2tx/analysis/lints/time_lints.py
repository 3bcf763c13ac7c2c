"""Times that are valid, but hardly what was meant (§7.3.10)."""

from __future__ import annotations

from osc2tx.analysis.tree_walk import NodesByKind
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.units import to_si
from osc2tx.syntax import ast

STEP = 0.05  # s, the length of a step where the run does not say another


def report_times(model: SemanticModel, nodes: NodesByKind, sink: DiagnosticSink) -> None:
    """Report the `elapsed` conditions of the root file that no run observes as written."""
    for reaction in nodes.of(ast.OnDirective):
        if _elapsed(reaction.event) is not None:
            sink.report(
                "OSC441",
                reaction.event.span,
                "this is true from that time on: `on` reacts at every instant of the run",
                help="to do it once write `wait elapsed(…)` and what follows inside `do`",
            )
    for wait in nodes.of(ast.WaitDirective):
        _report_short(model, _elapsed(wait.event), sink)


def _elapsed(event: ast.EventSpecification) -> ast.Expression | None:
    """Return the time of an event specification that waits for time alone."""
    condition = event.condition
    alone = event.event is None and isinstance(condition, ast.ElapsedCondition)
    return condition.duration if alone and isinstance(condition, ast.ElapsedCondition) else None


def _report_short(
    model: SemanticModel, duration: ast.Expression | None, sink: DiagnosticSink
) -> None:
    if not isinstance(duration, ast.PhysicalLiteral) or duration not in model.units:
        return
    seconds = to_si(duration.value, model.units[duration])
    if 0.0 < seconds < STEP:
        sink.report(
            "OSC440",
            duration.span,
            f"{seconds:g} s are less than a step of the run, which is {STEP:g} s by default:"
            " nothing can be seen in between",
            help=f"wait longer, or run it with `--dt {seconds:g}`",
        )
