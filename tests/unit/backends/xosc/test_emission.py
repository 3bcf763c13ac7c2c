"""What stands in documents for what only the run, or only the tool, knows."""

from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, XmlOptions, XmlProfile, XmlVersion

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario case:
    road: map with:
        keep(it.map_file == "{map}")
    ego: vehicle

    do serial:
        one_of:
            ego.drive() with:
                lane(2, at: start)
                position(50m, at: start)
                speed({start}kph, at: start)
                speed({wanted}kph)
            wait elapsed(3s)
        ego.change_speed(target: {target}kph, rate_profile: smooth)
"""


def document(
    folder: Path, *, version: XmlVersion = "1.3", profile: XmlProfile = "generic", **values: object
) -> etree._Element:
    """Return the document of a scenario with a change of the speed that may be cut short."""
    source = folder / "case.osc"
    given = {"map": "highway.xodr", "start": 50, "wanted": 90, "target": 70, **values}
    source.write_text(HEAD.format(**given), encoding="utf-8")
    module = Compilation(source, source.name, CompileOptions()).ir
    assert module is not None
    options = XmlOptions(version=version, profile=profile)
    (found,) = emit(module, options, folder)
    assert found.xml is not None, found.report.obstacles
    return etree.fromstring(found.xml.encode())


@pytest.mark.parametrize(
    ("wanted", "target", "rate"),
    [(90, 70, 3.6), (60, 70, 1.8), (70, 90, 1.8)],  # 90 % of half of 8 and of 4 m/s^2
)
def test_the_rate_is_that_towards_the_target_if_the_change_before_has_come_to_its_end(
    tmp_path: Path, wanted: int, target: int, rate: float
) -> None:
    root = document(tmp_path, wanted=wanted, target=target)
    (dynamics,) = root.iterfind(".//Event[@name='ego_change_speed']//SpeedActionDynamics")
    assert dynamics.get("dynamicsShape") == "sinusoidal"
    assert dynamics.get("dynamicsDimension") == "rate"
    assert float(dynamics.get("value", "nan")) == rate


def test_a_map_is_named_as_the_file_that_tools_open(tmp_path: Path) -> None:
    """`curve` finds `curve.xodr` here; tools look for a file of just the name that they read."""
    for name in ("curve", "curve.xodr"):
        (file,) = document(tmp_path, map=name).iter("LogicFile")
        assert file.get("filepath") == "curve.xodr"
