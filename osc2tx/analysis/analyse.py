"""Entry of the analysis."""

from __future__ import annotations

from osc2tx.analysis.constraints.propagation import ConstraintAnalysis, analyse_constraints
from osc2tx.analysis.constraints.report_constraints import report_constraints
from osc2tx.analysis.levels import ScenarioLevel, find_levels
from osc2tx.analysis.lints.constant_conditions import report_conditions
from osc2tx.analysis.lints.contradictory_durations import report_durations
from osc2tx.analysis.lints.liveness import report_liveness
from osc2tx.analysis.lints.recursive_scenarios import report_recursion
from osc2tx.analysis.lints.shared_slots import report_shared_slots
from osc2tx.analysis.lints.termination import find_endings
from osc2tx.analysis.lints.time_lints import report_times
from osc2tx.analysis.lints.tree_sizes import report_tree_sizes
from osc2tx.analysis.lints.usage import CONSTRAINTS, find_usage, report_usage
from osc2tx.analysis.tree_walk import NodesByKind
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.options import OneOfPolicy
from osc2tx.semantics import SemanticModel
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Analysis:
    """The result of the analysis of a program.

    Attributes:
        constraints: The values that its constraints fix, bound and leave open.
        levels: The level of each scenario of the root file.
    """

    constraints: ConstraintAnalysis
    levels: tuple[ScenarioLevel, ...]


def analyse(
    model: SemanticModel,
    sink: DiagnosticSink,
    one_of: OneOfPolicy = "race",
    *,
    first_come: bool = False,
) -> Analysis:
    """Analyse a program without errors; report contradictions and unreachable parts.

    Args:
        model: The checked program.
        sink: Receives the diagnostics.
        one_of: Which member of a `one_of` counts.
        first_come: The first of duration and `until` ends a member (dialect `carla`).
    """
    nodes = {file: NodesByKind(file, closed=CONSTRAINTS) for file in model.files}
    usage = find_usage(model, nodes)
    constraints = analyse_constraints(model)
    report_constraints(model, constraints, usage, sink)
    endings = find_endings(model)
    report_recursion(model, sink)
    report_tree_sizes(model, sink)
    if not first_come:
        report_durations(model, endings, sink)
    report_liveness(model, endings, frozenset(usage.invoked), sink)
    report_usage(model, usage, sink)
    report_conditions(model, usage, sink)
    report_times(model, nodes[model.root], sink)
    report_shared_slots(model, nodes[model.root], sink, one_of)
    return Analysis(constraints, find_levels(model, constraints, endings, one_of))
