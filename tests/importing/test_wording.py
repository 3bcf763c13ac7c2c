"""What a person would say in fewer words is said so, and has the same course."""

import pytest

from osc2tx.importing.expressions import Operation, parsed
from osc2tx.importing.importer import Imported
from osc2tx.importing.names import shortened
from osc2tx.importing.program import Declared
from osc2tx.importing.statements import Statement, call, comment_lines, composed, elapsed, wait
from osc2tx.importing.wording import worded
from tests.importing.documents import after, at_time, document, event, faults, imported
from tests.importing.documents import speed_change as change
from tests.importing.test_structure import apart

OFFSET = """<LateralAction><LaneOffsetAction continuous="false">
  <LaneOffsetActionDynamics dynamicsShape="sinusoidal" maxLateralAcc="1"/><LaneOffsetTarget>
  <AbsoluteTargetLaneOffset value="1"/></LaneOffsetTarget></LaneOffsetAction></LateralAction>
  """


def lines(found: Imported) -> list[str]:
    return [line.strip() for line in found.text.splitlines()]


def test_a_time_beside_what_goes_on_is_its_duration() -> None:
    found = imported(document("", end=at_time("3")))
    assert lines(found)[-3:] == [
        "parallel(duration: 3s):",
        "ego.keep_speed()",
        "other.keep_speed()",
    ]
    assert faults(found) == []
    assert apart(found) < 0.1


@pytest.mark.parametrize("long", [5.0, None])
def test_a_time_beside_what_may_last_longer_is_a_wait(long: float | None) -> None:
    open_ = Statement(call("ego", "keep_speed"), length=float("inf"))
    does = call("other", "change_speed", target="9mps", **({"duration": "5s"} if long else {}))
    whole = Statement("parallel", members=[open_, Statement(does), wait(elapsed("4s"))])
    assert worded(whole) == whole
    assert worded(composed("parallel", [open_, wait(elapsed("4s"))])) == Statement(
        call("ego", "keep_speed", duration="4s")
    )


def test_an_offset_that_stays_has_no_end_of_its_own() -> None:
    found = imported(document(event("Aside", OFFSET, at_time("1")), end=at_time("9")))
    offsets = [line for line in lines(found) if "follow_lane" in line]
    assert offsets == ["other.follow_lane(offset: 1m, rate_profile: smooth, rate_peak: 0.7071mps)"]
    assert faults(found) == []
    assert apart(found) < 0.1


def test_waits_that_follow_each_other_are_one() -> None:
    faster = event("Faster", change("20", "2"), at_time("1"))
    found = imported(document(faster, end=after("Faster", "2")))
    waits = [wait(elapsed("0.1s")), wait(elapsed("0.2s")), wait(elapsed("later"))]
    assert [each.text for each in worded(composed("serial", waits)).members] == [
        "wait elapsed(0.3s)",
        "wait elapsed(later)",
    ]
    assert apart(found) < 0.1


def test_a_speed_of_zero_at_the_start_says_nothing() -> None:
    still = imported(document("", ego_speed="0", end=at_time("2")))
    assert "ego.assign_speed" not in still.text
    assert faults(still) == []
    assert apart(still) < 0.1


@pytest.mark.parametrize(
    ("text", "sign"),
    [
        ("${-$a * $b}", "-"),
        ("${$a * (-$b)}", "-"),
        ("${-$a * $b * -1}", "*"),
        ("${1 * $a / -2}", "-"),
    ],
)
def test_the_sign_of_a_product_comes_first(text: str, sign: str) -> None:
    found = parsed(text)
    assert isinstance(found, Operation)
    assert found.sign == sign


SUMS = (
    '<ParameterDeclaration name="Gap" parameterType="double" value="4"/>'
    '<ParameterDeclaration name="Early" parameterType="double" value="{}"/>'
)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("${2 + $Gap + 3}", "5mps + gap"),
        ("${$Gap - 1 - 2}", "gap - 3mps"),
        ("${$Gap - ($Gap + 1)}", "gap - (gap + 1mps)"),
        ("${10 - $Gap - -2}", "12mps - gap"),
    ],
)
def test_numbers_of_an_expression_are_added_up(given: str, said: str) -> None:
    found = imported(document("", parameters=SUMS.format(given), ego_speed="$Early"))
    assert f"early: speed = {said}" in lines(found)
    assert apart(found) < 0.1


def test_long_names_of_parameters_lose_what_the_others_do_not_need() -> None:
    names = [
        "ego_init_speed_ve0",
        "cut_in_vehicle_relative_init_speed_ve0_vo0",
        "cut_in_vehicle_lane_change_max_lateral_velocity_vy",
        "lead_vehicle_init_position_longitudinal_offset",
        "cut_in_vehicle_init_position_longitudinal_offset",
    ]
    assert shortened(names, ["ego", "cut_in_vehicle", "lead_vehicle"]) == [
        "ego_init_speed_ve0",
        "cut_in_vehicle_relative_speed",
        "lane_change_max_lateral_velocity",
        "lead_vehicle_longitudinal_offset",
        "cut_in_vehicle_longitudinal_offset",
    ]
    alike = [f"cut_in_vehicle_{word}_longitudinal_offset" for word in ("init", "init_position")]
    assert shortened(alike, ["cut_in_vehicle"]) == alike  # both would have the same name


def test_comments_stand_behind_what_they_are_about() -> None:
    gap = Declared("gap", "length", ["it > 2m"], "6m", ["distance at the start", "more than 2 m"])
    assert gap.lines == [
        "gap: length = 6m with:  # distance at the start",
        "    keep(it > 2m)  # more than 2 m",
    ]


def test_lines_that_break_because_a_text_is_narrow_are_joined() -> None:
    narrow = (
        "A text whose lines end after some seventy characters, as in a mail,\ngoes on here.\nNew."
    )
    first = "# A text whose lines end after some seventy characters, as in a mail, goes on here."
    assert list(comment_lines([narrow])) == [first, "# New."]
    assert list(comment_lines(["a list:\nfirst\nsecond"])) == ["# a list:", "# first", "# second"]


def test_elements_in_comments_and_repeated_comments_are_only_in_the_report() -> None:
    long = "With a lane width of 3.5 m the center stays within the lane up to an offset of 1.75 m."
    comment = f"<!-- {long} --></ParameterDeclaration>"
    both = SUMS.format("3").replace("/>", f">{comment}")
    document_ = document("", parameters=both, ego_speed="${$Early + $Gap}").replace(
        "<Entities>", '<Entities><!-- <Ignored value="1"/> -->'
    )
    found = imported(document_)
    assert found.text.count("lane width") == 1
    assert "Ignored" not in found.text
    reasons = {each[2] for each in found.report.idle if each[0] == "comment"}
    assert reasons == {"it repeats another one", "it is a part of a document that is switched off"}
