"""Weather, traffic lights, trailers, and documents in the coordinates of CARLA."""

from pathlib import Path

from osc2tx.importing.document import Folders
from osc2tx.importing.importer import import_document
from osc2tx.importing.libraries import Library
from osc2tx.importing.substitution import is_of_carla, mirrored
from osc2tx.xosc import read
from tests.importing.documents import at_time, document, event, faults, imported

ENVIRONMENT = """<GlobalAction><EnvironmentAction><Environment name="storm">
  <Weather cloudState="free" temperature="293.15"><Wind direction="0" speed="10"/>
  <Precipitation precipitationType="rain" precipitationIntensity="5"/></Weather>
  <RoadCondition frictionScaleFactor="{}"/></Environment></EnvironmentAction></GlobalAction>"""
LIGHT = """<GlobalAction><InfrastructureAction><TrafficSignalAction>
  <TrafficSignalStateAction name="{}" state="{}"/></TrafficSignalAction></InfrastructureAction>
  </GlobalAction>"""


def with_global(action: str) -> str:
    """Return a document with a global action in `Init`."""
    return document("").replace("<Init><Actions>", f"<Init><Actions>{action}")


def reasons(text: str) -> list[str]:
    return [each.reason for each in imported(text).report.findings]


def test_the_weather_is_that_of_the_document() -> None:
    """Wind towards the east comes from the west; rain alone makes the road wet."""
    found = imported(with_global(ENVIRONMENT.format("0.6")))
    for call in (
        "clouds(cloudiness: 0)",
        "air(temperature: 20celsius)",
        "wind(speed: 10mps, direction: 270deg)",
        "rain(intensity: 5mmph)",
    ):
        assert f"env.{call}" in found.text
    assert faults(found) == []
    assert not found.report.findings


def test_an_environment_of_a_catalog_is_a_scenario_of_its_library(tmp_path: Path) -> None:
    """Documents share it; other values of its parameters make another one. `rain` is taken."""
    reference = """<GlobalAction><EnvironmentAction><CatalogReference catalogName="Skies"
      entryName="Rain"><ParameterAssignments>{}</ParameterAssignments></CatalogReference>
      </EnvironmentAction></GlobalAction>"""
    cold = '<ParameterAssignment parameterRef="kelvin" value="263.15"/>'
    (tmp_path / "Skies.xosc").write_text(
        """<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="" description="" author=""/>
        <Catalog name="Skies"><Environment name="Rain"><ParameterDeclarations>
        <ParameterDeclaration name="kelvin" parameterType="double" value="293.15"/>
        </ParameterDeclarations><Weather cloudState="free" temperature="$kelvin"/></Environment>
        </Catalog></OpenSCENARIO>"""
    )
    library = Library()
    texts = [
        import_document(
            with_global(reference.format(given)).encode(),
            "document.xosc",
            library,
            folders=Folders(catalogs=(tmp_path,)),
        ).text
        for given in ("", cold, "")
    ]
    calls = [line.strip() for text in texts for line in text.splitlines() if "env." in line]
    assert calls == ["env.rain_2()", "env.rain_3()", "env.rain_2()"]
    assert library.text.count("clouds(cloudiness: 0)") == 2
    assert "air(temperature: -10celsius)" in library.text


def test_friction_that_the_weather_does_not_give_is_reported() -> None:
    assert any("friction 0.3" in each for each in reasons(with_global(ENVIRONMENT.format("0.3"))))


def test_a_traffic_light_shows_what_the_document_says() -> None:
    text = with_global(LIGHT.format("101", "on;off;off"))
    found = imported(text.replace("highway.xodr", "urban_crossing.xodr"))
    assert (
        "lights.set_state(traffic_light: light_101, state: [is_on, is_off, is_off])" in found.text
    )


def test_states_that_a_traffic_light_cannot_show_are_left_out() -> None:
    text = with_global(LIGHT.format("101", "green")).replace("highway.xodr", "urban_crossing.xodr")
    assert any("have no state `green`" in each for each in reasons(text))
    text = text.replace('name="101"', 'name="999"')
    assert any("no traffic light 999" in each for each in reasons(text))


def test_trailers_are_coupled_and_let_go() -> None:
    action = "<TrailerAction><{}/></TrailerAction>"
    events = event("Couple", action.format('ConnectTrailerAction trailerRef="ego"'), at_time("1"))
    events += event("Go", action.format("DisconnectTrailerAction"), at_time("2"))
    text = document(events).replace('vehicleCategory="car"', 'vehicleCategory="trailer"', 1)
    found = imported(text)
    assert "ego: trailer with:" in found.text
    assert "other.connect_trailer(trailer: ego)" in found.text
    assert "other.disconnect_trailer()" in found.text
    assert faults(found) == []


def test_world_positions_of_documents_of_carla_are_mirrored() -> None:
    """ScenarioRunner reads them so where the description begins with `CARLA:`."""
    place = '<WorldPosition x="10" y="4.5" z="0" h="0.5"/><WorldPosition x="10" y="$y" z="0"/>'
    root = read(
        '<OpenSCENARIO><FileHeader revMajor="1" revMinor="0" description="CARLA:Test"/>'
        f"<Storyboard>{place}</Storyboard></OpenSCENARIO>".encode()
    )
    assert is_of_carla(root)
    first, second = mirrored(root).children[1].children
    assert (first.get("x"), first.get("y"), first.get("h")) == ("10", "-4.5", "-0.5")
    assert second.get("y") == "${0 - ($y)}"
