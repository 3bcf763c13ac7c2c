"""C16 and C18: weather and what follows from it, the state of the road."""

import math

import pytest

from tests.capabilities.kit import DT, ROUNDED, G, Line, Perform, Performance, Trapezoid, next_step

PER_HOUR = 1e-3 / 3600.0  # m/s in a millimetre per hour


def test_c16_weather_changes_by_what_is_said(perform: Perform) -> None:
    run = perform("C16_weather")
    assert run.status == "success"
    weather: dict[str, float] = {}
    by_time = {}
    for line in run.of_kind("environment"):
        values = {name: value for name, value in line.items() if name not in ("t", "kind")}
        weather |= values
        by_time[line["t"]] = values, dict(weather)
    assert list(by_time) == [0.0, 2.0, 4.0]
    # Values are given in other units than those of the trace: nine digits of it are left.
    assert by_time[0.0][0] == pytest.approx(
        {
            "temperature": 273.15 + 12.0,
            "pressure": 101_000.0,
            "relative_humidity": 0.9,
            "cloudiness": 7,
        },
        rel=1e-8,
    )
    assert by_time[2.0][0] == pytest.approx(
        {
            "rain_intensity": 5.0 * PER_HOUR,
            "wind_speed": 10.0,
            "wind_direction": 1.5 * math.pi,
        },
        rel=1e-8,
    )
    assert by_time[4.0][0] == pytest.approx(
        {"rain_intensity": 0.0, "snow_intensity": 1.0 * PER_HOUR, "visual_range": 150.0}, rel=1e-8
    )


def test_c18_snow_takes_the_grip(perform: Perform) -> None:
    run = perform("C18_road_conditions")
    assert run.status == "success"
    dry, _, slippery = run.spans("ego change_speed")
    # A car brakes with 8 m/s^2; packed snow has a coefficient of friction of 0.2.
    on_snow = 0.2 * G
    for span, most in ((dry, 8.0), (slippery, on_snow)):
        assert span.length == next_step(Trapezoid(15.0, most, jerk=10.0).duration)
        hardest = min(line["a"] for line in run.during("ego", span)[1:])
        assert hardest == pytest.approx(-most, rel=2e-3)
    assert slippery.length / dry.length > 2.8


def test_c16_automatic_lights_know_dusk_and_fog(perform: Perform) -> None:
    run = perform("C16_automatic_lights")
    assert run.status == "success"
    lights = [(e["t"], e["actor"], e["mode"], e["lit"]) for e in run.of_kind("lights")]
    # Dusk: 14.9 after 15.1 degrees. Then day, mist of 100 m, fog of 99 m, clear air.
    assert lights == [
        (0.0, "dark", "off", "off"),
        (0.0, "ego", "auto", "off"),
        (2.0, "ego", "auto", "low_beam"),
        (4.0, "ego", "auto", "off"),
        (6.0, "ego", "auto", "low_beam"),
        (7.0, "ego", "auto", "off"),
    ]
    sun = [(e["t"], e["sun_elevation"]) for e in run.of_kind("environment") if "sun_elevation" in e]
    degrees = [40.0, 15.1, 14.9, -20.0, 20.0]
    assert sun == [(float(t), pytest.approx(math.radians(d))) for t, d in enumerate(degrees)]


def test_c16_fog_hides_what_is_ahead(perform: Perform) -> None:
    run = perform("C16_fog")
    assert run.status == "success"
    assert run.of_kind("collision") == []

    def begin_and_hardest(car: str, ahead: str) -> tuple[float, float]:
        """Free metres at the first braking, and the hardest."""
        states = run.states(car)
        first = next(i for i, line in enumerate(states) if line["a"] < 0.0)
        seen_at = states[first - 1]["t"]
        free = run.rear(ahead, seen_at) - run.front(car, seen_at)
        return free, min(line["a"] for line in states)

    clear, gentle = begin_and_hardest("early", "standing")
    hidden, hard = begin_and_hardest("late", "broken")
    # A step of 0.75 m before, it was farther than one sees.
    assert 50.0 - 15.0 * DT < hidden <= 50.0
    assert clear > 60.0
    assert hard < gentle
    # Both stand the 2 m of the model behind the other one, within 10 cm.
    for car, ahead in (("early", "standing"), ("late", "broken")):
        gap = run.rear(ahead, 30.0) - run.front(car, 30.0)
        assert gap == pytest.approx(2.0, abs=0.1)


ADHESION: dict[str, float | None] = {"dry": None, "wet": 0.6, "snowy": 0.2, "icy": 0.1}
"""Coefficients of friction as docs/reference/surroundings.md has them."""


def test_c18_braking_distances_on_four_roads(perform: Perform) -> None:
    """With jerk j up to a and back it takes v / 2 * (v / a + a / j); v^2 / (2 mu g) is the rest."""
    run = perform("C18_braking_distances")
    assert run.status == "success"
    v, jerk = 15.0, 10.0
    ways = {}
    for road, span in zip(ADHESION, run.spans("ego change_speed"), strict=True):
        friction = ADHESION[road]
        a = 8.0 if friction is None else friction * G  # a car cannot do more than 8 m/s^2
        ways[road] = run.at("ego", span.end)["x"] - run.at("ego", span.start)["x"]
        # Trapezoids of 0.05 s against the integral, and what is left of the last step: 2 cm.
        assert ways[road] == pytest.approx(v / 2 * (v / a + a / jerk), abs=0.02)
        assert ways[road] - v * a / (2 * jerk) == pytest.approx(v**2 / (2 * a), abs=0.02)
        assert span.length == next_step(Trapezoid(v, a, jerk).duration)
    assert sorted(ways, key=ways.__getitem__) == list(ADHESION)


@pytest.mark.parametrize("car", ["fast", "slow"])
def test_c18_on_sudden_ice_only_friction_is_left(perform: Perform, car: str) -> None:
    run = perform("C18_sudden_ice")
    assert run.status == "success"
    ice = run.at(car, 2.0)
    assert ice["v"] == pytest.approx({"fast": 20.0, "slow": 12.0}[car] - 6.0, abs=ROUNDED)
    assert ice["a"] == pytest.approx(-6.0, abs=ROUNDED)
    after = braking(run, car, 2.0)
    limit = 0.1 * G
    # On the last step it comes to a stand with less.
    rates = [line["a"] for line in after[:-1]]
    assert rates == pytest.approx([-limit] * len(rates), abs=ROUNDED)
    # v^2 / (2 mu g), and what the last step of up to 0.05 m/s is rounded by: 1 mm.
    way = run.last(car)["x"] - ice["x"]
    assert way == pytest.approx(ice["v"] ** 2 / (2 * limit), abs=1e-3)
    assert run.last("walker")["v"] == pytest.approx(1.4, abs=ROUNDED)


def braking(run: Performance, car: str, since: float) -> list[Line]:
    """States from the step after a time to the first at which it stands."""
    later = [line for line in run.states(car) if line["t"] > since + 1e-9]
    stand = next(i for i, line in enumerate(later) if line["v"] == 0.0)
    return later[: stand + 1]


def test_c16_weather_triggers_and_is_noted(perform: Perform) -> None:
    run = perform("C16_weather_readings")
    assert run.status == "success"
    # What is set at an instant can be read at it.
    assert [run.event(name) for name in ("wet", "hidden", "stormy")] == [2.0, 5.0, 8.0]
    noted = {line["name"]: line["value"] for line in run.of_kind("variable")}
    assert noted["rain"] == pytest.approx(5.0 * PER_HOUR, rel=1e-8)
    assert noted["sight"] == 60.0
    assert noted["from_west"] == pytest.approx(math.radians(10.0), rel=1e-8)
    assert noted["low_sun"] == pytest.approx(math.radians(3.0), rel=1e-8)
    # At the solstice the sun stands over the tropic, and sundials are 1.8 minutes slow.
    latitude, tropic = math.radians(48.137), math.radians(23.436)
    hour = math.radians(15.0 * (19.0 + (2.0 + DT) / 3600.0 + 11.575 / 15.0 - 1.8 / 60.0 - 12.0))
    height = math.sin(latitude) * math.sin(tropic)
    height += math.cos(latitude) * math.cos(tropic) * math.cos(hour)
    assert noted["sun"] == pytest.approx(math.asin(height), abs=math.radians(0.03))


def test_c17_a_careful_driver_waits_at_a_red_light(perform: Perform) -> None:
    run = perform("C17_behavioral_model")
    assert run.status == "success"
    driven, waited = run.span("ego drive"), run.span("ego change_speed")
    assert driven.end == 1.0
    assert run.at("ego", 1.0)["v"] == 12.0
    # No action drives it any more; it stops as it does with `avoid_collisions`.
    standing = [line for line in run.states("ego") if line["v"] == 0.0]
    assert run.front("ego", standing[0]["t"]) == pytest.approx(149.0 - 1.0, abs=0.01)
    assert waited.start == pytest.approx(standing[0]["t"] + 2.0)
    # The other model holds the speed that the action leaves, past the light that is still red.
    after = [line["v"] for line in run.states("ego") if line["t"] >= waited.end]
    assert set(after) == {6.0}
    assert run.last("ego")["road"] != "1"
