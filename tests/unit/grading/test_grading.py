"""Documents that do not what their reports state: what grading makes of them."""

import json
from collections.abc import Callable
from dataclasses import replace as changed
from pathlib import Path

import pytest

from osc2tx.backends.py_trees import emit
from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.grading import Source, graded
from osc2tx.losses.bounds import Metres
from osc2tx.losses.entries import Grade
from osc2tx.options import CompileOptions, OneOfPolicy, Target, XmlOptions
from osc2tx.support.records import Records
from osc2tx_shared.map_files import SHIPPED

TEXT = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    v: speed with:
        keep(it in [10mps..20mps])
    ego, other: vehicle

    do parallel:
        ego.drive(duration: 4s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(v)
        serial:
            other.drive(duration: 2s) with:
                lane(3, at: start)
                position(100m, at: start)
                speed(15mps)
            slower: other.change_speed(target: 5mps, rate_profile: constant, rate_peak: 5mpss)
"""
UNREACHABLE_AT_A_CORNER = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    v: speed with:
        keep(it in [12mps..36mps])
    ego: vehicle

    do ego.drive(duration: 2s) with:
        lane(2, at: start)
        position(100m, at: start)
        speed(10mps, at: start)
        speed(v, at: end)
"""
GOLDEN = Path(__file__).parents[2] / "golden" / "xosc"

Change = Callable[[str], str]


def grade(
    folder: Path,
    change: Change = lambda xml: xml,
    *,
    text: str = TEXT,
    target: Target = "xosc",
    bound: Metres | None = None,
    findings: Records | None = None,
    one_of: OneOfPolicy = "race",
    **xml: bool,
) -> tuple[XmlScenario, Compilation]:
    """Return a document that was changed after it was written, graded; and its compilation."""
    path = folder / "top.osc"
    path.write_text(text, encoding="utf-8")
    options = CompileOptions(target=target, xml=XmlOptions(**xml), one_of=one_of)
    compilation = Compilation(path, path.name, options)
    assert compilation.check(), compilation.diagnostics
    (found,) = compilation.xml
    assert found.xml is not None
    if bound is not None:
        entry = found.report.entries[0]
        found.report.approximate("action drive", entry.span, "it is a test", bound)
    found = changed(found, xml=change(found.xml))
    assert compilation.ir is not None
    module = compilation.ir
    source = Source(module, options, folder, lambda: emit(module), findings)
    (result,) = graded([found], source, compilation.sink)
    return result, compilation


def brakes_harder(xml: str) -> str:
    assert 'dynamicsShape="linear" value="2"' in xml
    return xml.replace('dynamicsShape="linear" value="2"', 'dynamicsShape="linear" value="1.25"')


def codes(compilation: Compilation) -> list[str]:
    return [each.code for each in compilation.diagnostics]


@pytest.mark.parametrize("values", ["[10mps..20mps]", "[40kph..70kph]"])
def test_what_is_right_stays_exact_at_all_corners(values: str, tmp_path: Path) -> None:
    found, compilation = grade(tmp_path, text=TEXT.replace("[10mps..20mps]", values))
    assert found.xml is not None and found.report_json is None
    assert found.report.measured is not None
    assert found.report.measured.runs == 3
    assert set(found.report.measured.values().values()) == {0.0}
    assert codes(compilation) == []


def test_a_corner_that_fails_is_stated(tmp_path: Path) -> None:
    """From 10 m/s no tyres reach 36 m/s in 2 s; the other runs succeed."""
    found, compilation = grade(tmp_path, text=UNREACHABLE_AT_A_CORNER)
    assert found.report.measured is not None and found.report_json is not None
    assert found.report.measured.runs == 4
    (reason,) = found.report.measured.omitted
    assert reason.startswith("the run in the world fails: ")
    assert json.loads(found.report_json)["measured"]["omitted"] == [reason]
    assert codes(compilation) == []


def test_a_lie_is_no_document(tmp_path: Path) -> None:
    """It brakes from 15 to 5 m/s in 1.25 s instead of 2 s: 5 m/s less on average, for 0.75 s."""
    found, compilation = grade(tmp_path, brakes_harder)
    assert found.xml is None and found.parameters is None
    (entry,) = found.report.losses
    assert (entry.construct, entry.span.line) == ("action change_speed", 22)
    assert entry.grade is Grade.APPROXIMATED
    assert "measured: at most 3.8 m" in str(entry.bound)
    assert codes(compilation) == ["OSC518"]
    (report,) = compilation.diagnostics
    assert "`other` is" in "".join(report.notes)


def test_where_xml_is_a_by_product_a_lie_is_left_out(tmp_path: Path) -> None:
    found, compilation = grade(tmp_path, brakes_harder, target="all")
    assert found.xml is None and codes(compilation) == []


def test_an_accepted_deviation_is_written_with_its_number(tmp_path: Path) -> None:
    found, compilation = grade(tmp_path, brakes_harder, allow_approx=True)
    assert found.xml is not None and codes(compilation) == []
    assert found.report_json is not None
    report = json.loads(found.report_json)
    assert report["measured"]["place"] == 3.8
    assert report["measured"]["runs"] == 3
    assert "measured: at most 3.8 m" in report["losses"][0]["bound"]


@pytest.mark.parametrize(("most", "is_enough"), [(4.0, True), (3.0, False)])
def test_stated_bounds_are_kept_or_an_error(tmp_path: Path, most: float, is_enough: bool) -> None:
    found, compilation = grade(tmp_path, brakes_harder, bound=Metres(most), allow_approx=True)
    assert (found.xml is not None) is is_enough
    assert codes(compilation) == [] if is_enough else ["OSC518"]
    if not is_enough:
        assert any(entry.grade is Grade.INEXPRESSIBLE for entry in found.report.losses)


def test_a_map_that_is_gone_leaves_no_evidence(tmp_path: Path) -> None:
    place = tmp_path / "own.xodr"
    place.write_bytes((SHIPPED / "highway.xodr").read_bytes())

    def loses_its_map(xml: str) -> str:
        place.unlink()
        return brakes_harder(xml)

    found, _ = grade(tmp_path, loses_its_map, text=TEXT.replace("highway.xodr", "own.xodr"))
    assert found.xml is not None
    assert found.report.measured is None
    assert found.report_json is not None
    assert json.loads(found.report_json)["unmeasured"] == "there is no map own.xodr"


def test_grades_are_the_same_in_every_run(tmp_path: Path) -> None:
    reports = {grade(tmp_path, brakes_harder, allow_approx=True)[0].report_json for _ in range(2)}
    assert len(reports) == 1


@pytest.mark.parametrize(
    ("case", "reason"),
    [
        ("own_actions", "actions come from packages of users"),
        ("endless", "the run in the world fails: ego.drive(speed(20 * mps)) failed at 97.750 s"),
    ],
)
def test_what_a_run_cannot_show_is_said_without_lines(case: str, reason: str) -> None:
    path = GOLDEN / case / "input.osc"
    compilation = Compilation(path, path.name, CompileOptions(xml=XmlOptions(allow_approx=True)))
    (found,) = compilation.graded_xml
    assert found.xml is not None
    assert found.report.unmeasured.startswith(reason)


def test_a_run_that_never_ends_counts_up_to_its_last_action(tmp_path: Path) -> None:
    """Behind it, the world brakes for the end of the road, of which the standard says nothing."""
    waits = TEXT.replace("keep(it in [10mps..20mps])", "keep(it == 15mps)")
    found, _ = grade(tmp_path, text=waits + "            wait other.speed > 50mps\n")
    assert found.xml is not None
    assert found.report.obstacles == ()


TAKES_OVER = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle

    do serial:
        ego.change_speed(target: 20mps, rate_profile: constant, rate_peak: 2mpss) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(AT_FIRST, at: start)
        ego.drive(duration: 2s) with:
            acceleration(RATE)
        ego.change_speed(target: 30mps)
        ego.drive(duration: 2s)
"""
"""The last change begins with the acceleration before, which the XML cannot say."""


def taking_over(
    folder: Path, rate: str, *, verify: bool = True, allow: bool = False
) -> Compilation:
    path = folder / "top.osc"
    text = TAKES_OVER.replace("RATE", rate).replace("AT_FIRST", "18mps")
    path.write_text(text, encoding="utf-8")
    xml = XmlOptions(version="1.2", allow_approx=allow, verify=verify)
    compilation = Compilation(path, path.name, CompileOptions(target="xosc", xml=xml))
    assert compilation.check(), compilation.diagnostics
    return compilation


def test_a_doubt_is_exact_where_the_run_shows_no_deviation(tmp_path: Path) -> None:
    compilation = taking_over(tmp_path, "0.05mpss")
    (written,) = compilation.xml
    assert any(entry.is_open for entry in written.report.entries)
    (found,) = compilation.graded_xml
    assert found.xml is not None and found.report.losses == ()
    assert codes(compilation) == []


def test_a_doubt_that_the_run_confirms_is_approximated_as_measured(tmp_path: Path) -> None:
    compilation = taking_over(tmp_path, "2mpss")
    (found,) = compilation.graded_xml
    assert found.xml is None and codes(compilation) == ["OSC515"]
    (entry,) = found.report.losses
    assert entry.reason.startswith("it takes over the acceleration of the change before")
    assert str(entry.bound).startswith("measured: at most")
    (allowed,) = taking_over(tmp_path, "2mpss", allow=True).graded_xml
    assert allowed.xml is not None
    assert [each.bound for each in allowed.report.losses] == [entry.bound]


@pytest.mark.parametrize("allow", [True, False])
def test_a_doubt_about_a_document_that_is_not_played_stays(tmp_path: Path, allow: bool) -> None:
    compilation = taking_over(tmp_path, "0.05mpss", verify=False, allow=allow)
    (found,) = compilation.graded_xml
    assert (found.xml is not None) is allow
    (entry,) = found.report.losses
    assert entry.bound == "not measured: `--no-verify`"
    assert codes(compilation) == ([] if allow else ["OSC515"])


def test_a_document_that_is_not_played_says_so(tmp_path: Path) -> None:
    path = tmp_path / "top.osc"
    path.write_text(TEXT, encoding="utf-8")
    options = CompileOptions(xml=XmlOptions(verify=False))
    (found,) = Compilation(path, path.name, options).graded_xml
    assert found.xml is not None and found.report_json is not None
    report = json.loads(found.report_json)
    assert report["unmeasured"] == "`--no-verify`" and report["losses"] == []


DRAWN = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle

    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(15mps)
        ego.change_lane(num_of_lanes: 1, duration: 4s)
"""


CHOSEN = DRAWN[: DRAWN.index("        ego.change_lane")] + """\
        one_of:
            ego.change_lane(side: left, duration: 4s)
            ego.change_speed(target: 24mps, rate_profile: smooth, duration: 3s)
"""


@pytest.mark.parametrize("text", [DRAWN, CHOSEN], ids=["side", "branch"])
def test_what_the_world_draws_is_one_of_the_values_of_the_document(
    text: str, tmp_path: Path
) -> None:
    found, compilation = grade(tmp_path, text=text, one_of="seeded")
    assert found.xml is not None and found.parameters is not None
    assert codes(compilation) == []


CUT_WHILE_FASTER = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle

    do serial:
        one_of:
            ego.change_speed(target: 30mps, rate_profile: constant, rate_peak: 2mpss) with:
                lane(2, at: start)
                position(50m, at: start)
                speed(20mps, at: start)
            wait elapsed(3s)
        ego.change_lane(num_of_lanes: 1, side: left, duration: 4s)
"""


def test_a_deviation_that_shrinks_with_the_steps_is_the_delay_of_an_event(tmp_path: Path) -> None:
    """A change that is cut short a step late leaves another speed, which lasts."""
    found, compilation = grade(tmp_path, text=CUT_WHILE_FASTER)
    assert found.xml is not None and codes(compilation) == []


OFF_THE_ROAD = TEXT.replace("highway.xodr", "crossing.xodr").replace(
    TEXT[TEXT.index("    v: speed") :],
    """\
    ego, other: vehicle

    do parallel:
        short: ego.drive(duration: 2s) with:
            lane(1, at: start)
            position(400m, at: start)
            speed(20mps, at: start)
        other.drive(duration: 9s) with:
            lane(1, at: start)
            position(60m, at: start)
            speed(20mps, at: start)
""",
)


def test_an_actor_beyond_the_end_of_its_road_is_not_exact(tmp_path: Path) -> None:
    """It is at 500 m after 5 s; 4 s later the world has it braking behind it, and tools do not."""
    found, compilation = grade(tmp_path, text=OFF_THE_ROAD, allow_approx=True)
    assert found.xml is not None and codes(compilation) == []
    (entry,) = found.report.losses
    assert entry.grade is Grade.APPROXIMATED and "its road ends" in entry.reason
    refused, compilation = grade(tmp_path, text=OFF_THE_ROAD)
    assert refused.xml is None and codes(compilation) == ["OSC518"]
