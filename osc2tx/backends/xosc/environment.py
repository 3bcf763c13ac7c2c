"""Environment (§8.11) as global actions, and lights of vehicles.

An action of the DSL says one thing about the weather and leaves the rest. From 1.1 on the XML can
leave out the rest too; in 1.0 it has to be stated again, so all that was said before is kept.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts import ADHESION, road_condition
from osc2tx.backends.xosc.leaf import Arguments, Change, Leaf, Performance
from osc2tx.backends.xosc.registry import action, global_action
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.tree import Element, element

NOON = "2000-01-01T12:00:00"
"""Time of day where 1.0 asks for one and the scenario says none."""

FULL_SUN = 100000.0
"""Lux of the sun in the zenith; the DSL knows no brightness."""

DARK = math.radians(15.0)
"""Elevation of the sun (rad) below which automatic lights are on."""

MMPH = 1e-3 / 3600.0
"""Millimetres per hour in m/s."""

HEAVIEST_RAIN = 50.0
"""mm/h that are the intensity 1 of OpenSCENARIO XML 1.0, which has no unit."""

FAR = 100000.0
"""Visual range (m) where nobody speaks of fog."""

OKTAS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")

LIGHTS: Mapping[str, Mapping[str, str]] = {
    "off": {"lowBeam": "off", "highBeam": "off", "daytimeRunningLights": "off"},
    "daytime": {"daytimeRunningLights": "on", "lowBeam": "off", "highBeam": "off"},
    "low_beam": {"lowBeam": "on", "highBeam": "off"},
    "high_beam": {"lowBeam": "on", "highBeam": "on"},
}
"""Mode of `set_lights` -> state of each light."""


# --- sun and air --------------------------------------------------------------------------------


@global_action("assign_celestial_position")
def _celestial_position(ctx: Context, node: ir.Invoke, arguments: Arguments) -> tuple[Element, ...]:
    azimuth, elevation = arguments.number("azimuth"), arguments.number("elevation")
    source = arguments.expression("light_source")
    if source is not None and source.span.text.endswith("moon"):
        raise Inexpressible("there is no moon in OpenSCENARIO XML", node.span)
    if azimuth is None:
        azimuth = ctx.weather.get("sun_azimuth")
    if elevation is None:
        elevation = ctx.weather.get("sun_elevation")
    if azimuth is None or elevation is None:
        raise Inexpressible("the XML asks for both azimuth and elevation", node.span)
    ctx.weather["sun_elevation"] = elevation
    ctx.weather["sun_azimuth"] = azimuth
    return (environment_action(ctx, node, _sun(ctx)),)


def _sun(ctx: Context) -> Element:
    elevation = ctx.weather.get("sun_elevation", math.pi / 2)
    brightness = max(math.sin(elevation), 0.0)
    return element(
        "Sun",
        azimuth=ctx.weather.get("sun_azimuth", 0.0),
        elevation=elevation,
        illuminance=round(FULL_SUN * brightness, 3) if ctx.version >= "1.2" else None,
        intensity=round(brightness, 6) if ctx.version < "1.2" else None,
    )


@global_action("air")
def _air(ctx: Context, node: ir.Invoke, arguments: Arguments) -> tuple[Element, ...]:
    temperature, pressure = arguments.number("temperature"), arguments.number("pressure")
    humidity = arguments.number("relative_humidity")
    if temperature is not None:
        ctx.weather["temperature"] = temperature
    if humidity is not None:
        ctx.report.approximate(
            f"action {node.action}",
            node.span,
            "there is no humidity in OpenSCENARIO XML",
            f"relative_humidity {humidity:g} is dropped; temperature and pressure are exact",
        )
    if temperature is None and pressure is None:
        return ()
    ctx.require("temperature and pressure of the air", "1.1", node.span)
    return (environment_action(ctx, node, temperature=temperature, pressure=pressure),)


@global_action("wind")
def _wind(ctx: Context, node: ir.Invoke, arguments: Arguments) -> tuple[Element, ...]:
    ctx.require("wind", "1.1", node.span)
    for name in ("speed", "direction"):
        value = arguments.number(name)
        if value is not None:
            ctx.weather[f"wind_{name}"] = value
    if "wind_speed" not in ctx.weather or "wind_direction" not in ctx.weather:
        raise Inexpressible("the XML asks for both speed and direction", node.span)
    # The DSL says where it comes from, clockwise from north; the XML whither, counter-clockwise
    # from east.
    whither = (-0.5 * math.pi - ctx.weather["wind_direction"]) % (2.0 * math.pi)
    wind = element("Wind", direction=round(whither, 9), speed=ctx.weather["wind_speed"])
    return (environment_action(ctx, node, wind),)


# --- fog, clouds, rain and snow -----------------------------------------------------------------


@global_action("fog")
def _fog_action(ctx: Context, node: ir.Invoke, arguments: Arguments) -> tuple[Element, ...]:
    visual_range = arguments.number("visual_range")
    if visual_range is None:
        raise Inexpressible("it says no visual range", node.span)
    ctx.weather["visual_range"] = visual_range
    return (environment_action(ctx, node, _fog(ctx)),)


def _fog(ctx: Context) -> Element:
    return element("Fog", visualRange=ctx.weather.get("visual_range", FAR))


@global_action("clouds")
def _clouds_action(ctx: Context, node: ir.Invoke, arguments: Arguments) -> tuple[Element, ...]:
    cloudiness = arguments.number("cloudiness")
    if cloudiness is None or not 0.0 <= cloudiness < len(OKTAS):
        raise Inexpressible("the cloud cover is not between 0 and 9 oktas", node.span)
    ctx.weather["cloudiness"] = cloudiness
    if ctx.version < "1.2" and 0 < cloudiness < 8:
        ctx.report.approximate(
            f"action {node.action}",
            node.span,
            f"OpenSCENARIO XML {ctx.version} counts no oktas",
            f"{cloudiness:g} oktas are called cloudy, which is 1 to 7",
            Remedy(version="1.2"),
        )
    if ctx.version >= "1.2":
        cover = f"{OKTAS[round(cloudiness)]}Oktas"
        return (environment_action(ctx, node, cover=cover),)
    return (environment_action(ctx, node, state=_cloud_state(ctx)),)


def _cloud_state(ctx: Context) -> str:
    cloudiness = ctx.weather.get("cloudiness", 0.0)
    if cloudiness == 0.0:
        return "free"
    return "cloudy" if cloudiness < 8.0 else "overcast"


@global_action("rain", "snow")
def _precipitation_action(
    ctx: Context, node: ir.Invoke, arguments: Arguments
) -> tuple[Element, ...]:
    intensity = arguments.number("intensity")
    if intensity is None:
        raise Inexpressible("it says no intensity", node.span)
    ctx.weather[f"{node.action}_intensity"] = intensity
    if ctx.weather.get("rain_intensity", 0.0) > 0.0 and ctx.weather.get("snow_intensity", 0.0) > 0:
        raise Inexpressible("OpenSCENARIO XML has one precipitation, not rain and snow", node.span)
    if ctx.version == "1.0" and intensity > 0.0:
        ctx.report.approximate(
            f"action {node.action}",
            node.span,
            "the intensity has no unit in OpenSCENARIO XML 1.0",
            f"1 stands for {HEAVIEST_RAIN:g} mm/h and more",
            Remedy(version="1.1"),
        )
    return (environment_action(ctx, node, _precipitation(ctx)),)


def _precipitation(ctx: Context) -> Element:
    kind, intensity = "dry", 0.0
    for name in ("rain", "snow"):
        amount = ctx.weather.get(f"{name}_intensity", 0.0)
        if amount > 0.0:
            kind, intensity = name, round(amount / MMPH, 9)
    if ctx.version == "1.0":
        relative = round(min(intensity / HEAVIEST_RAIN, 1.0), 6)
        return element("Precipitation", precipitationType=kind, intensity=relative)
    return element("Precipitation", precipitationType=kind, precipitationIntensity=intensity)


# --- the environment as a whole -----------------------------------------------------------------


def environment_action(
    ctx: Context,
    node: ir.Invoke,
    *weather: Element,
    temperature: float | None = None,
    pressure: float | None = None,
    cover: str | None = None,
    state: str | None = None,
) -> Element:
    """Return the action that changes parts of the weather; 1.0 has to state all of it."""
    parts = {part.name: part for part in weather}
    time_of_day = None
    if ctx.version == "1.0":
        everything = (_sun(ctx), _fog(ctx), _precipitation(ctx))
        parts = {part.name: part for part in everything}
        state = _cloud_state(ctx)
        time_of_day = element("TimeOfDay", animation=False, dateTime=NOON)
    return element(
        "GlobalAction",
        element(
            "EnvironmentAction",
            element(
                "Environment",
                time_of_day,
                element(
                    "Weather",
                    *parts.values(),
                    temperature=temperature,
                    atmosphericPressure=pressure,
                    fractionalCloudCover=cover,
                    cloudState=state,
                ),
                _road(ctx),
                name=ctx.names.new(f"environment_{node.action}"),
            ),
        ),
    )


def _road(ctx: Context) -> Element | None:
    """Return how slippery roads are: the DSL leaves that to the world, tools have to be told."""
    adhesion = ADHESION.get(road_condition(ctx.weather))
    if adhesion is None and ctx.version > "1.0" and "was_slippery" not in ctx.weather:
        return None
    if adhesion is not None:
        ctx.weather["was_slippery"] = 1.0
    return element("RoadCondition", frictionScaleFactor=1.0 if adhesion is None else adhesion)


# --- lights of vehicles -------------------------------------------------------------------------


@action("set_lights")
def _set_lights(leaf: Leaf) -> Performance:
    ctx = leaf.ctx
    mode = leaf.arguments.text("mode") or leaf.arguments.member("mode", "auto")
    if mode == "auto":
        mode = "low_beam" if ctx.weather.get("sun_elevation", DARK) < DARK else "off"
    if mode not in LIGHTS:
        raise Inexpressible(f"there is no counterpart of the light mode `{mode}`", leaf.node.span)
    # The schema of 1.2 asks for both alternatives of each choice at once.
    ctx.require("a light", "1.3", leaf.node.span)
    ctx.require_support("LightStateAction", leaf.node.span)
    actions = tuple(_light(light, state) for light, state in LIGHTS[mode].items())
    return Performance((Change("lights", actions, 0.0, leaf.state, leaf.state),), "instant")


def _light(light: str, state: str) -> Element:
    return element(
        "PrivateAction",
        element(
            "AppearanceAction",
            element(
                "LightStateAction",
                element("LightType", element("VehicleLight", vehicleLightType=light)),
                element("LightState", mode=state),
            ),
        ),
    )
