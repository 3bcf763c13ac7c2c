"""OpenSCENARIO XML 1.4: what it says that older versions fold or leave out."""

import tomllib
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, Standard, XmlOptions, XmlVersion
from tests.unit.backends.xosc.checks import schema_errors
from tests.unit.backends.xosc.deprecations import deprecated
from tests.unit.backends.xosc.documents import documents
from tests.unit.xosc.schemas import TOOL

NEW = tomllib.loads(TOOL.with_name("xosc_1_4.toml").read_text(encoding="utf-8"))

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes

scenario main:
"""

ACTOR = """\
    ego: vehicle with:
        keep({keep})
    do ego.assign_speed(speed: 10mps)
"""

# Names of the DSL (§8.7.16 of 2.2, and what 2.1 has instead) and of XML 1.4, word for word.
CATEGORIES = {
    "car": "car",
    "van": "van",
    "bus": "bus",
    "heavy_truck": "heavyTruck",
    "semi_tractor": "semitractor",
    "trailer": "trailer",
    "semi_trailer": "semitrailer",
    "motorcycle": "motorcycle",
    "bicycle": "bicycle",
    "stand_up_scooter": "standupScooter",
    "micro_mobility_device": "micromobilityDevice",
    "wheelchair": "wheelchair",
    "train": "train",
    "tram": "tram",
    "work_machine": "workMachine",
    "watercraft": "watercraft",
    "aircraft": "aircraft",
    "land_vehicle": "landVehicle",
    "other": "other",
}
ROLES = {
    "civil": "civil",
    "ambulance": "ambulance",
    "fire_brigade": "fireBrigade",
    "military": "military",
    "police": "police",
    "public_transport": "publicTransport",
    "roadside_assistance": "roadsideAssistance",
    "garbage_collection": "garbageCollection",
    "construction": "construction",
    "other": "other",
    "freight_transport": "freightTransport",
    "special_transport": "specialTransport",
    "dangerous_goods_transport": "dangerousGoodsTransport",
    "agriculture": "agriculture",
    "traffic_control": "trafficControl",
}


def written(
    folder: Path, text: str, version: XmlVersion, standard: Standard = "2.2"
) -> XmlScenario:
    path = folder / "main.osc"
    path.write_text(HEAD + text, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions(standard=standard))
    (document,) = documents(compilation, XmlOptions(version=version))
    return document


def attributes(document: XmlScenario, tag: str, name: str) -> list[str | None]:
    assert document.xml is not None, document.report.obstacles
    assert schema_errors(document.xml, "1.4") == []
    return [node.get(name) for node in etree.fromstring(document.xml.encode()).iter(tag)]


@pytest.mark.parametrize("category", CATEGORIES)
def test_categories_have_their_own_literals(category: str, tmp_path: Path) -> None:
    text = ACTOR.format(keep=f"it.vehicle_category == {category}")
    found = attributes(written(tmp_path, text, "1.4"), "Vehicle", "vehicleCategory")
    assert found == [CATEGORIES[category]]


@pytest.mark.parametrize("role", ROLES)
def test_roles_have_their_own_literals(role: str, tmp_path: Path) -> None:
    text = ACTOR.format(keep=f"it.role == {role}")
    document = written(tmp_path, text, "1.4")
    assert attributes(document, "Vehicle", "role") == [ROLES[role]]
    assert attributes(document, "Property", "name") == ["source"]


def test_the_tables_have_all_new_literals() -> None:
    assert set(NEW["literals"]["VehicleCategory"]) <= set(CATEGORIES.values())
    assert set(NEW["literals"]["Role"]) <= set(ROLES.values())


def test_literals_that_it_deprecates_are_those_of_older_versions(tmp_path: Path) -> None:
    text = ACTOR.format(keep="it.vehicle_category == motorcycle").replace(
        "    do ", "        keep(it.role == fire_brigade)\n    do "
    )
    older, newest = (written(tmp_path, text, version).xml for version in ("1.3", "1.4"))
    assert older is not None and newest is not None
    assert deprecated(older, "1.4") == {"VehicleCategory motorbike", "Role fire"}
    assert deprecated(older, "1.3") == deprecated(newest, "1.4") == set()


@pytest.mark.parametrize(
    ("keep", "tag", "name", "literal"),
    [
        ("it.vehicle_category == truck", "Vehicle", "vehicleCategory", "heavyTruck"),
        ("it.vehicle_category == vru_vehicle", "Vehicle", "vehicleCategory", "micromobilityDevice"),
        ("it.role == fire", "Vehicle", "role", "fireBrigade"),
        ("it.role == road_assistance", "Vehicle", "role", "roadsideAssistance"),
        ("it.role == road_construction", "Vehicle", "role", "construction"),
    ],
)
def test_names_of_2_1_mean_those_of_2_2(
    keep: str, tag: str, name: str, literal: str, tmp_path: Path
) -> None:
    document = written(tmp_path, ACTOR.format(keep=keep), "1.4", "2.1")
    assert attributes(document, tag, name) == [literal]


def test_what_older_versions_fold_has_the_newest_as_its_remedy(tmp_path: Path) -> None:
    for category in ("semi_tractor", "watercraft"):
        text = ACTOR.format(keep=f"it.vehicle_category == {category}")
        document = written(tmp_path, text, "1.3")
        assert document.xml is None
        (obstacle,) = document.report.obstacles
        assert obstacle.remedy.version == "1.4", obstacle.reason


LIGHTS = """\
    road: map with:
        keep(it.map_file == "urban_crossing.xodr")
    lights: traffic_light_controller
    east: traffic_light with:
        keep(it.map_id == "101")
    main_road: traffic_light_group with:
        keep(it.map_id == "1")
{phases}
    round: traffic_light_cycle with:
        keep(it.phases == [{names}])
    do lights.play_cycles(cycles: [round])
"""

PHASE = """\
    phase_{name}: traffic_light_phase with:
        keep(it.group == main_road)
        keep(it.bulbs_state == east.semantic_state_to_state({name}))
        keep(it.duration == 3s)
"""

# Meanings of §8.15.3.1 and those of XML 1.4, by what the texts of both say traffic has to do.
MEANINGS = {
    "off": "fallback",
    "stop": "stop",
    "attention": "attention_go",
    "caution": "caution",
    "stop_attention": "attention_stop",
    "go": "go",
}


def test_phases_say_what_they_mean(tmp_path: Path) -> None:
    phases = "".join(PHASE.format(name=name) for name in MEANINGS)
    text = LIGHTS.format(phases=phases, names=", ".join(f"phase_{name}" for name in MEANINGS))
    document = written(tmp_path, text, "1.4")
    assert attributes(document, "Phase", "semantics") == list(MEANINGS.values())
    assert "semantics" not in (written(tmp_path, text, "1.3").xml or "semantics")
