"""Profiles of tools: one for each name that `--xml-profile` takes."""

from pathlib import Path

from osc2tx.backends.xosc import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import (
    DEFAULT_XML_VERSION,
    ONLY_VERSIONS,
    XML_PROFILES,
    CompileOptions,
    XmlOptions,
)
from osc2tx.xosc.profiles import PROFILES


def test_every_name_has_a_profile() -> None:
    assert {name: profile.name for name, profile in PROFILES.items()} == {
        name: name for name in XML_PROFILES
    }


def test_the_default_version_is_one_that_the_tool_reads() -> None:
    for name, profile in PROFILES.items():
        assert ONLY_VERSIONS.get(name, DEFAULT_XML_VERSION) in profile.versions, name


VALUES_OF_AN_EVENT = """import osc.standard

scenario top:
    ego: vehicle
    event e(n: int)
    event two
    on @e as x if x.n == 2:
        emit two
    do serial:
        emit e(1)
        emit e(2)
        wait elapsed(1s)
"""


def test_a_number_has_no_opposite_that_a_tool_without_edges_could_wait_for(tmp_path: Path) -> None:
    path = tmp_path / "top.osc"
    module = Compilation(path, "top.osc", CompileOptions(), text=VALUES_OF_AN_EVENT).ir
    assert module is not None
    (found,) = emit(module, XmlOptions(version="1.0", profile="scenario_runner"), tmp_path)
    assert found.xml is None
    reasons = [entry.reason for entry in found.report.losses if entry.construct == "condition"]
    assert "scenario_runner cannot tell when a value begins to be that one" in reasons
