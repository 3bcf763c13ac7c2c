"""Conditions on ends that nothing comes to look at variables that are declared."""

from pathlib import Path

import pytest

from osc2tx.options import XmlOptions, XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from tests.unit.backends.xosc.documents import compiled, documents

NEVER_ENDS = """import osc.standard

scenario never_ends:
    car: vehicle
    do one_of:
        one_of:
            wait true
            serial:
                one_of:
                    wait 3kph != 3kph
                    moving: car.move()
                wait elapsed(2s)
            wait @moving.end if true
        wait false
"""


@pytest.mark.parametrize("version", ["1.0", "1.3"])
def test_the_mark_of_an_end_that_never_comes_is_declared(
    tmp_path: Path, version: XmlVersion
) -> None:
    path = tmp_path / "never_ends.osc"
    path.write_text(NEVER_ENDS, encoding="utf-8")
    (found,) = documents(compiled(path), XmlOptions(version=version, allow_approx=True))
    assert found.xml is not None
    document = read(found.xml)
    conditions = {each.variableRef for each in document.below(xml.VariableCondition)}
    conditions |= {each.parameterRef for each in document.below(xml.ParameterCondition)}
    declared = {each.name for each in document.below(xml.VariableDeclaration)}
    declared |= {each.name for each in document.below(xml.ParameterDeclaration)}
    assert conditions
    assert conditions <= declared
