"""What vehicles can do, ends of roads, and the names of things."""

import json
import math

import pytest

from osc2tx.grading.comparison import Recording
from osc2tx.grading.imports import at_end_of_road
from osc2tx.grading.runs import Failed
from osc2tx.importing.endings import up_to_end
from osc2tx.importing.names import short, snake
from osc2tx.importing.report import ImportReport, Measured
from osc2tx.importing.statements import Statement, call, composed
from tests.importing.documents import at_time, document, event, imported, speed_change


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("NCAP_AEB_C2C_CCRs", "ncap_aeb_c2c_ccrs"),
        ("V2XMessage", "v2x_message"),
        ("CCRb_40m_2ms2", "cc_rb_40m_2ms2"),
        ("CutInVehicle_1", "cut_in_vehicle_1"),
        ("EgoSpeed50kph", "ego_speed50_kph"),
    ],
)
def test_names(said: str, name: str) -> None:
    assert snake(said) == name


def test_names_of_events_leave_out_that_they_are_events() -> None:
    assert short("BrakeEvent") == "brake"


def test_a_change_is_held_to_what_the_vehicle_can_do() -> None:
    """The car has at most 10 m/s^2: 15 m/s more take 1.5 s, not 1 s."""
    found = imported(document(event("Faster", speed_change("30", "1"), at_time("1"))))
    assert "other.change_speed(target: 30mps, rate_profile: constant, rate_peak: 10mpss)" in (
        " ".join(found.text.split()).replace("( ", "(").replace(" )", ")")
    )
    assert any("can do" in each.reason for each in found.report.findings)


def test_a_change_within_that_keeps_its_time() -> None:
    found = imported(document(event("Faster", speed_change("30", "2"), at_time("1"))))
    assert "duration: 2s" in found.text


def test_a_run_up_to_the_end_of_a_road_is_no_exact_one() -> None:
    report = ImportReport("a.xosc")
    report.measure(Measured(0.0, "ego", 0.0, 0.0, True, off_road="ego"))
    assert report.grade == "approximated"
    assert "end of its road" in report.findings[0].reason
    assert json.loads(report.to_json())["measured"]["until_end_of_road_of"] == "ego"


END = "ego.drive() failed at 5 s: {} has reached the end of lane -1 of road 2"
OFF = "ego.change_lane() failed at 5 s: {} is not on a road, so it has no lane"


@pytest.mark.parametrize(
    ("reason", "end", "x", "found"),
    [
        (END.format("ego"), 5.0, 100.0, "ego"),
        (END.format("ego"), 6.0, 100.0, ""),  # the player has it there later
        (END.format("ego"), 5.0, 80.0, ""),  # or elsewhere
        (END.format("other"), 5.0, 100.0, ""),
        (f"{END.format('ego')}; {END.format('other')}", 5.0, 100.0, ""),  # not all of them
        (OFF.format("ego"), 5.0, 100.0, "ego"),
        (OFF.format("ego"), 6.0, 100.0, ""),
        ("ego.drive() failed at 5 s: it is too fast", 5.0, 100.0, ""),
    ],
)
def test_an_end_of_a_road_is_told_by_reason_and_place(
    reason: str, end: float, x: float, found: str
) -> None:
    run = Recording(5.0, {}, {"ego": [(5.0, 100.2, 0.0, 20.0)], "other": [(5.0, 0.0, 0.0, 0.0)]})
    played = Recording(end, {}, {"Ego": [(end, x, 0.0, 20.0)]}, ends={"Ego": end})
    names = {"Ego": "ego", "Other": "other"}
    assert at_end_of_road(Failed(reason, run), played, names, 0.1) == found


def test_what_may_not_have_come_as_far_as_it_goes_on_ends_when_the_next_event_is_due() -> None:
    """A `parallel` would wait for the gap that is closed first."""
    close = Statement(call("other", "change_space_gap", target="5m"))
    keep = Statement(call("other", "keep_space_gap"), length=math.inf)
    gap = composed("serial", [close, keep])
    assert list(up_to_end(gap, 4.0).lines(0)) == [
        "serial:",
        "    other.change_space_gap(target: 5m)",
        "    other.keep_space_gap()",
        "with:",
        "    until elapsed(4s)",
    ]
    assert up_to_end(gap, None) is gap
    assert up_to_end(keep, 4.0) is keep
