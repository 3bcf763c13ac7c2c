"""What a document says twice or in pieces is said once: ends, parameters, paths, conditions."""

import math
from itertools import pairwise

import pytest

from osc2tx.importing.courses import SPARSE, sparse
from osc2tx.importing.dimensions import LENGTH, Quantity, total
from osc2tx.importing.program import keeps
from osc2tx.xosc.player.bodies import Pose
from tests.importing.documents import after, at_time, document, event, faults, imported
from tests.importing.documents import speed_change as change
from tests.importing.test_structure import FAST, apart


def lines(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines()]


def test_the_end_behind_the_last_event_is_the_end_of_its_branch() -> None:
    found = imported(
        document(event("Faster", change("20"), at_time("1")), end=after("Faster", "2"))
    )
    assert "event finished" not in found.text
    assert "@" not in found.text
    assert lines(found.text)[-1] == "other.keep_speed(duration: 2s)"
    assert faults(found) == []
    assert apart(found) < 0.1


SETTING = """<Event name="Note" priority="parallel"><Action name="NoteAction"><GlobalAction>
  <VariableAction variableRef="fast"><SetAction value="true"/></VariableAction></GlobalAction>
  </Action><StartTrigger><ConditionGroup>%s</ConditionGroup></StartTrigger></Event>"""
VARIABLE = """<VariableDeclarations>
  <VariableDeclaration name="fast" variableType="boolean" value="false"/></VariableDeclarations>"""
SET = """<Condition name="set" delay="1" conditionEdge="none"><ByValueCondition>
  <VariableCondition variableRef="fast" value="true" rule="equalTo"/></ByValueCondition>
  </Condition>"""


def test_an_event_that_only_the_end_waits_for_is_its_condition() -> None:
    """`other` is faster than 18 m/s from 2.2 s on: 1.5 s and 1 s later the scenario is over."""
    events = event("Faster", change("20", "2"), at_time("1")) + SETTING % FAST
    text = document(events, end=SET).replace(
        "<CatalogLocations/>", f"{VARIABLE}<CatalogLocations/>"
    )
    found = imported(text)
    assert "emit" not in found.text
    assert "event" not in found.text
    waits = [line for line in lines(found.text) if line.startswith("wait")]
    assert waits[-2:] == ["wait other.speed > 18mps", "wait elapsed(2.5s)"]
    assert faults(found) == []
    assert apart(found) < 0.1


def test_several_ends_are_a_race() -> None:
    both = f"{after('Faster', '1')}</ConditionGroup><ConditionGroup>{FAST}"
    found = imported(document(event("Faster", change("20", "2"), at_time("1")), end=both))
    assert "one_of:" in found.text
    assert "forever" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


TWICE = (
    '<ParameterDeclaration name="Speed_kph" parameterType="double" value="72"/>'
    '<ParameterDeclaration name="Speed" parameterType="double" value="${$Speed_kph / 3.6}"/>'
)


def test_a_parameter_in_two_units_is_one() -> None:
    found = imported(document("", parameters=TWICE, ego_speed="$Speed"))
    assert [line for line in lines(found.text) if line.startswith("speed")] == [
        "speed: speed = 72kph"
    ]
    assert "ego.assign_speed(speed)" in found.text
    assert ("parameter Speed", "${$Speed_kph / 3.6}") in {each[:2] for each in found.report.idle}
    assert apart(found) < 0.1


OWN = '<RelativeObjectPosition entityRef="other" dx="{}" dy="{}"/>'
TRAJECTORY = """<RoutingAction><FollowTrajectoryAction><TimeReference><None/></TimeReference>
  <TrajectoryFollowingMode followingMode="position"/><TrajectoryRef>
  <Trajectory name="way" closed="false"><Shape><Polyline>{}</Polyline></Shape></Trajectory>
  </TrajectoryRef></FollowTrajectoryAction></RoutingAction>"""


def test_a_trajectory_from_where_the_actor_is_begins_where_it_is_by_then() -> None:
    corners = [OWN.format(0, 0), OWN.format(20, 0), OWN.format(60, 3.5), OWN.format(90, 3.5)]
    vertices = "".join(f"<Vertex><Position>{each}</Position></Vertex>" for each in corners)
    action = TRAJECTORY.format(vertices)
    found = imported(document(event("Swerve", action, at_time("2")), end=at_time("6")))
    assert "transform: object_relative" in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def profile(limits: tuple[float, float, float]) -> str:
    faster, slower, jerk = limits
    return f"""<LongitudinalAction><SpeedProfileAction followingMode="follow">
      <DynamicConstraints maxAcceleration="{faster}" maxDeceleration="{slower}"
      maxAccelerationRate="{jerk}" maxDecelerationRate="{jerk}"/><SpeedProfileEntry speed="25"/>
      </SpeedProfileAction></LongitudinalAction>"""


@pytest.mark.parametrize(
    ("limits", "said"),
    [
        ((2.0, 4.0, 10.0), "change_speed(target: 90kph)"),
        ((4.0, 8.0, 10.0), "change_speed(target: 90kph, rate_profile: asap)"),
        ((1.0, 2.0, 10.0), "change_speed(target: 90kph, rate_profile: constant, duration: 10.1s)"),
    ],
)
def test_limits_of_a_speed_profile(limits: tuple[float, float, float], said: str) -> None:
    """From 54 to 90 kph at 1 m/s² it takes 10 s, and 0.1 s more until the acceleration is there."""
    speeds = event("Faster", profile(limits), at_time("0.5"))
    found = imported(document(speeds, end=at_time("11")))
    assert said in found.text
    assert faults(found) == []
    assert apart(found) < (0.1 if limits[0] > 1.0 else 0.5)


def test_a_sparse_polyline_is_nowhere_far_from_all_corners() -> None:
    arc = [Pose(8.0 * math.sin(a / 20), 8.0 * math.cos(a / 20), 0.0) for a in range(32)]
    found = sparse(arc)
    assert found[0] == arc[0]
    assert found[-1] == arc[-1]
    assert len(found) < len(arc) / 2
    longest = max(math.dist(a[:2], b[:2]) for a, b in pairwise(found))
    assert 8.0 - math.sqrt(64.0 - (longest / 2) ** 2) <= SPARSE + 1e-9


def test_numbers_of_a_sum_are_added_up() -> None:
    gap = Quantity("gap", 3.0, True)
    assert total(LENGTH, (1, Quantity("5m", 5.0)), (-1, gap)).text == "5m - gap"
    assert total(LENGTH, (1, gap), (1, Quantity("5m", 5.0)), (1, Quantity("2m", 2.0))).text == (
        "gap + 7m"
    )
    assert total(LENGTH, (1, Quantity("5m", 5.0)), (-1, Quantity("2m", 2.0))).text == "3m"


def test_constraints_share_a_line_unless_they_are_alternatives() -> None:
    assert keeps(["it > 0m", "it < 5m"]) == ["keep(it > 0m and it < 5m)"]
    assert keeps(["it > 0m", "it == 1m or it == 2m"]) == [
        "keep(it > 0m)",
        "keep(it == 1m or it == 2m)",
    ]


def test_a_parameter_with_the_other_sign_is_that_one() -> None:
    back = TWICE.replace("$Speed_kph / 3.6", "-1 * $Speed_kph / 3.6").replace('"72"', '"-72"')
    found = imported(document("", parameters=back, ego_speed="$Speed"))
    assert "ego.assign_speed(-speed)" in found.text
    assert "speed_2" not in found.text
    assert apart(found) < 0.1


@pytest.mark.parametrize("comment", ["Initial speed", "word " * 40 + "end"])
def test_a_comment_of_a_parameter_is_behind_it_if_it_fits_there(comment: str) -> None:
    declared = TWICE.split("/>")[0] + f"><!-- {comment} --></ParameterDeclaration>"
    found = imported(document("", parameters=declared, ego_speed="${$Speed_kph / 3.6}"))
    is_short = len(comment) < 60
    assert (f"speed: speed = 72kph  # {comment}" in found.text) == is_short
    assert all(len(line) <= 100 for line in found.text.splitlines())
    assert " ".join(found.text.replace("#", " ").split()).count(comment) == 1


def test_an_actor_at_rest_needs_no_action() -> None:
    text = document("")
    start = text.index("<PrivateAction><LongitudinalAction>")
    still = text[:start] + text[text.index("</Private>", start) :]
    assert "ego.keep_speed" in imported(text).text
    found = imported(still)
    assert "ego." not in found.text.replace("ego.assign_position", "")
    assert apart(found) < 0.1


def test_labels_are_only_where_something_refers_to_them() -> None:
    first, second = event("Faster", change("20"), at_time("1")), event("Slower", change("10"), FAST)
    assert "faster:" not in imported(document(first)).text
    assert "override(faster, slower)" in imported(document(first + second)).text


def test_comments_of_events_keep_within_their_lines() -> None:
    comment = f"<!-- {'word ' * 40}-->"
    text = document(event("Faster", change("20"), at_time("1")))
    found = imported(text.replace('<Action name="Faster', f'{comment}<Action name="Faster')).text
    assert all(len(line) <= 100 for line in found.splitlines())
    assert found.count("word") == 40


def test_conditions_that_are_ends_are_an_until_each() -> None:
    """A second condition is an end of its own: nothing has to wait for the first of both."""
    late = FAST.replace('delay="1.5"', 'delay="0"')
    both = f"{at_time('12')}</ConditionGroup><ConditionGroup>{late}"
    found = imported(document(event("Faster", change("20", "2"), at_time("1")), end=both))
    assert [line for line in lines(found.text) if line.startswith("until")] == [
        "until elapsed(12s)",
        "until other.speed > 18mps",
    ]
    assert "finished" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_what_ends_a_serial_behind_the_starts_ends_all() -> None:
    found = imported(document(event("Slower", change("10"), FAST), ego_speed="0"))
    assert [line for line in found.text.splitlines() if "with:" in line or "until" in line][
        -2:
    ] == [
        "    with:",
        "        until elapsed(12s)",
    ]
    assert found.text.count("serial:") == 1
    assert faults(found) == []
    assert apart(found) < 0.1


def test_beside_an_end_of_several_waits_actors_hold_their_speeds_by_themselves() -> None:
    end = after("Faster", "1") + FAST
    events = event("Faster", change("20", "2"), FAST)
    straight = document(events, end=end).replace("highway.xodr", "merge.xodr")
    straight = straight.replace('roadId="1" laneId="-3" s="100"', 'roadId="2" laneId="-2" s="20"')
    found = imported(straight)
    assert "until @finished.end" in found.text
    assert "other.keep_speed" not in found.text
    assert faults(found) == []


def test_a_comment_of_an_event_is_there_once() -> None:
    text = document(event("Faster", change("20"), at_time("1")))
    comment = "<!-- as in the protocol -->"
    twice = text.replace('<Action name="Faster', f'{comment}{comment}<Action name="Faster')
    assert imported(twice).text.count("as in the protocol") == 1
