"""Documents that ask for what is not theirs are refused, with a place and a reason."""

from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from osc2tx.importing.batch import Batch
from osc2tx.importing.document import NOWHERE, Folders, Refused
from osc2tx.importing.importer import Imported, import_document
from osc2tx.importing.libraries import Library
from osc2tx.importing.reach import Reach
from osc2tx_shared.map_files import SHIPPED
from tests.importing.documents import CAR, document
from tests.importing.test_accounting import DETERMINISTIC, DISTRIBUTIONS, EVENTS, WITH_PARAMETER
from tests.importing.test_command import command, written

LOGIC = '<LogicFile filepath="highway.xodr"/>'
CATALOG = f"<OpenSCENARIO><Catalog name='cars'>{CAR}</Catalog></OpenSCENARIO>"
REFERENCE = '<CatalogReference catalogName="cars" entryName="car"/>'


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder of documents in a project, with a map and a catalog outside of the project."""
    folder = tmp_path / "project" / "xosc"
    folder.mkdir(parents=True)
    (tmp_path / "project" / ".git").mkdir()
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "secret.xodr").write_bytes((SHIPPED / "highway.xodr").read_bytes())
    written(outside, "cars.xosc", CATALOG)
    return folder


def with_map(folder: Path, named: str, folders: Folders = NOWHERE) -> Imported:
    text = document("").replace(LOGIC, f'<LogicFile filepath="{named}"/>')
    return import_document(
        text.encode(), "a.xosc", Library(), path=folder / "a.xosc", folders=folders
    )


def findings(found: Imported, construct: str) -> list[tuple[str, bool]]:
    """Return what is said of an element, and whether with line and column."""
    return [
        (each.reason, each.place is not None and each.place.line > 0 and each.place.column > 0)
        for each in found.report.findings
        if each.construct == construct and each.grade == "left out"
    ]


@pytest.mark.parametrize(
    ("named", "reason"),
    [
        ("../../outside/secret.xodr", "leads out of the project"),
        ("..\\..\\outside\\secret.xodr", "leads out of the project"),
        ("../../../../../../../../etc/hostname", "leads out of the project"),
        ("{outside}/secret.xodr", "leads out of the project"),
        ("file://{outside}/secret.xodr", "addresses are not read"),
        ("http://localhost/secret.xodr", "addresses are not read"),
        ("link.xodr", "leads out of the project"),
        ("linked/secret.xodr", "leads out of the project"),
    ],
)
def test_a_map_outside_of_the_project(project: Path, named: str, reason: str) -> None:
    outside = project.parents[1] / "outside"
    (project / "link.xodr").symlink_to(outside / "secret.xodr")
    (project / "linked").symlink_to(outside)
    found = with_map(project, named.format(outside=outside))
    assert found.document.map_file is None
    ((said, is_placed),) = findings(found, "<LogicFile>")
    assert reason in said
    assert is_placed


def test_folders_of_the_user_are_part_of_the_project(project: Path) -> None:
    outside = project.parents[1] / "outside"
    found = with_map(project, "../../outside/secret.xodr", Folders((outside,)))
    assert found.document.map_file is not None
    assert not findings(found, "<LogicFile>")


def test_a_map_beside_the_folder_of_documents(project: Path) -> None:
    (project.parent / "maps").mkdir()
    written(project.parent / "maps", "own.xodr", (SHIPPED / "highway.xodr").read_text())
    found = with_map(project, "../maps/own.xodr")
    assert found.document.map_file is not None
    assert not findings(found, "<LogicFile>")


@pytest.mark.parametrize("named", ["../../outside", "{outside}", "file://{outside}", "linked"])
def test_a_catalog_outside_of_the_project(project: Path, named: str) -> None:
    outside = project.parents[1] / "outside"
    (project / "linked").symlink_to(outside)
    text = document("").replace(CAR, REFERENCE, 1)
    directory = f'<Directory path="{named.format(outside=outside)}"/>'
    locations = f"<CatalogLocations><VehicleCatalog>{directory}</VehicleCatalog></CatalogLocations>"
    text = text.replace("<CatalogLocations/>", locations)
    found = import_document(text.encode(), "a.xosc", Library(), path=project / "a.xosc")
    ((said, is_placed),) = findings(found, "<Directory>")
    assert "is not read" in said
    assert is_placed
    assert "ego: vehicle" in found.text


@pytest.mark.parametrize(
    "named", ["../../outside/two.xosc", "{outside}/two.xosc", "file:///two.xosc"]
)
def test_a_scenario_outside_of_the_project(project: Path, named: str) -> None:
    outside = project.parents[1] / "outside"
    written(outside, "two.xosc", document(""))
    text = DISTRIBUTIONS.format(DETERMINISTIC)
    text = text.replace("two_cars.xosc", named.format(outside=outside))
    source = written(project, "values.xosc", text)
    (refused,) = Batch(Folders()).run([source])
    assert isinstance(refused, Refused)
    assert "is not read" in refused.reason
    assert refused.place is not None


def test_a_scenario_that_is_not_there_is_named(project: Path) -> None:
    source = written(project, "values.xosc", DISTRIBUTIONS.format(DETERMINISTIC))
    result = command("import", source, "-o", project / "out")
    assert result.return_value == 4
    assert "values.xosc:2:" in result.output
    assert "its scenario 'two_cars.xosc' cannot be read" in result.output


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('<!DOCTYPE a [<!ENTITY x "y">]><OpenSCENARIO/>', "declares an entity"),
        (
            '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/hostname">]><a>&x;</a>',
            "declares an entity",
        ),
        ('<!DOCTYPE a [<!ENTITY % x SYSTEM "http://localhost/x"> %x;]><a/>', "declares an entity"),
        ("<OpenSCENARIO>" * 300, "deep"),
        ("<OpenSCENARIO>\n<a b='1' b='2'/></OpenSCENARIO>", "duplicate attribute"),
    ],
)
def test_texts(tmp_path: Path, text: str, reason: str) -> None:
    source = written(tmp_path, "bad.xosc", text)
    result = command("import", source, "-o", tmp_path / "out")
    assert result.return_value == 4
    assert reason in result.output
    line, column = result.output.split("bad.xosc:")[1].split(":")[:2]
    assert int(line) >= 1
    assert int(column) >= 1


def test_a_range_of_too_many_values(project: Path) -> None:
    text = DISTRIBUTIONS.format(DETERMINISTIC).replace('stepWidth="2"', 'stepWidth="1e-9"')
    (refused,) = Batch(Folders()).run([written(project, "values.xosc", text)])
    assert isinstance(refused, Refused)
    assert "a range of" in refused.reason
    assert refused.place is not None


def test_folders_above_without_version_control(tmp_path: Path) -> None:
    """Three above the document, as libraries have their maps."""
    folder = tmp_path / "a" / "b" / "c"
    folder.mkdir(parents=True)
    reach = Reach(folder)
    assert reach.holds(tmp_path / "maps" / "x.xodr")
    assert not reach.holds(tmp_path.parent / "x.xodr")


ODD = ["", "abc", "${1 / 0}", "INF", "9" * 400]


@pytest.mark.parametrize("odd", ODD)
def test_odd_values_are_refused_or_reported(odd: str) -> None:
    """Whatever an attribute holds: a scenario, or a reason."""
    root = ET.fromstring(document(EVENTS, parameters=WITH_PARAMETER, ego_speed="$v"))
    for element in root.iter():
        for name, value in list(element.attrib.items()):
            element.attrib[name] = odd
            try:
                import_document(ET.tostring(root), "odd.xosc", Library())
            except Refused as error:
                assert error.reason
            element.attrib[name] = value
