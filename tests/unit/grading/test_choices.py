"""Members of a `one_of` of which one is drawn (§7.3.13.3): parameters of the document."""

import re
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.losses.entries import Grade
from osc2tx.options import CompileOptions, OneOfPolicy, XmlOptions
from tests.unit.grading.test_grading import grade

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, other: vehicle

    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(10mps)
"""
ENDLESS = """\
        one_of:
            ego.drive()
            ego.drive(duration: 2s)
        ego.change_speed(target: 15mps, rate_profile: constant, rate_peak: 2mpsps)
"""
SPEEDS = """\
        {label}one_of:
            ego.drive(duration: 3s) with:
                speed({one}mps)
            ego.drive(duration: 3s) with:
                speed({other}mps)
        ego.drive(duration: 1s)
"""
PARTLY = """\
        one_of:
            ego.change_speed(target: 15mps, duration: 2s)
            ego.change_speed(target: 5mps, duration: 2s)
            wait elapsed(3s)
        ego.drive(duration: 1s)
"""


def graded(folder: Path, text: str, policy: OneOfPolicy) -> XmlScenario:
    path = folder / "top.osc"
    path.write_text(HEAD + text, encoding="utf-8")
    options = CompileOptions(one_of=policy, xml=XmlOptions(allow_approx=True))
    (found,) = Compilation(path, path.name, options).graded_xml
    return found


def test_what_follows_an_endless_first_member_is_not_dropped(tmp_path: Path) -> None:
    found = graded(tmp_path, ENDLESS, "first")
    assert found.xml is None
    (obstacle,) = found.report.obstacles
    assert "what follows would never start: every run fails" in obstacle.reason


def test_a_member_without_end_that_may_be_drawn_is_reported(tmp_path: Path) -> None:
    found = graded(tmp_path, ENDLESS, "seeded")
    (loss,) = found.report.losses
    assert loss.grade is Grade.APPROXIMATED and loss.construct == "one_of"
    assert loss.reason.startswith("a run fails that draws a member without end")


def test_a_race_that_others_win_needs_no_word(tmp_path: Path) -> None:
    race = ENDLESS.replace("ego.drive()", "other.drive()")
    assert not graded(tmp_path, race, "race").report.losses


@pytest.mark.parametrize("label", ["", "pick: "])
@pytest.mark.parametrize("policy", ["race", "seeded"])
def test_a_drawn_member_is_compared_with_its_own_run(
    label: str, policy: OneOfPolicy, tmp_path: Path
) -> None:
    """A document in which each value chooses the other member is not the same."""
    for one, other in ((14, 20), (20, 14)):
        text = HEAD + SPEEDS.format(label=label, one=one, other=other)
        found, _ = grade(tmp_path, text=text, one_of=policy)
        assert found.xml is not None
        assert {each.grade for each in found.report.entries} == {Grade.EXACT}
        wrong, compilation = grade(tmp_path, exchanged, text=text, one_of=policy)
        assert wrong.xml is None
        assert "OSC518" in {each.code for each in compilation.diagnostics}


def exchanged(document: str) -> str:
    """Return a document in which each value of its choice stands for the other member."""
    condition = r'(?<=<ParameterCondition )([^>]*value=")([^"]*)(?=")'
    one, other = dict.fromkeys(found[1] for found in re.findall(condition, document))
    return re.sub(condition, lambda found: found[1] + (other if found[2] == one else one), document)


def test_a_race_that_is_drawn_in_part_is_refused(tmp_path: Path) -> None:
    found = graded(tmp_path, PARTLY, "race")
    assert found.xml is None
    (obstacle,) = found.report.obstacles
    assert "a run draws one" in obstacle.reason
