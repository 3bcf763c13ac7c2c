"""The document with the values that open parameters may have (`ParameterValueDistribution`, 1.1).

Values are listed deterministically: runs can be repeated, and not every tool carries out stochastic
distributions.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, prod

from osc2tx.backends.xosc.logical.parameters import STEPS, OpenParameter, value_text
from osc2tx.backends.xosc.logical.sampling import Domain, Row
from osc2tx.xosc import elements as xml
from osc2tx.xosc.columns import Column


def needs_table(domain: Domain) -> bool:
    """Whether values have to be listed together: they depend on each other, or are too many."""
    if domain.is_joint:
        return True
    combinations = prod(len(p.choices) or STEPS + 1 for p in domain.parameters)
    return len(domain.parameters) > 1 and combinations > domain.most_rows


def document(
    header: xml.FileHeader, file: str, distributions: Sequence[xml.DeterministicPart]
) -> xml.OpenSCENARIO:
    """Return the document.

    Args:
        header: The `FileHeader`.
        file: Name of the document of the scenario.
        distributions: What it holds.
    """
    return xml.OpenSCENARIO(
        header,
        xml.ParameterValueDistribution(
            xml.ScenarioFile(filepath=file), xml.Deterministic(*distributions)
        ),
    )


def single(
    parameter: OpenParameter, domain: Domain
) -> xml.DeterministicSingleParameterDistribution:
    """Return the values of one parameter; tools combine them with those of others."""
    values: xml.DistributionSet | xml.DistributionRange
    if parameter.choices:
        values = xml.DistributionSet(
            *(xml.Element(value=value_text(choice)) for choice in parameter.choices)
        )
    else:
        low, high = parameter.limits(domain.values(parameter))
        values = xml.DistributionRange(
            xml.Range(lowerLimit=low, upperLimit=high),
            stepWidth=floor((high - low) / STEPS * 1e9) / 1e9,  # reach the end
        )
    return xml.DeterministicSingleParameterDistribution(values, parameterName=parameter.name)


def table(
    parameters: Sequence[OpenParameter], rows: Sequence[Row], columns: Sequence[Column]
) -> xml.DeterministicMultiParameterDistribution:
    """Return the values of parameters together, with those of what follows from them."""
    known = {parameter.name for parameter in parameters}
    following = [column for column in columns if column.name not in known]
    return xml.DeterministicMultiParameterDistribution(
        xml.ValueSetDistribution(
            *(
                xml.ParameterValueSet(
                    *(_assigned(p.name, value_text(row.point[p.key])) for p in parameters),
                    *(_assigned(column.name, column.texts[index]) for column in following),
                )
                for index, row in enumerate(rows, start=1)
            )
        )
    )


def _assigned(name: str, value: str) -> xml.ParameterAssignment:
    return xml.ParameterAssignment(parameterRef=name, value=value)


MOST_COLUMNS = 60
"""Attributes that follow from parameters; a table with more is no help to anyone."""
