"""`osc2tx import`: files, exit codes, distributions."""

import json
from pathlib import Path

import pytest
from click import UsageError
from click.testing import CliRunner, Result

from osc2tx.cli import cli
from osc2tx.cli.reporting import Session
from tests.importing.documents import CAR, after, at_time, document, event, speed_change

PARAMETER = '<ParameterDeclaration name="Speed_kph" parameterType="double" value="72"/>'
VALUES = """<OpenSCENARIO><FileHeader revMajor="1" revMinor="1" date="2024-01-01T00:00:00"
  description="Speeds" author="us"/><ParameterValueDistribution>
  <ScenarioFile filepath="speeds.xosc"/><Deterministic>
  <DeterministicSingleParameterDistribution parameterName="Speed_kph">
  <DistributionRange stepWidth="10"><Range lowerLimit="50" upperLimit="70"/></DistributionRange>
  </DeterministicSingleParameterDistribution></Deterministic></ParameterValueDistribution>
  </OpenSCENARIO>"""


def command(*words: str | Path, given: bytes | None = None) -> Result:
    arguments = list(map(str, words))
    return CliRunner().invoke(cli, arguments, given, standalone_mode=False, obj=Session())


def written(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_an_exact_document_is_a_scenario_with_a_report(tmp_path: Path) -> None:
    source = written(tmp_path, "two-cars.xosc", document(""))
    assert command("import", source, "-o", tmp_path / "out").return_value == 0
    report = json.loads((tmp_path / "out" / "two_cars.import.json").read_text(encoding="utf-8"))
    assert report["grade"] == "exact"
    assert command("check", tmp_path / "out" / "two_cars.osc").return_value == 0


def test_what_is_not_exact_has_to_be_allowed(tmp_path: Path) -> None:
    text = document("").replace("<Init>", "<Init><Strange/>")
    source = written(tmp_path, "strange.xosc", text)
    result = command("import", source, "-o", tmp_path / "out")
    assert result.return_value == 3
    assert "left out: <Strange>" in result.output
    assert command("import", source, "-o", tmp_path / "out", "--allow-approx").return_value == 0


@pytest.mark.parametrize("text", ["<OpenSCENARIO>", "", "<a/>", "no XML"])
def test_what_is_no_document_is_unreadable(tmp_path: Path, text: str) -> None:
    source = written(tmp_path, "bad.xosc", text)
    result = command("import", source, "-o", tmp_path / "out")
    assert result.return_value == 4
    assert "bad.xosc:" in result.output


def test_standard_input(tmp_path: Path) -> None:
    given = document("").encode()
    words = ("import", "-", "-o", tmp_path / "out", "--scenario-name", "Given")
    assert command(*words, given=given).return_value == 0
    assert "scenario given:" in (tmp_path / "out" / "given.osc").read_text(encoding="utf-8")


def test_a_distribution_is_a_campaign(tmp_path: Path) -> None:
    text = document("", parameters=PARAMETER, ego_speed="${$Speed_kph / 3.6}")
    written(tmp_path, "speeds.xosc", text)
    source = written(tmp_path, "values.xosc", VALUES)
    out = tmp_path / "out"
    assert command("import", source, "-o", out).return_value == 0
    scenario = (out / "values.osc").read_text(encoding="utf-8")
    assert "import speeds\n\nscenario values inherits speeds:" in scenario
    assert scenario.endswith("    keep(speed in [50kph..70kph])\n")
    assert "    speed: speed = 72kph\n" in (out / "speeds.osc").read_text(encoding="utf-8")
    rows = (out / "values.csv").read_text(encoding="utf-8")
    assert rows.split() == ["speed", "50kph", "60kph", "70kph"]
    assert 'sampler = "table:values.csv"' in (out / "osc2tx.toml").read_text(encoding="utf-8")


def test_a_long_chain_of_events(tmp_path: Path) -> None:
    events = "".join(
        event(f"E{i}", speed_change("20", "0.5"), after(f"E{i - 1}") if i else at_time("1"))
        for i in range(600)
    )
    source = written(tmp_path, "chain.xosc", document(events))
    assert command("import", source, "-o", tmp_path / "out").return_value == 0


def test_a_project_of_documents(tmp_path: Path) -> None:
    (tmp_path / "xml").mkdir()
    written(tmp_path / "xml", "two-cars.xosc", document(""))
    result = command("init", tmp_path / "project", "--from-xml", tmp_path / "xml")
    assert result.return_value == 0
    assert (tmp_path / "project" / "scenarios" / "two_cars.osc").is_file()


def test_an_edited_scenario_is_kept(tmp_path: Path) -> None:
    source = written(tmp_path, "two-cars.xosc", document(""))
    words: list[str | Path] = ["import", source, "-o", tmp_path / "out"]
    assert command(*words).return_value == 0
    assert command(*words).return_value == 0
    scenario = tmp_path / "out" / "two_cars.osc"
    text = scenario.read_text(encoding="utf-8") + "# Mine.\n"
    scenario.write_text(text, encoding="utf-8")
    result = command(*words)
    assert (result.return_value, scenario.read_text(encoding="utf-8")) == (4, text)
    assert "exists with another text" in result.output
    assert command(*words, "--force").return_value == 0
    assert "# Mine." not in scenario.read_text(encoding="utf-8")


def test_a_folder_without_documents_is_refused(tmp_path: Path) -> None:
    result = command("import", tmp_path, "-o", tmp_path / "out")
    assert isinstance(result.exception, UsageError)
    assert "there is no .xosc file in" in str(result.exception)
    assert not (tmp_path / "out").exists()


REFERENCE = '<CatalogReference catalogName="cars" entryName="{}"/>'
LOCATIONS = "<CatalogLocations><VehicleCatalog><Directory path='{}'/></VehicleCatalog>"


def with_catalog(folder: Path, names: dict[str, str], entry: str = "car", car: str = CAR) -> None:
    """Write documents, which name the folder of their catalog in some ways."""
    catalog = f"<OpenSCENARIO><Catalog name='cars'>{car}</Catalog></OpenSCENARIO>"
    (folder / "catalogs").mkdir(parents=True)
    (folder / "more").mkdir()
    (folder / "catalogs" / "cars.xosc").write_text(catalog, encoding="utf-8")
    for name, path in names.items():
        text = document("").replace(CAR, REFERENCE.format(entry))
        text = text.replace("<CatalogLocations/>", f"{LOCATIONS.format(path)}</CatalogLocations>")
        (folder / f"{name}.xosc").write_text(text, encoding="utf-8")


def test_documents_share_the_library_of_a_catalog_that_they_name_differently(
    tmp_path: Path,
) -> None:
    with_catalog(tmp_path / "xml", {"one": "catalogs", "two": "more/../catalogs"})
    out = tmp_path / "out"
    command("import", tmp_path / "xml", "-o", out)
    assert sorted(each.stem for each in out.glob("*.osc")) == ["common", "one", "two"]
    common = (out / "common.osc").read_text(encoding="utf-8")
    assert common.count("actor car inherits vehicle:") == 1
    assert "road: highway_map" in (out / "one.osc").read_text(encoding="utf-8")
    assert command("fmt", "--check", out).return_value == 0


def test_documents_of_another_time_extend_the_library(tmp_path: Path) -> None:
    with_catalog(tmp_path / "first", {"one": "catalogs"})
    truck = CAR.replace('name="car"', 'name="truck"')
    with_catalog(tmp_path / "second", {"two": "catalogs"}, "truck", truck)
    out = tmp_path / "out"
    for folder in ("first", "second", "first"):
        assert command("import", tmp_path / folder, "-o", out).return_value == 0
    declared = (out / "common.osc").read_text(encoding="utf-8")
    assert "actor car inherits vehicle:" in declared
    assert "actor truck inherits vehicle:" in declared
    assert command("check", out).return_value == 0


def test_a_library_with_another_type_of_a_name_is_kept(tmp_path: Path) -> None:
    with_catalog(tmp_path / "first", {"one": "catalogs"})
    with_catalog(tmp_path / "second", {"two": "catalogs"}, car=CAR.replace('"5"', '"6"'))
    out = tmp_path / "out"
    command("import", tmp_path / "first", "-o", out)
    before = (out / "common.osc").read_bytes()
    assert command("import", tmp_path / "second", "-o", out).return_value == 4
    assert (out / "common.osc").read_bytes() == before
    assert command("import", tmp_path / "second", "-o", out, "--force").return_value == 0
    assert b"bounding_box.length == 6m" in (out / "common.osc").read_bytes()


def test_a_scenario_of_the_name_of_an_entity_keeps_it(tmp_path: Path) -> None:
    with_catalog(tmp_path / "xml", {"car": "catalogs", "common": "catalogs"})
    out = tmp_path / "out"
    assert command("import", tmp_path / "xml", "-o", out).return_value == 0
    assert sorted(each.stem for each in out.glob("*.osc")) == ["car", "common", "common_2"]
    assert "actor car_2 inherits vehicle:" in (out / "common.osc").read_text(encoding="utf-8")


def test_with_a_library_a_place_and_a_speed_at_once_are_one_action(tmp_path: Path) -> None:
    with_catalog(tmp_path / "xml", {"one": "catalogs"})
    out = tmp_path / "out"
    assert command("import", tmp_path / "xml", "-o", out).return_value == 0
    text = (out / "one.osc").read_text(encoding="utf-8")
    point = 'road.create_odr_point("1", "-3", 100m, 0m)'
    assert f"        ego.begin({point}, 20mps)\n" in text
    assert "other.assign_speed(15mps)" in text  # it is put beside the other one
    report = json.loads((out / "one.import.json").read_text(encoding="utf-8"))
    assert report["measured"]["place_m"] < 0.1


def test_entities_of_no_catalog_that_are_alike_share_a_type(tmp_path: Path) -> None:
    with_catalog(tmp_path / "xml", {"one": "catalogs", "two": "catalogs"})
    box = """<ScenarioObject name="{}"><MiscObject name="crate" mass="9"
      miscObjectCategory="obstacle"><BoundingBox><Center x="0" y="0" z="0.5"/>
      <Dimensions width="1" length="2" height="1"/></BoundingBox>
      <Properties/></MiscObject></ScenarioObject></Entities>"""
    for name in ("one", "two"):
        path = tmp_path / "xml" / f"{name}.xosc"
        path.write_text(path.read_text().replace("</Entities>", box.format(f"box_{name}")))
    out = tmp_path / "out"
    command("import", tmp_path / "xml", "-o", out)
    assert (out / "common.osc").read_text().count("actor crate inherits movable_object:") == 1
    assert "box_one: crate\n" in (out / "one.osc").read_text()
    assert command("check", out).return_value == 0
