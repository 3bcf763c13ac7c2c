"""What reports say that would help is of use for the chosen tool."""

import pytest

from osc2tx.losses.entries import Remedy
from osc2tx.options import XmlOptions, XmlProfile
from osc2tx.xosc.profiles import PROFILES, ToolProfile
from tests.unit.backends.xosc.documents import compiled, documents
from tests.xosc.test_parity import SCENARIOS

NEWER = Remedy(version="1.1")
MOVING = Remedy(instead="`change_speed` is exact", asks=("SpeedActionDynamics",))


@pytest.mark.parametrize("tool", PROFILES.values(), ids=PROFILES)
def test_a_version_is_one_that_the_tool_reads(tool: ToolProfile) -> None:
    words = str(NEWER.with_tool(tool))
    if "1.1" in tool.versions:
        assert words == "OpenSCENARIO XML 1.1"
    else:
        assert words == "OpenSCENARIO XML 1.1 in profile generic"


def test_nothing_is_called_exact_that_the_tool_carries_out_in_another_way() -> None:
    assert MOVING.with_tool(PROFILES["esmini"]) == MOVING
    assert MOVING.with_tool(PROFILES["scenario_runner"]).instead == ""


@pytest.mark.parametrize("profile", PROFILES)
def test_a_gap_that_is_there_has_nothing_to_close(profile: XmlProfile) -> None:
    path = SCENARIOS / "capabilities" / "C14_space_gap.osc"
    options = XmlOptions(version="1.0", profile=profile)
    (document,) = documents(compiled(path), options)
    kept = [e for e in document.report.losses if e.construct == "action keep_space_gap"]
    laws = {  # of the tools: a played document shows what they make of it
        "scenario_runner": [
            "scenario_runner controls no gap; it gets the speed of leader in each step"
        ],
        "esmini": ["it fits at once to each change of a speed, and to boxes that turn"],
    }
    assert [e.reason for e in kept] == laws.get(profile, [])
    assert all("`drive" not in str(e.help) for e in kept)
