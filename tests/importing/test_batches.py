"""Documents that are imported together: what they share is said once."""

from pathlib import Path

import pytest

from osc2tx.cli.import_ import Result, import_all
from osc2tx.compilation.driver import Compilation
from osc2tx.importing.document import Folders
from osc2tx.options import CompileOptions
from tests.importing.documents import at_time, document, event, speed_change

SPEED = '<ParameterDeclaration name="Speed_kph" parameterType="double" value="72"/>'
LIMITED = SPEED.replace(
    "/>",
    '><ConstraintGroup><ValueConstraint rule="greaterThan" value="0"/></ConstraintGroup>'
    "</ParameterDeclaration>",
)
TARGET = '<ParameterDeclaration name="Target" parameterType="double" value="25"/>'
VALUES = """<OpenSCENARIO><FileHeader description="Some speeds" author="us"/>
  <ParameterValueDistribution><ScenarioFile filepath="speeds.xosc"/><Deterministic>
  <DeterministicSingleParameterDistribution parameterName="{}"><DistributionSet>{}
  </DistributionSet></DeterministicSingleParameterDistribution></Deterministic>
  </ParameterValueDistribution></OpenSCENARIO>"""


def values(name: str, *texts: str) -> str:
    return VALUES.format(name, "".join(f'<Element value="{each}"/>' for each in texts))


def scenario(target: str = "$Target", parameters: str = SPEED + TARGET) -> str:
    faster = event("Faster", speed_change(target), at_time("1"))
    return document(faster, parameters=parameters, ego_speed="${$Speed_kph / 3.6}")


def results(folder: Path, **texts: str) -> dict[str, Result]:
    """Return what becomes of documents in a folder; each of them does what its document does."""
    (folder / "xml").mkdir()
    for name, text in texts.items():
        (folder / "xml" / f"{name}.xosc").write_text(text, encoding="utf-8")
    sources = sorted((folder / "xml").glob("*.xosc"))
    found, refused = import_all(list(sources), folder / "osc", Folders())
    assert refused == 0
    for each in found:
        measured = each.imported.report.measured
        assert (each.faults, measured is not None and measured.is_exact) == ((), True)
    return {each.imported.name: each for each in found}


def body(result: Result) -> list[str]:
    return result.text[result.text.index("scenario ") :].splitlines()


def test_values_of_a_scenario_inherit_it(tmp_path: Path) -> None:
    found = results(tmp_path, speeds=scenario(), values=values("Speed_kph", "50", "60"))
    assert body(found["values"]) == [
        "scenario values inherits speeds:",
        "    keep(speed in [50kph, 60kph])",
    ]
    assert "speed: speed = 72kph" in found["speeds"].text
    rows = (tmp_path / "osc" / "values.csv").read_text(encoding="utf-8").split()
    assert rows == ["speed", "50kph", "60kph"]


def test_the_scenario_of_values_is_imported_with_them(tmp_path: Path) -> None:
    (tmp_path / "speeds.xosc").write_text(scenario(), encoding="utf-8")
    alone = tmp_path / "values.xosc"
    alone.write_text(values("Target", "22"), encoding="utf-8")
    found, _ = import_all([alone], tmp_path / "osc", Folders())
    assert [each.imported.name for each in found] == ["speeds", "values"]
    assert body(found[1])[1:] == ["    keep(target == 22mps)"]


def test_the_value_that_a_scenario_has_is_not_stated_again(tmp_path: Path) -> None:
    found = results(tmp_path, speeds=scenario(), values=values("Target", "25"))
    assert body(found["values"]) == ["scenario values inherits speeds"]


def test_values_that_change_the_course_of_a_scenario_have_one_of_their_own(tmp_path: Path) -> None:
    """At 0 m/s² no speed changes: the event is none."""
    rate = speed_change("30", "$Rate").replace(
        'dynamicsDimension="time"', 'dynamicsDimension="rate"'
    )
    parameter = '<ParameterDeclaration name="Rate" parameterType="double" value="0"/>'
    speeds = document(event("Faster", rate, at_time("1")), parameters=parameter)
    found = results(tmp_path, speeds=speeds, values=values("Rate", "2"), more=values("Rate", "2"))
    assert "change_speed" not in found["speeds"].text
    assert "inherits" not in found["more"].text
    assert "rate: acceleration = 2mpss" in found["more"].text
    assert body(found["values"]) == ["scenario values inherits more"]


def test_scenarios_of_a_folder_share_what_they_have_in_common(tmp_path: Path) -> None:
    speeds = {f"cars_{n}": scenario(str(n), LIMITED) for n in (20, 21, 22)}
    found = results(tmp_path, **speeds)
    path = tmp_path / "osc" / "cars_base.osc"
    base = path.read_text(encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert compilation.ir is not None
    assert list(compilation.diagnostics) == []
    assert base[base.index("scenario ") :].splitlines() == [
        "scenario cars_base:",
        "    road: map with:",
        '        keep(it.map_file == "highway.xodr")',
        "    ego, other: vehicle with:",
        "        keep(it.vehicle_category == car and it.bounding_box.length == 5m)",
        "        keep(it.bounding_box.width == 2m and it.bounding_box.height == 1.6m)",
        "        keep(it.bounding_box.center.x == 1.4m)",
        "",
        "    speed: speed = 72kph with:",
        "        keep(it > 0kph)",
    ]
    assert body(found["cars_20"])[:2] == ["scenario cars_20 inherits cars_base:", "    do serial:"]


@pytest.mark.parametrize("count", [2, 3])
def test_two_scenarios_are_no_family(count: int, tmp_path: Path) -> None:
    found = results(tmp_path, **{f"cars_{n}": scenario(str(20 + n)) for n in range(count)})
    assert all(("inherits" in each.text) == (count > 2) for each in found.values())
