"""The scenarios of the capabilities: which version can say them, each document sound."""

from collections.abc import Iterable
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.options import XML_VERSIONS, XmlOptions, XmlVersion
from tests.unit.backends.xosc.checks import schema_errors, story_problems
from tests.unit.backends.xosc.documents import compiled, documents

SCENARIOS = sorted((Path(__file__).parents[4] / "scenarios" / "capabilities").glob("*.osc"))

NOTHING: tuple[XmlVersion, ...] = ()
LIMITS: dict[str, tuple[XmlVersion, ...]] = {
    "C01_action_lifecycle": NOTHING,  # it asks for a lane that the map does not have
    "C02_actor_parts": ("1.2", "1.3", "1.4"),  # limited jerk
    "C05_towing": ("1.3", "1.4"),
    "C05_trailer": ("1.3", "1.4"),
    "C06_speed_control": ("1.2", "1.3", "1.4"),  # limited jerk
    "C07_acceleration_control": ("1.2", "1.3", "1.4"),  # a course of the speed
    "C08_stationary": ("1.2", "1.3", "1.4"),  # limited jerk
    "C11_change_position": NOTHING,  # how a walker turns
    "C11_follow_path": NOTHING,  # corners of a path
    "C11_road_path": NOTHING,  # whether it is on the line
    "C12_along_trajectory": NOTHING,  # a speed that jumps
    "C12_follow_trajectory": NOTHING,  # whether it is there in time
    "C13_careful_following": NOTHING,  # care for others
    "C13_time_gap": NOTHING,  # how a gap is closed
    "C14_gap_in_time": NOTHING,  # how long it takes
    "C14_space_gap": NOTHING,  # how a gap is closed
    "C15_headway": NOTHING,  # how a gap is closed
    "C16_automatic_lights": ("1.3", "1.4"),  # a light
    "C16_fog": NOTHING,  # care for others
    "C16_weather": NOTHING,  # humidity
    "C16_weather_readings": NOTHING,  # conditions on the weather
    "C17_behavioral_model": NOTHING,  # a model of behaviour
    "C17_careful_crossing": NOTHING,  # care for others
    "C17_light_bulbs": NOTHING,  # care for others
    "C17_traffic_signals": NOTHING,  # care for others
    "C18_braking_distances": ("1.2", "1.3", "1.4"),  # limited jerk
    "C18_road_conditions": ("1.2", "1.3", "1.4"),  # limited jerk
    "C18_sudden_ice": NOTHING,  # what becomes of an action that has begun
    "C19_change_speed": ("1.2", "1.3", "1.4"),  # limited jerk
    "C19_own_shape": NOTHING,  # a shape of its own
    "C19_speed_modifier": ("1.2", "1.3", "1.4"),  # limited jerk
    "C20_acceleration_shape": ("1.2", "1.3", "1.4"),
    "C21_along": NOTHING,  # whether it is on the line
    "C21_position_modifier": ("1.2", "1.3", "1.4"),  # a course of the speed
    "C21_position_shape": NOTHING,  # a course of the place
    "C22_lateral_speeds": NOTHING,  # a speed across
    "C22_overtaking": ("1.2", "1.3", "1.4"),  # the sign of a distance along
    "C23_physical_movement": ("1.2", "1.3", "1.4"),  # limited jerk
    "C24_temporal_modifiers": ("1.2", "1.3", "1.4"),  # limited jerk
    "C26_pitch_and_roll": NOTHING,  # a pitch in a condition
    "C27_point_distance": ("1.2", "1.3", "1.4"),  # limited jerk
    "C27_world_coordinates": NOTHING,  # where a walker comes to a stand
    "C28_relative_coordinates": ("1.1", "1.2", "1.3", "1.4"),  # a distance across
    "C29_crossing": NOTHING,  # corners of a way
    "C29_geodetic_points": NOTHING,  # whether it is on the line
    "C29_route_coordinates": ("1.1", "1.2", "1.3", "1.4"),  # `>=`
    "C29_route_points": ("1.1", "1.2", "1.3", "1.4"),  # `<=`
    "C29_route_values": NOTHING,  # corners of a way
    "C30_entering": NOTHING,  # the start of a later action
    "C32_conditional_triggers": ("1.2", "1.3", "1.4"),  # the sign of a distance along
    "C32_measures": ("1.2", "1.3", "1.4"),
    "C32_motion_readings": ("1.2", "1.3", "1.4"),  # an acceleration across
    "C33_custom_action": NOTHING,  # an action of its own without a known end
    "C34_conflict_reported": NOTHING,  # it fails in every run
    "C34_override": ("1.2", "1.3", "1.4"),  # limited jerk
    "C35_semantic_validation": ("1.2", "1.3", "1.4"),  # limited jerk
    "C36_one_of": NOTHING,  # an acceleration that is taken over
    "C38_fall": ("1.2", "1.3", "1.4"),
}
"""Versions that say a scenario exactly, whatever playing it shows; all where it is not named."""


def written(path: Path, version: XmlVersion, *, allow_approx: bool) -> tuple[XmlScenario, ...]:
    return documents(compiled(path), XmlOptions(version=version, allow_approx=allow_approx))


def stem(path: Path) -> str:
    return path.stem


def edges(path: Path) -> set[XmlVersion]:
    """Return the versions at which something may change: the ends, and where it becomes exact."""
    first = len(XML_VERSIONS) - len(LIMITS.get(path.stem, XML_VERSIONS))
    return {XML_VERSIONS[0], XML_VERSIONS[-1], *XML_VERSIONS[max(first - 1, 0) : first + 1]}


def assert_exact(path: Path, versions: Iterable[XmlVersion]) -> None:
    exact = {
        version: all(each.xml is not None for each in written(path, version, allow_approx=False))
        for version in versions
    }
    assert exact == {version: version in LIMITS.get(path.stem, XML_VERSIONS) for version in exact}


@pytest.mark.parametrize("path", SCENARIOS, ids=stem)
def test_which_versions_are_exact(path: Path) -> None:
    assert_exact(path, edges(path))


@pytest.mark.slow
@pytest.mark.parametrize("path", SCENARIOS, ids=stem)
def test_versions_between_are_as_those_beside_them(path: Path) -> None:
    assert_exact(path, set(XML_VERSIONS) - edges(path))


def assert_sound(path: Path, versions: Iterable[XmlVersion]) -> None:
    for version in versions:
        for each in written(path, version, allow_approx=True):
            if each.xml is not None:
                assert schema_errors(each.xml, version) == [], version
                assert story_problems(each.xml) == [], version


@pytest.mark.slow
@pytest.mark.parametrize("path", SCENARIOS, ids=stem)
def test_documents_are_sound(path: Path) -> None:
    assert_sound(path, edges(path))


@pytest.mark.slow
@pytest.mark.parametrize("path", SCENARIOS, ids=stem)
def test_documents_of_versions_between_are_sound(path: Path) -> None:
    assert_sound(path, set(XML_VERSIONS) - edges(path))
