"""Sun and moon against published positions, and what follows from them."""

from __future__ import annotations

import math
from datetime import UTC, datetime

import pytest

from osc2tx_runtime import Environment, GeodeticPosition, Vehicle
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.surroundings.sun_and_moon import Sky


def sky(latitude: float, longitude: float, *moment: int) -> dict[str, float]:
    """Degrees over a place at a time of UTC."""
    begin = datetime(*moment, tzinfo=UTC).timestamp()  # type: ignore[misc, arg-type]
    over = Sky(math.radians(latitude), math.radians(longitude), begin)
    return {name: math.degrees(value) for name, value in over.values(0.0).items()}


def test_sun_of_the_published_example() -> None:
    """I. Reda, A. Andreas, Solar Position Algorithm, NREL 2008: Golden, 17 October 2003."""
    seen = sky(39.742476, -105.1786, 2003, 10, 17, 19, 30, 30)
    assert seen["sun_azimuth"] == pytest.approx(194.340, abs=0.01)
    # They have the zenith angle with air, which lifts the sun by 0.02 degrees at this height.
    assert seen["sun_elevation"] == pytest.approx(90.0 - 50.112 - 0.02, abs=0.01)


def test_the_moon_hides_the_sun_in_an_eclipse() -> None:
    """Greatest eclipse of 8 April 2024 at 25.3 N, 104.1 W: the sun at 70 degrees (NASA)."""
    seen = sky(25.285, -104.14, 2024, 4, 8, 18, 17, 21)
    assert seen["sun_elevation"] == pytest.approx(69.8, abs=0.1)
    assert seen["sun_azimuth"] == pytest.approx(149.4, abs=0.3)
    assert seen["moon_elevation"] == pytest.approx(seen["sun_elevation"], abs=0.3)
    across = math.cos(math.radians(70.0)) * (seen["moon_azimuth"] - seen["sun_azimuth"])
    assert across == pytest.approx(0.0, abs=0.3)


@pytest.mark.parametrize(
    ("month", "minute", "declination"), [(6, 2, 23.44), (12, -2, -23.44)], ids=["June", "December"]
)
def test_noon_at_the_solstices(month: int, minute: int, declination: float) -> None:
    """In Greenwich the sun is in the south two minutes late in June and two early in December."""
    hour, minute = divmod(12 * 60 + minute, 60)
    seen = sky(51.4779, 0.0, 2024, month, 21, hour, minute)
    assert seen["sun_azimuth"] == pytest.approx(180.0, abs=0.3)
    assert seen["sun_elevation"] == pytest.approx(90.0 - 51.4779 + declination, abs=0.02)


def test_the_environment_shows_it_from_the_start(highway: RoadMap) -> None:
    begin = datetime(2024, 6, 20, 12, 2, tzinfo=UTC).timestamp()
    place = GeodeticPosition(math.radians(51.4779), 0.0)
    env, car = Environment(datetime=begin, geodetic_position=place), Vehicle()
    env.id, car.id = "env", "car"
    world = EmbeddedWorld(highway)
    context = ExecutionContext(world, None, {"env": env, "car": car})
    env.bind(context)
    world.add(car.spec())
    world.place("car", LanePosition("1", -2, 100.0), 0.0)
    noon = math.radians(90.0 - 51.4779 + 23.44)
    assert env.sun.position.elevation == pytest.approx(noon, abs=1e-3)
    assert env.sun.position.azimuth == pytest.approx(math.pi, abs=5e-3)
    # By day automatic lights are off; an action puts the sun down, and only that stays.
    assert world.set_lights("car", "auto").lit == "off"
    world.set_environment({"sun_elevation": 0.1})
    before = env.sun.position.azimuth
    for _ in range(20 * 60):
        world.step()
    assert env.sun.position.elevation == 0.1
    assert env.sun.position.azimuth - before > math.radians(0.25)  # in a minute
    assert world.lights("car").lit == "low_beam"


def test_lights_go_on_when_the_sun_has_gone_down(highway: RoadMap) -> None:
    """At the equator the sun sinks by a degree in four minutes after an equinox."""
    begin = datetime(2024, 3, 20, 17, 7, tzinfo=UTC).timestamp()
    world = EmbeddedWorld(highway, dt=1.0)
    car = Vehicle()
    car.id = "car"
    world.add(car.spec())
    world.place("car", LanePosition("1", -2, 100.0), 0.0)
    world.begin_under(Sky(0.0, 0.0, begin))
    world.set_lights("car", "auto")
    lit = []
    for _ in range(10 * 60):
        world.step()
        lit.append((world.environment()["sun_elevation"], world.lights("car").lit))
    limit = math.radians(15.0)
    assert lit[0][0] > limit > lit[-1][0]
    assert {is_on for height, is_on in lit if height > limit + 1e-4} == {"off"}
    assert {is_on for height, is_on in lit if height < limit - 1e-4} == {"low_beam"}
