"""Triggers: what stands where in a group."""

from osc2tx.backends.xosc.conditions import flow
from osc2tx.backends.xosc.conditions.flow import Flow, run_start, state_of
from osc2tx.backends.xosc.flattening.storyboard import StoryboardWriter
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element


def on(name: str) -> Element:
    value = xml.VariableCondition(variableRef=name, rule="equalTo", value="true")
    return xml.ByValueCondition(value)


def order(*group: flow.Test) -> list[str]:
    """Return the tags and edges of a written group."""
    trigger = StoryboardWriter("1.3").trigger(xml.StartTrigger, Flow((group,)), "start")
    (written,) = trigger.children
    return [
        f"{condition.children[0].children[0].tag} {condition.get('conditionEdge')}"
        for condition in written.children
    ]


def test_edges_are_looked_at_before_levels_and_after_what_they_count_from() -> None:
    """A tool that stops at the first false condition would not see an edge behind a level."""
    level, edge = flow.Test(on("level")), flow.Test(on("edge"), "rising")
    assert order(level, edge, state_of("event", "done")) == [
        "StoryboardElementStateCondition none",
        "VariableCondition rising",
        "VariableCondition none",
    ]


def test_the_start_of_the_run_is_left_out_where_there_is_more_to_say() -> None:
    assert order(run_start(), flow.Test(on("level"))) == ["VariableCondition none"]
    assert order(run_start()) == ["SimulationTimeCondition none"]
