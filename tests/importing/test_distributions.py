"""Distributions of parameters with constraints."""

from osc2tx.importing.report import ImportReport
from osc2tx.importing.value_files import read_distribution
from osc2tx.xosc import read

VALUES = """<OpenSCENARIO><ParameterValueDistribution><ScenarioFile filepath="a.xosc"/>
  <Deterministic>
  <DeterministicSingleParameterDistribution parameterName="Fast"><DistributionSet>
  <Element value="10"/><Element value="20"/></DistributionSet>
  </DeterministicSingleParameterDistribution>
  <DeterministicSingleParameterDistribution parameterName="Slow"><DistributionSet>
  <Element value="15"/><Element value="5"/></DistributionSet>
  </DeterministicSingleParameterDistribution>
  </Deterministic></ParameterValueDistribution></OpenSCENARIO>"""
SCENARIO = """<OpenSCENARIO><ParameterDeclarations>
  <ParameterDeclaration name="Least" parameterType="double" value="12"/>
  <ParameterDeclaration name="Fast" parameterType="double" value="30">
  <ConstraintGroup>
  <ValueConstraint rule="greaterThan" value="{}"/></ConstraintGroup></ParameterDeclaration>
  <ParameterDeclaration name="Slow" parameterType="double" value="1"/>
  </ParameterDeclarations></OpenSCENARIO>"""


def first(limit: str) -> dict[str, str]:
    found = read_distribution(read(VALUES.encode()), ImportReport("a.xosc"))
    found.constrain(read(SCENARIO.format(limit).encode()))
    return found.first


def test_the_first_row_that_the_constraints_allow_is_run() -> None:
    """Rows come with the last parameter fastest: 10/15, 10/5, 20/15, 20/5."""
    assert first("1") == {"Fast": "10", "Slow": "15"}
    assert first("${$Slow + 1}") == {"Fast": "10", "Slow": "5"}
    assert first("$Least") == {"Fast": "20", "Slow": "15"}


def test_without_an_allowed_row_it_is_the_first_one() -> None:
    assert first("50") == {"Fast": "10", "Slow": "15"}
