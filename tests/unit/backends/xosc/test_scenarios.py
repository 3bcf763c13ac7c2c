"""The repository's own scenarios: valid in every version that can say them, and able to end."""

from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import XML_VERSIONS, CompileOptions, XmlOptions, XmlProfile, XmlVersion
from tests.unit.backends.xosc.checks import checker_issues, schema_errors, story_problems
from tests.unit.backends.xosc.documents import compiled, documents

SCENARIOS = Path(__file__).parents[4] / "scenarios"
EXACT = {
    "cut_in": ("1.2", "1.3", "1.4"),
    "cut_in_and_evade": ("1.2", "1.3"),  # esmini does not read 1.4
    "follow_leader": XML_VERSIONS,
    "pedestrian_crossing": XML_VERSIONS,
    "hello_world": ("1.3",),
}
APPROXIMATED = {
    "cut_in": XML_VERSIONS,
    "cut_in_and_evade": XML_VERSIONS[:-1],
    "follow_leader": XML_VERSIONS,
    "pedestrian_crossing": XML_VERSIONS,
    "hello_world": XML_VERSIONS[:-1],
}
OUTSIDE = {"hello_world": {"signals": ("go_signal@1s",), "spawns": ("hero=16,-3,5",)}}
PROFILES: dict[str, XmlProfile] = {"cut_in_and_evade": "esmini", "hello_world": "esmini"}


def written(name: str, version: XmlVersion, *, allow_approx: bool = False) -> XmlScenario:
    dialect = "carla" if name == "hello_world" else "asam"
    path = SCENARIOS / f"{name}.osc"
    profile = PROFILES.get(name, "generic")
    options = XmlOptions(
        version=version, profile=profile, allow_approx=allow_approx, **OUTSIDE.get(name, {})
    )
    (scenario,) = documents(compiled(path, CompileOptions(dialect=dialect)), options)
    return scenario


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("version", XML_VERSIONS)
def test_versions_that_can_say_it(name: str, version: XmlVersion) -> None:
    assert (written(name, version).xml is not None) is (version in EXACT[name])
    loose = written(name, version, allow_approx=True)
    assert (loose.xml is not None) is (version in APPROXIMATED[name]), loose.report.obstacles


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("version", XML_VERSIONS)
def test_documents_are_sound(name: str, version: XmlVersion, tmp_path: Path) -> None:
    xml = written(name, version, allow_approx=True).xml
    if xml is None:
        return
    assert schema_errors(xml, version) == []
    assert story_problems(xml) == []
    assert checker_issues(xml, tmp_path) == []


PARTS = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.hurry:
    v: speed
    do actor.change_speed(target: v)

scenario vehicle.cruise:
    v: speed = 20mps
    do actor.drive(duration: 2s) with:
        speed(v)

scenario main:
    ego: vehicle
    do serial:
        ego.cruise()
        ego.hurry(v: 25mps)
"""


def test_a_scenario_that_needs_values_from_its_caller_has_no_document(tmp_path: Path) -> None:
    (tmp_path / "parts.osc").write_text(PARTS, encoding="utf-8")
    module = Compilation(tmp_path / "parts.osc", "parts.osc", CompileOptions()).ir
    assert module is not None
    assert [each.name for each in emit(module, XmlOptions(), None)] == ["vehicle.cruise", "main"]


INSIDE_A_METHOD = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.hurry:
    v: speed = 10mps
    def doubled() -> speed is expression 2 * v
    do actor.change_speed(target: doubled())

scenario main:
    a, b: vehicle
    do a.hurry(v: b.speed)
"""


def test_a_method_does_not_take_the_default_of_what_only_the_run_knows(tmp_path: Path) -> None:
    (tmp_path / "inside.osc").write_text(INSIDE_A_METHOD, encoding="utf-8")
    module = Compilation(tmp_path / "inside.osc", "inside.osc", CompileOptions()).ir
    assert module is not None
    main = emit(module, XmlOptions(), None)[-1]
    assert main.xml is None
    assert "`b.speed` is only known during the run" in {e.reason for e in main.report.obstacles}
