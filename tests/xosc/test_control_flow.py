"""Documents of all kinds of control flow do what the embedded world does, at steps of 50 ms."""

from pathlib import Path

import pytest

from osc2tx.options import XmlOptions, XmlVersion
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.checks import schema_errors, story_problems
from tests.xosc.parity import Given, check, difference, is_measured, scenarios

FLOW = Path(__file__).parent / "control_flow.osc"
NAMES = [
    line.removeprefix("scenario ").rstrip(":")
    for line in FLOW.read_text(encoding="utf-8").splitlines()
    if line.startswith("scenario ") and "pass_by" not in line  # that one is only invoked
]
COARSE = 0.05  # s


def assert_alike(name: str, version: XmlVersion, *, is_lazy: bool = False) -> None:
    xml = XmlOptions(version=version, allow_approx=True)
    given = Given(FLOW, RunSettings(dt=COARSE), xml=xml)
    (document,) = (each for each in scenarios(given) if each.name == name)
    assert document.xml is not None, document.report.obstacles
    assert schema_errors(document.xml, version) == []
    assert story_problems(document.xml) == []
    if is_measured(document):
        check(given, document, is_lazy=is_lazy)
    else:
        difference(given, document, is_lazy=is_lazy)  # events all the same


@pytest.mark.parametrize("name", NAMES)
def test_control_flow(name: str) -> None:
    assert_alike(name, "1.3")


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_control_flow_in_a_lazy_tool(name: str) -> None:
    assert_alike(name, "1.3", is_lazy=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("version", ["1.0", "1.1", "1.2", "1.4"])
def test_control_flow_in_other_versions(name: str, version: XmlVersion) -> None:
    assert_alike(name, version)
