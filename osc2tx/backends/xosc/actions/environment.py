"""Environment (§8.10, §8.11) as global actions.

An action of the DSL says one thing about the weather and leaves the rest. From 1.1 on the XML can
leave out the rest too; in 1.0 it has to be stated again, so all that was said before is kept.
"""

from __future__ import annotations

import math
from datetime import datetime, timedelta
from typing import cast

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Globals
from osc2tx.backends.xosc.actions.registry import global_action
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.actors import ADHESION, road_condition
from osc2tx.backends.xosc.names import event_name
from osc2tx.backends.xosc.values.constants import Constant, MethodResult, as_number
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import CloudState, FractionalCloudCover, PrecipitationType

NOON = "2000-01-01T12:00:00"
"""Time of day where 1.0 asks for one and the scenario says none."""

FULL_SUN = 100000.0
"""Lux of the sun in the zenith; the DSL knows no brightness."""

MMPH = 1e-3 / 3600.0
"""Millimetres per hour in m/s."""

HEAVIEST_RAIN = 50.0
"""mm/h that are the intensity 1 of OpenSCENARIO XML 1.0, which has no unit."""

FAR = 100000.0
"""Visual range (m) where fog is not mentioned."""

PRECIPITATIONS: tuple[PrecipitationType, ...] = ("rain", "snow")

OKTAS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")


# --- sun and air --------------------------------------------------------------------------------


@global_action("assign_celestial_position")
def _celestial_position(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    source = arguments.expression("light_source")
    if source is not None and source.span.text.endswith("moon"):
        raise Inexpressible("there is no moon in OpenSCENARIO XML")
    _note(ctx, arguments, azimuth="sun_azimuth", elevation="sun_elevation")
    return (environment_action(ctx, node, xml.Weather(_sun(ctx))),)


def _note(ctx: Context, arguments: Arguments, **names: str) -> None:
    """Note what arguments state of the weather: what nobody has stated is open."""
    for argument, name in names.items():
        value = arguments.number(argument)
        if value is not None:
            ctx.weather[name] = value


def _sun(ctx: Context) -> xml.Sun:
    elevation = ctx.weather.get("sun_elevation", math.pi / 2)
    brightness = max(math.sin(elevation), 0.0)
    return xml.Sun(
        azimuth=ctx.weather.get("sun_azimuth", 0.0),
        elevation=elevation,
        illuminance=round(FULL_SUN * brightness, 3) if ctx.version >= "1.2" else None,
        intensity=round(brightness, 6) if ctx.version < "1.2" else None,
    )


@global_action("air")
def _air(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    temperature, pressure = arguments.number("temperature"), arguments.number("pressure")
    humidity = arguments.number("relative_humidity")
    _note(ctx, arguments, temperature="temperature")
    if humidity is not None:
        arguments.approximate(
            "there is no humidity in OpenSCENARIO XML",
            f"relative_humidity {humidity:g} is dropped; temperature and pressure are exact",
        )
    if temperature is None and pressure is None:
        return ()
    ctx.require("temperature and pressure of the air", "1.1")
    weather = xml.Weather(temperature=temperature, atmosphericPressure=pressure)
    return (environment_action(ctx, node, weather),)


@global_action("wind")
def _wind(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    ctx.require("wind", "1.1")
    _note(ctx, arguments, speed="wind_speed", direction="wind_direction")
    if "wind_speed" not in ctx.weather or "wind_direction" not in ctx.weather:
        raise Inexpressible("the XML asks for both speed and direction")
    # The DSL says where it comes from, clockwise from north; the XML whither, counter-clockwise
    # from east.
    whither = (-0.5 * math.pi - ctx.weather["wind_direction"]) % (2.0 * math.pi)
    wind = xml.Wind(direction=round(whither, 9), speed=ctx.weather["wind_speed"])
    return (environment_action(ctx, node, xml.Weather(wind)),)


# --- fog, clouds, rain and snow -----------------------------------------------------------------


@global_action("fog")
def _fog_action(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    ctx.weather["visual_range"] = arguments.required("visual_range")
    return (environment_action(ctx, node, xml.Weather(_fog(ctx))),)


def _fog(ctx: Context) -> xml.Fog:
    return xml.Fog(visualRange=ctx.weather.get("visual_range", FAR))


@global_action("clouds")
def _clouds_action(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    cloudiness = arguments.required("cloudiness")
    if not 0.0 <= cloudiness < len(OKTAS):
        raise Inexpressible("the cloud cover is not between 0 and 9 oktas")
    ctx.weather["cloudiness"] = cloudiness
    if ctx.version >= "1.2":
        cover = cast("FractionalCloudCover", f"{OKTAS[round(cloudiness)]}Oktas")
        return (environment_action(ctx, node, xml.Weather(fractionalCloudCover=cover)),)
    if 0 < cloudiness < 8:
        arguments.approximate(
            f"OpenSCENARIO XML {ctx.version} counts no oktas",
            f"{cloudiness:g} oktas are called cloudy, which is 1 to 7",
            Remedy(version="1.2"),
        )
    return (environment_action(ctx, node, xml.Weather(cloudState=_cloud_state(ctx))),)


def _cloud_state(ctx: Context) -> CloudState:
    cloudiness = ctx.weather.get("cloudiness", 0.0)
    if cloudiness == 0.0:
        return "free"
    return "cloudy" if cloudiness < 8.0 else "overcast"


@global_action("rain", "snow")
def _precipitation_action(ctx: Context, node: ir.Invoke, arguments: Arguments) -> Globals:
    intensity = arguments.required("intensity")
    if node.action == "snow" and intensity > 0.0:
        ctx.require_support("Precipitation/snow")
    ctx.weather[f"{node.action}_intensity"] = intensity
    if all(ctx.weather.get(f"{name}_intensity", 0.0) > 0.0 for name in PRECIPITATIONS):
        raise Inexpressible("OpenSCENARIO XML has one precipitation, not rain and snow")
    if ctx.version == "1.0" and intensity > 0.0:
        arguments.approximate(
            "the intensity has no unit in OpenSCENARIO XML 1.0",
            f"1 stands for {HEAVIEST_RAIN:g} mm/h and more",
            Remedy(version="1.1"),
        )
    return (environment_action(ctx, node, xml.Weather(_precipitation(ctx))),)


def _precipitation(ctx: Context) -> xml.Precipitation:
    kind: PrecipitationType = "dry"
    intensity = 0.0
    for name in PRECIPITATIONS:
        amount = ctx.weather.get(f"{name}_intensity", 0.0)
        if amount > 0.0:
            kind, intensity = name, round(amount / MMPH, 9)
    if ctx.version == "1.0":
        relative = round(min(intensity / HEAVIEST_RAIN, 1.0), 6)
        return xml.Precipitation(precipitationType=kind, intensity=relative)
    return xml.Precipitation(precipitationType=kind, precipitationIntensity=intensity)


# --- the environment as a whole -----------------------------------------------------------------


def initial_environment(ctx: Context) -> tuple[xml.GlobalAction, ...]:
    """Return the actions for the initial environment, whichever actor acts."""
    actions: list[xml.GlobalAction] = []
    for actor in ctx.actors_like("environment"):  # there is one at the most
        said = {value.path[0] for value in actor.values}
        if "geodetic_position" in said:
            ctx.report.approximate(
                f"actor {actor.type}",
                actor.span,
                "where the world lies on the globe is a matter of the map in OpenSCENARIO XML",
                "`geodetic_position` is dropped; nothing moves otherwise",
            )
        if "datetime" in said:
            with ctx.report_as(f"actor {actor.type}", actor.span):
                actions.append(
                    environment_action(ctx, actor, xml.Weather())  # 1.0 states all of it
                    if ctx.version == "1.0"
                    else _environment(ctx, actor.name, time_of_day(ctx))
                )
    return tuple(actions)


def environment_action(
    ctx: Context, source: ir.Invoke | ir.Actor, weather: xml.Weather
) -> xml.GlobalAction:
    """Return the action that changes parts of the weather; 1.0 has to state all of it."""
    clock = None
    if ctx.version == "1.0":
        parts = _sun(ctx), _fog(ctx), _precipitation(ctx)
        weather = xml.Weather(*parts, cloudState=_cloud_state(ctx))
        clock = _stated_again(ctx, source)
    name = event_name(ctx.scope.deeds, source) if isinstance(source, ir.Invoke) else source.name
    return _environment(ctx, name, weather, clock, _road(ctx, source))


def _stated_again(ctx: Context, source: ir.Invoke | ir.Actor) -> xml.TimeOfDay:
    """Return the time of day that 1.0 asks for with each word about the weather."""
    clock = time_of_day(ctx)
    if clock is None:
        return xml.TimeOfDay(animation=False, dateTime=NOON)
    if isinstance(source, ir.Invoke) and not ir.is_first(ctx.scenario.body, source):
        ctx.report.approximate(
            f"action {source.action}",
            source.span,
            "OpenSCENARIO XML 1.0 sets the time of day with the weather",
            "the clock goes back to the start of the scenario",
            Remedy(version="1.1"),
        )
    return clock


def _environment(ctx: Context, name: str, *parts: xml.EnvironmentPart | None) -> xml.GlobalAction:
    environment = xml.Environment(*parts, name=ctx.names.new(f"environment_{name}"))
    return xml.GlobalAction(xml.EnvironmentAction(environment))


def _road(ctx: Context, source: ir.Invoke | ir.Actor) -> xml.RoadCondition | None:
    """Return how slippery roads are: the DSL leaves that to the world, tools have to be told."""
    adhesion = ADHESION.get(road_condition(ctx.weather))
    if adhesion is None and ctx.version > "1.0" and "adhesion" not in ctx.weather:
        return None
    if adhesion is not None:
        is_new = ctx.weather.get("adhesion") != adhesion
        ctx.weather["adhesion"] = adhesion
        if is_new and isinstance(source, ir.Invoke) and not ir.is_first(ctx.scenario.body, source):
            _report_lost_grip(ctx, source)
    return xml.RoadCondition(frictionScaleFactor=1.0 if adhesion is None else adhesion)


def _report_lost_grip(ctx: Context, source: ir.Invoke) -> None:
    """Report that vehicles lose grip amid an action: the XML does not define the rest of it."""
    beside = ir.runs_beside(ctx.scenario.body, source)
    names = {name for member in beside for name in ir.actors_of(member)}
    if any(name in ctx.cast and not ctx.cast[name].walks for name in names):
        ctx.report.doubt(
            f"action {source.action}",
            source.span,
            "the road becomes slippery while vehicles move; what that does to an action that has"
            " begun the XML leaves to the tool",
        )


# --- date and time --------------------------------------------------------------------------------

DAY, CLOCK = ("year", "month", "day"), ("hour", "minute", "second")
"""Parts of a local date and time."""


def time_of_day(ctx: Context) -> xml.TimeOfDay | None:
    """Return date and time at the start, if the scenario says them (§8.10.2).

    They are those of the zone of Greenwich; neither a fraction of a second nor a zone stands in the
    text, for there are tools that cannot read them.
    """
    for actor in ctx.actors_like("environment"):
        date = _date(ctx.values.field(actor.name, "datetime"))
        if date is not None:
            return xml.TimeOfDay(animation=True, dateTime=date.isoformat())
    return None


def _date(given: Constant | None) -> datetime | None:
    """Return the date of a Unix time, or of local numbers (§8.10.2.1)."""
    try:
        if isinstance(given, MethodResult):
            year, month, day = (round(_number(given.get(part))) for part in DAY)
            hours, minutes, seconds = (_number(given.get(part)) for part in CLOCK)
            hours -= _number(given.get("time_zone"))
            since = timedelta(hours=hours, minutes=minutes, seconds=seconds)
            return datetime(year, month, day) + since
        if isinstance(given, (int, float)):
            return datetime(1970, 1, 1) + timedelta(seconds=round(given))
    except (OverflowError, ValueError) as error:
        raise Inexpressible(f"the date cannot be written: {error}") from None
    return None


def _number(value: Constant | None) -> float:
    number = as_number(value)
    if number is None:
        raise Inexpressible("the date is only known during the run")
    return number
