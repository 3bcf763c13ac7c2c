"""Event specifications whose condition cannot change while the scenario runs (§7.3.10)."""

from __future__ import annotations

from osc2tx.analysis.constraints.domains import FALSE, TRUE, Domain
from osc2tx.analysis.constraints.operation_list import OperationListBuilder
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.constraints.solver import values_on
from osc2tx.analysis.lints.usage import Usage
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast


def report_conditions(model: SemanticModel, usage: Usage, sink: DiagnosticSink) -> None:
    """Report the conditions of the root file that are constant."""
    for wait in usage.waits:
        condition = wait.condition
        match condition:
            case ast.LevelCondition(expression=expression):
                if wait.event is None:
                    _report_level(model, expression, sink)
            case ast.RiseCondition(expression=expression) | ast.FallCondition(
                expression=expression
            ):
                if _is_constant(model, expression):
                    sink.report(
                        "OSC436",
                        condition.span,
                        "this never happens: its condition does not change during the run",
                    )
            case _:
                continue


def _report_level(model: SemanticModel, expression: ast.Expression, sink: DiagnosticSink) -> None:
    if not _is_constant(model, expression):
        return
    value = _value(model, expression)
    if value == TRUE:
        message = "this condition is always true, so it holds at once"
    elif value == FALSE:
        message = "this condition is never true"
    else:
        message = "this condition does not change during the run: it holds at once, or never"
    sink.report("OSC436", expression.span, message)


def _value(model: SemanticModel, expression: ast.Expression) -> Domain:
    """Evaluate a condition of literals alone; parameters count as unknown."""
    place = Place(model=model, owner=None, prefix=(), it=None)
    operations = OperationListBuilder(model).write(expression, place.locate)
    return values_on(operations, {})[-1]


def _is_constant(model: SemanticModel, expression: ast.Expression) -> bool:
    """Whether an expression consists of literals and parameters only."""
    for node in nodes_below(expression):
        match node:
            case ast.Call() | ast.ItExpression() | ast.Index() | ast.Cast() | ast.TypeTest():
                return False
            case ast.NameExpression() | ast.MemberAccess():
                symbol = model.symbol_of(node)
                if isinstance(symbol, sym.EnumMemberSymbol):
                    continue
                if not isinstance(symbol, sym.FieldSymbol) or symbol.is_variable:
                    return False
            case _:
                continue
    return True
