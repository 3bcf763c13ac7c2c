"""Acts that are stopped, events that count from the start of their act, and joins."""

from tests.importing.documents import (
    after,
    at_time,
    document,
    event,
    faults,
    imported,
    lane_change,
    speed_change,
)
from tests.importing.test_structure import apart

STOP = "<StopTrigger><ConditionGroup>{}</ConditionGroup></StopTrigger></Act>"
START = "<StartTrigger><ConditionGroup>{}</ConditionGroup></StartTrigger></Act>"
RUNNING = """<Condition name="running" delay="{}" conditionEdge="none"><ByValueCondition>
  <StoryboardElementStateCondition storyboardElementType="act" storyboardElementRef="Act"
  state="runningState"/></ByValueCondition></Condition>"""


def test_an_act_ends_what_goes_on_in_it_when_it_is_stopped() -> None:
    """After 3 of 8 s `other` has reached 15 + 3/8 * 8 = 18 m/s, which it keeps."""
    text = document(event("Faster", speed_change("23", "8"), at_time("1")))
    found = imported(text.replace("</Act>", STOP.format(at_time("4"))))
    assert "until elapsed(4s)" in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_what_waits_for_several_ends_stands_behind_a_parallel() -> None:
    first = event("Faster", speed_change("20"), at_time("1"), "parallel")
    beside = event("Change", lane_change(-1), at_time("1"), "parallel")
    last = event("Slower", speed_change("10"), after("Faster") + after("Change"), "parallel")
    found = imported(document(first + beside + last))
    assert "override" not in found.text
    assert "wait @" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_delay_behind_an_event_with_another_one_behind_it() -> None:
    """The third event waits for 6 s after the first, in which the second one takes 4 s."""
    first = event("Faster", speed_change("20", "2"), at_time("1"))
    second = event("Slower", speed_change("10"), after("Faster"))
    third = event("Again", speed_change("15", "2"), after("Slower") + after("Faster", "6"))
    found = imported(document(first + second + third))
    assert "override" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_an_event_counts_from_the_start_of_its_act() -> None:
    text = document(event("Faster", speed_change("20"), RUNNING.format("2")))
    found = imported(text.replace("</Act>", START.format(at_time("1"))))
    assert faults(found) == []
    assert apart(found) < 0.1
