"""Times that are probably unintended (§7.3.10), or contradict their overlap (§7.3.13.2)."""

from __future__ import annotations

from math import copysign

from osc2tx.analysis.tree_walk import NodesByKind
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.diagnostics.fixes import insert_before
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.units import to_si
from osc2tx.syntax import ast
from osc2tx_shared.steps import DEFAULT_STEP


def report_times(model: SemanticModel, nodes: NodesByKind, sink: DiagnosticSink) -> None:
    """Report the times of the root file that no run observes as written."""
    for reaction in nodes.of(ast.OnDirective):
        if _elapsed(reaction.event) is not None:
            sink.report(
                "OSC441",
                reaction.event.span,
                "this is true from that time on: `on` reacts at every later instant of the run",
                help="to react once, write `wait elapsed(…)` and the reaction inside `do`",
            )
    for wait in nodes.of(ast.WaitDirective):
        _report_short(model, _elapsed(wait.event), sink)
    for composition in nodes.of(ast.Composition):
        _report_offset(composition, sink)


def _report_offset(node: ast.Composition, sink: DiagnosticSink) -> None:
    """Report an offset of starts that the default overlap excludes: members start together."""
    given = {"overlap" if a.name is None else a.name.text: a for a in node.arguments}
    offset = given.get("start_to_start")
    if node.operator is not ast.CompositionOperator.PARALLEL or offset is None:
        return
    if "overlap" not in given and _excludes_zero(offset.value):
        sink.report(
            "OSC445",
            offset.span,
            "the members of a `parallel` without `overlap` start together",
            help=insert_before(offset.span, "overlap: any, ", "write `overlap: any` before it"),
        )


def _excludes_zero(value: ast.Expression) -> bool:
    """Whether a written time, or a range between two of them, is not zero."""
    ends = (value.lower, value.upper) if isinstance(value, ast.RangeLiteral) else (value,)
    signs = {_sign(end) for end in ends}
    return signs in ({1.0}, {-1.0})


def _sign(value: ast.Expression) -> float:
    """Return the sign of a written time; zero for zero, and for what is computed."""
    match value:
        case ast.Unary(operator=ast.UnaryOperator.NEGATE):
            return -_sign(value.operand)
        case ast.PhysicalLiteral() if value.value != 0:
            return copysign(1.0, value.value)
        case _:
            return 0.0


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
    if 0.0 < seconds < DEFAULT_STEP:
        sink.report(
            "OSC440",
            duration.span,
            f"{seconds:g} s is shorter than the step of a run, which is {DEFAULT_STEP:g} s by"
            " default: the wait has no effect",
            help=f"wait longer, or run it with `--dt {seconds:g}`",
        )
