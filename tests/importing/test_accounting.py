"""Nothing of a document is lost unseen: what changes in it changes the scenario or the report."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from osc2tx.cli.import_settings import write_settings
from osc2tx.importing.batch import Batch
from osc2tx.importing.document import Folders, Refused
from osc2tx.importing.importer import import_document
from osc2tx.importing.libraries import Library
from tests.importing.documents import (
    CAR,
    after,
    at_time,
    document,
    event,
    imported,
    lane_change,
    speed_change,
)
from tests.importing.test_conditions import collision_time
from tests.importing.test_trajectories import CURVE, TIMED, TIMELESS, beside, corners, follow

EVENTS = event("One", speed_change("20"), at_time("1")) + event(
    "Two", lane_change(-1), after("One")
)
WITH_PARAMETER = '<ParameterDeclaration name="v" parameterType="double" value="20"/>'
OTHER = {"true": "false", "false": "true", "0": "7"}


def _product(text: str) -> object:
    try:
        found = imported(text)
    except Refused as error:
        return error.reason
    report = found.report.to_json()
    return found.text, report


def _product_of(root: ET.Element) -> object:
    return _product(ET.tostring(root, encoding="unicode"))


def silent(root: ET.Element, product: Callable[[], object]) -> list[str]:
    """Return the attributes and elements of which a change, or a lack, changes no product."""
    before = product()
    found = []
    for element in root.iter():
        for name, value in list(element.attrib.items()):
            element.attrib[name] = OTHER.get(value, f"{value}9")
            if product() == before:
                found.append(f"{element.tag}/@{name}={value}")
            del element.attrib[name]
            if product() == before and (name, value) != ("offset", "0"):  # which is its default
                found.append(f"{element.tag}/@{name} left out")
            element.attrib[name] = value
    for parent in list(root.iter()):
        for index, child in enumerate(list(parent)):
            if not child.attrib and not list(child):
                continue  # an empty element says nothing
            parent.remove(child)
            if product() == before:
                found.append(f"{parent.tag}/{child.tag}")
            parent.insert(index, child)
    return found


def test_all_of_a_document_counts() -> None:
    root = ET.fromstring(document(EVENTS, parameters=WITH_PARAMETER, ego_speed="$v"))
    assert not silent(root, lambda: _product(ET.tostring(root, encoding="unicode")))


def test_all_of_a_trajectory_counts() -> None:
    """Of the first times and distances a lack is their default, 0."""
    places = (beside("other", 0, 0), beside("other", 45, 0), beside("other", 75, 3.5))
    for shape, timing in (
        (corners(*places), TIMELESS),
        (corners(*places, times=(3.0, 5.0, 6.0)), TIMED.format("absolute")),
        (CURVE, TIMELESS),
    ):
        root = ET.fromstring(document(event("Follow", follow(shape, timing), at_time("3"))))
        found = silent(root, partial(_product_of, root))
        assert [each for each in found if not each.endswith(" left out")] == []


@pytest.mark.parametrize("rule", ["zzz", "lessthan"])
def test_words_that_the_standard_does_not_have_are_told_with_their_place(rule: str) -> None:
    text = document(
        event("Brake", speed_change("5"), collision_time('<EntityRef entityRef="ego"/>'))
    )
    found = imported(text.replace('rule="lessThan"', f'rule="{rule}"'))
    (reason,) = [each for each in found.report.findings if "rule" in each.reason]
    assert reason.grade == "left out" and reason.place is not None
    assert f"rule has no value '{rule}'" == reason.reason


CATALOGS = {
    "vehicles": f"<Catalog name='vehicles'>{CAR}</Catalog>",
    "maneuvers": f"""<Catalog name="maneuvers"><Maneuver name="speed_up">
      <ParameterDeclarations><ParameterDeclaration name="goal" parameterType="double" value="18"/>
      </ParameterDeclarations>
      {event("Faster", speed_change("$goal"), at_time("1"))}</Maneuver></Catalog>""",
    "controllers": """<Catalog name="controllers"><Controller name="pilot"><Properties>
      <Property name="gain" value="3"/></Properties></Controller></Catalog>""",
}
HEADER = (
    '<FileHeader revMajor="1" revMinor="3" date="2024-01-01T00:00:00" description="" author=""/>'
)


def _reference(catalog: str, entry: str, given: str = "") -> str:
    return (
        f'<CatalogReference catalogName="{catalog}" entryName="{entry}">{given}</CatalogReference>'
    )


def _with_catalogs() -> str:
    """Return a document of which the parts are in catalogs."""
    goal = '<ParameterAssignment parameterRef="goal" value="19"/>'
    maneuver = _reference(
        "maneuvers", "speed_up", f"<ParameterAssignments>{goal}</ParameterAssignments>"
    )
    text = document(event("One", speed_change("20"), at_time("1")))
    start, end = text.index('<Maneuver name="Maneuver">'), text.index("</Maneuver>") + 11
    text = text[:start] + maneuver + text[end:]
    controller = f"<ObjectController>{_reference('controllers', 'pilot')}</ObjectController>"
    text = text.replace(CAR, _reference("vehicles", "car") + controller, 1)
    kinds = {"Vehicle": "vehicles", "Maneuver": "maneuvers", "Controller": "controllers"}
    places = "".join(
        f'<{kind}Catalog><Directory path="{folder}"/></{kind}Catalog>'
        for kind, folder in kinds.items()
    )
    return text.replace("<CatalogLocations/>", f"<CatalogLocations>{places}</CatalogLocations>")


def _files(folder: Path) -> dict[str, ET.Element]:
    """Write the document with its catalogs; return the roots of all of them by their paths."""
    texts = {"main.xosc": _with_catalogs()}
    for name, text in CATALOGS.items():
        (folder / name).mkdir()
        texts[f"{name}/all.xosc"] = f"<OpenSCENARIO>{HEADER}{text}</OpenSCENARIO>"
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return {name: ET.fromstring(text) for name, text in texts.items()}


@pytest.mark.parametrize("name", ["main.xosc", *(f"{each}/all.xosc" for each in CATALOGS)])
def test_all_of_a_document_with_catalogs_counts(name: str, tmp_path: Path) -> None:
    root = _files(tmp_path)[name]
    main = tmp_path / "main.xosc"

    def product() -> object:
        (tmp_path / name).write_bytes(ET.tostring(root))
        library = Library()
        try:
            found = import_document(main.read_bytes(), "main.xosc", library, path=main)
        except Refused as error:
            return error.reason
        return found.text, found.report.to_json(), library.text

    catalog = root.find("Catalog")
    assert not silent(root if catalog is None else catalog, product)


def test_an_entry_of_a_catalog_is_reported_once(tmp_path: Path) -> None:
    _files(tmp_path)
    main = tmp_path / "main.xosc"
    library = Library()
    first, second = (
        import_document(main.read_bytes(), "main.xosc", library, path=main) for _ in range(2)
    )
    assert first.text == second.text
    assert first.report.grade == "exact" == second.report.grade, second.report.findings


DISTRIBUTIONS = """<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="2024-01-01T00:00:00"
  description="" author=""/><ParameterValueDistribution><ScenarioFile filepath="two_cars.xosc"/>
  {}</ParameterValueDistribution></OpenSCENARIO>"""
DETERMINISTIC = """<Deterministic>
  <DeterministicSingleParameterDistribution parameterName="v"><DistributionRange stepWidth="2">
  <Range lowerLimit="10" upperLimit="20"/></DistributionRange>
  </DeterministicSingleParameterDistribution>
  <DeterministicMultiParameterDistribution><ValueSetDistribution>
  <ParameterValueSet><ParameterAssignment parameterRef="w" value="3"/></ParameterValueSet>
  <ParameterValueSet><ParameterAssignment parameterRef="w" value="4"/></ParameterValueSet>
  </ValueSetDistribution></DeterministicMultiParameterDistribution></Deterministic>"""
STOCHASTIC = """<Stochastic numberOfTestRuns="8" randomSeed="5">
  <StochasticDistribution parameterName="v"><NormalDistribution expectedValue="15" variance="2">
  <Range lowerLimit="10" upperLimit="20"/></NormalDistribution></StochasticDistribution>
  <StochasticDistribution parameterName="w"><ProbabilityDistributionSet>
  <Element value="3" weight="1"/><Element value="4" weight="2"/></ProbabilityDistributionSet>
  </StochasticDistribution></Stochastic>"""


@pytest.mark.parametrize("values", [DETERMINISTIC, STOCHASTIC], ids=["rows", "drawn"])
def test_all_of_a_document_with_distributions_counts(values: str, tmp_path: Path) -> None:
    parameter = WITH_PARAMETER + WITH_PARAMETER.replace('"v"', '"w"')
    text = document(EVENTS.replace('value="4"', 'value="$w"', 1), "", parameter, "$v")
    (tmp_path / "two_cars.xosc").write_text(text, encoding="utf-8")
    source = tmp_path / "values.xosc"
    root = ET.fromstring(DISTRIBUTIONS.format(values))

    def product() -> object:
        source.write_bytes(ET.tostring(root))
        found = []
        for each in Batch(Folders()).run([source]):
            if isinstance(each, Refused):
                return each.reason
            found.append(each)
        out = tmp_path / "out"
        out.mkdir(exist_ok=True)
        write_settings(found, out)
        written = {file.name: file.read_bytes() for file in sorted(out.iterdir())}
        for file in out.iterdir():
            file.unlink()
        reports = [(imported.text, imported.report.to_json()) for imported in found]
        return reports, written

    assert not silent(root, product)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("<OpenSCENARIO>", "no element found"),
        ("<a/>", "is no document"),
        ('<!DOCTYPE a [<!ENTITY x "y">]><OpenSCENARIO/>', "declares an entity"),
        ("<OpenSCENARIO><FileHeader/></OpenSCENARIO>", "no storyboard"),
        ("<OpenSCENARIO>" * 300, "deep"),
    ],
)
def test_others_are_refused(text: str, reason: str) -> None:
    with pytest.raises(Refused) as caught:
        import_document(text.encode(), "bad.xosc", Library())
    assert reason in caught.value.reason
    assert caught.value.place is not None


def test_unknown_parts_are_reported_with_their_place() -> None:
    text = document("").replace("<Init>", '<Init><Strange what="1"/>')
    findings = imported(text).report.findings
    assert [(each.grade, each.construct) for each in findings] == [("left out", "<Strange>")]
    assert findings[0].place is not None


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_encodings(encoding: str) -> None:
    text = document("").replace('<?xml version="1.0" encoding="UTF-8"?>', "").strip()
    found = import_document(text.encode(encoding), "test.xosc", Library(), name="two_cars")
    assert found.text == imported(text).text


def test_comments_are_kept() -> None:
    text = document(EVENTS.replace("<Action", "<!--Now it speeds up.--><Action", 1))
    assert "# Now it speeds up." in imported(text).text
