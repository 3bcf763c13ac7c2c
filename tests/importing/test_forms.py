"""Forms that a person would write: places, gaps, dimensions, what goes on by itself."""

from tests.importing.documents import at_time, document, event, faults, imported, speed_change
from tests.importing.test_structure import apart

GAP = """<LongitudinalAction><LongitudinalDistanceAction entityRef="ego" freespace="true"
  continuous="false" {} displacement="leadingReferencedEntity"/></LongitudinalAction>"""
SAME_LANE = 'dLane="0" ds="30"'
OPEN = (
    '<ParameterDeclaration name="Ahead" parameterType="double" value="30"/>'
    '<ParameterDeclaration name="Aside" parameterType="double" value="0.5"/>'
)
PRODUCT = (
    '<ParameterDeclaration name="Speed" parameterType="double" value="20"/>'
    '<ParameterDeclaration name="Headway" parameterType="double" value="1.5"/>'
)


def in_same_lane(text: str) -> str:
    return text.replace('dLane="1" ds="30"', SAME_LANE)


def test_on_a_straight_road_actors_go_on_by_themselves() -> None:
    text = document(event("Faster", speed_change("20"), at_time("1")))
    assert "ego.keep_speed()" in imported(text).text  # the highway bends: drivers would brake
    text = text.replace("highway.xodr", "merge.xodr").replace('"-3" s="100"', '"-2" s="20"')
    found = imported(text.replace('roadId="1"', 'roadId="2"'))
    assert "keep_speed" not in found.text
    assert faults(found) == []
    assert apart(found) < 0.1


def test_a_gap_without_limits_is_there_at_once() -> None:
    text = in_same_lane(document(event("Gap", GAP.format('distance="20"'), at_time("1"))))
    found = imported(text)
    assert "position(20m + 5m, ahead_of: ego)" in found.text
    assert apart(found) < 0.1


def test_a_gap_in_time_counts_the_speed_of_the_one_behind() -> None:
    text = in_same_lane(document(event("Gap", GAP.format('timeGap="2"'), at_time("1"))))
    found = imported(text)
    assert "position(2s * ego.speed + 5m, ahead_of: ego)" in found.text
    assert faults(found) == []


def test_an_open_place_beside_another_actor_stays_open() -> None:
    text = document("", parameters=OPEN).replace(
        'ds="30" offset="0"', 'ds="$Ahead" offset="$Aside"'
    )
    found = imported(text)
    assert "s: 100m + ahead, t: aside" in found.text
    assert faults(found) == []


def test_the_factor_beside_a_speed_in_a_length_is_a_time() -> None:
    text = document("", parameters=PRODUCT, ego_speed="$Speed").replace(
        'ds="30"', 'ds="${$Headway * $Speed}"'
    )
    found = imported(text)
    assert "headway: time = 1.5s" in found.text
    assert "position(headway * speed, ahead_of: ego)" in found.text


def test_places_of_nearby_actors_are_looked_for_once() -> None:
    """Two actors that begin beside each other are put there, not on the road before that."""
    found = imported(document(""))
    assert list(found.starts) == ["ego"]
