"""The checks of stories find what they are for."""

from pathlib import Path

import pytest

from tests.unit.backends.xosc.checks import checker_issues, schema_errors, story_problems
from tests.unit.backends.xosc.test_scenarios import written


@pytest.fixture(scope="module")
def sound() -> str:
    xml = written("pedestrian_crossing", "1.3").xml
    assert xml is not None
    return xml


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ('entityRef="ego"', 'entityRef="nobody"', "refers to entityRef nobody"),
        ('storyboardElementRef="brake"', 'storyboardElementRef="gone"', "the event gone"),
        ('Event name="brake"', 'Event name="cross"', "2 Events are called cross"),
        ('variableRef="road_is_free"', 'variableRef="free"', "refers to variableRef free"),
        ('s="120"', 's="$far"', "undeclared parameter $far"),
    ],
)
def test_references_and_names(sound: str, old: str, new: str, problem: str) -> None:
    assert story_problems(sound) == []
    assert old in sound
    problems = story_problems(sound.replace(old, new))
    assert any(problem in found for found in problems), problems


def test_an_event_that_waits_for_ever(sound: str) -> None:
    ring = sound.replace('storyboardElementRef="brake"', 'storyboardElementRef="ego_change_speed"')
    assert "event ego_change_speed waits for ever" in story_problems(ring)


def test_a_storyboard_that_cannot_stop(sound: str) -> None:
    head, _, tail = sound.rpartition("<StopTrigger>")
    endless = head + "<StopTrigger/>" + tail.partition("</StopTrigger>")[2]
    assert story_problems(endless) == ["the storyboard can never stop"]


def test_schema_and_checker_are_asked(sound: str, tmp_path: Path) -> None:
    assert schema_errors(sound.replace("<Entities>", '<Entities colour="red">'), "1.3")
    assert schema_errors(sound, "1.0"), "variables are not in 1.0"
    issues = checker_issues(sound.replace('entityRef="ego"', 'entityRef="nobody"'), tmp_path)
    assert any("nobody" in issue or "entity" in issue.lower() for issue in issues)
