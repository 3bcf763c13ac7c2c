"""Analysis of a checked program: the values that its constraints allow, and unreachable parts.

Input: a `SemanticModel` without errors; only the user's files are looked at. Output: an `Analysis`,
and diagnostics OSC42x (constraints, errors) and OSC43x (warnings). `analyse` runs the parts:

1. Constraints. `collect` gathers the constraints of each type and its invocations, with names
   resolved by `parameter_lookup`; `overrides` drops the defaults that are replaced;
   `operation_list` flattens expressions; `solver` propagates `domains` to a fixed point by
   `forward` and `backward` over `interval_arithmetic`. The result is the `ConstraintAnalysis` in
   `propagation`; `report_constraints` reports conflicts.
2. Liveness. `termination` finds members that never end by themselves, `usage` the used names;
   `liveness`, `usage`, `recursive_scenarios`, `tree_sizes` and `constant_conditions` report.
3. Levels. `levels` finds for each scenario whether it is abstract, logical or concrete, with its
   open values; `cast_checks` judges its actors, `value_text` writes values in the units of the
   source.

The catalogue (`library_facts`) has the facts about actions and modifiers beyond their declarations.
`tree_walk` walks syntax trees.

Invariants: every reported contradiction is certain; values that are not known at compile time count
as unknown; no function recurses along chains of expressions or members.
"""

from osc2tx.analysis.analyse import Analysis, analyse
from osc2tx.analysis.constraints.propagation import (
    ConstraintAnalysis,
    ParameterDomain,
    State,
    TypeConstraints,
    analyse_global,
    single_value,
)
from osc2tx.analysis.levels import Level, Opening, ScenarioLevel

__all__ = [
    "Analysis",
    "ConstraintAnalysis",
    "Level",
    "Opening",
    "ParameterDomain",
    "ScenarioLevel",
    "State",
    "TypeConstraints",
    "analyse",
    "analyse_global",
    "single_value",
]
