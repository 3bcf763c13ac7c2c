"""The values that a scenario fixes, of its own parameters and of the members of its objects."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.analysis.constraints.parameter_lookup import is_of_scope, name_of
from osc2tx.analysis.constraints.propagation import ConstraintAnalysis, State
from osc2tx.analysis.constraints.value_text import format_value
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym


def fixed_values(
    model: SemanticModel, scenario: sym.ScenarioSymbol, constraints: ConstraintAnalysis
) -> Mapping[str, str]:
    """Return the constants at compile time, by path: `about.priority`, as written in a scenario.

    Strings come without quotes.
    """
    found = constraints.types[scenario]
    members = (
        found.parameter(key, last.type)
        for key in found.by_key
        if is_of_scope(key) and isinstance(last := key[-1], sym.FieldSymbol)
    )
    values = {
        name_of(parameter.key): format_value(model, parameter)
        for parameter in (*constraints.parameters(scenario), *members)
        if parameter.state is State.FIXED
    }
    return dict(sorted(values.items()))
