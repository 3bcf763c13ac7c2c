"""Texts of marks on the page, for each kind of line."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from .json_values import Json, number, text

_DEGREES = 180.0 / math.pi
# Values of the environment: text before, factor and offset from SI units, unit after.
_WEATHER = {
    "temperature": ("", 1.0, -273.15, " °C"),
    "pressure": ("pressure ", 0.01, 0.0, " hPa"),
    "relative_humidity": ("humidity ", 100.0, 0.0, " %"),
    "rain_intensity": ("rain ", 3.6e6, 0.0, " mm/h"),
    "snow_intensity": ("snow ", 3.6e6, 0.0, " mm/h"),
    "wind_speed": ("wind ", 3.6, 0.0, " km/h"),
    "wind_direction": ("wind from ", _DEGREES, 0.0, "°"),
    "visual_range": ("sight ", 1.0, 0.0, " m"),
    "cloudiness": ("clouds ", 1.0, 0.0, "/8"),
    "sun_elevation": ("sun elevation ", _DEGREES, 0.0, "°"),
    "sun_azimuth": ("sun azimuth ", _DEGREES, 0.0, "°"),
    "moon_elevation": ("moon elevation ", _DEGREES, 0.0, "°"),
    "moon_azimuth": ("moon azimuth ", _DEGREES, 0.0, "°"),
}


def mark_name(kind: str, line: Json) -> str | None:
    """Return the text of a line; None for an unknown kind."""
    words = _WORDS.get(kind)
    return None if words is None else words(line)


def _event(line: Json) -> str:
    values = line.get("arguments")
    if not isinstance(values, dict) or not values:
        return text(line.get("name"))
    arguments = ", ".join(f"{name} {text(value)}" for name, value in values.items())
    return f"{text(line.get('name'))} ({arguments})"


def _environment(line: Json) -> str:
    return ", ".join(_weather(key, value) for key, value in line.items() if key not in _COMMON)


_COMMON = ("t", "kind")


def _weather(name: str, value: object) -> str:
    """A value of the environment in common units."""
    amount = number(value)
    if amount is None or name not in _WEATHER:
        return f"{name} {text(value)}"
    words, factor, offset, unit = _WEATHER[name]
    return f"{words}{amount * factor + offset:.4g}{unit}"


def _collision(line: Json) -> str:
    actors = line.get("actors")
    return " and ".join(map(text, actors)) if isinstance(actors, list) else text(actors)


def _sample(line: Json) -> str:
    """A value of coverage, with its slice, as `speed_then = 50.7 kph in [40, 55]`."""
    words = f"{text(line.get('name'))} = {_values(line.get('value'))} {text(line.get('unit'))}"
    if line.get("bucket") is not None:
        words += f" in {text(line.get('bucket'))}"
    notes = (f"{key}: {text(line[key])}" for key in ("illegal", "target", "text") if key in line)
    return ", ".join((words.strip(), *notes))


def _values(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} {_values(each)}" for name, each in value.items())
    amount = number(value)
    return text(value) if amount is None else f"{amount:.6g}"


def _size(line: Json) -> str:
    model, source = text(line.get("model")), text(line.get("source"))
    return f"model {model} is not known; its box is that of its {source}"


def _box(line: Json) -> str:
    length, width, height = (_values(line.get(key)) for key in ("length", "width", "height"))
    return f"{length} m long, {width} m wide and {height} m high in the simulator"


_WORDS: Mapping[str, Callable[[Json], str]] = {
    "event": _event,
    "lights": lambda line: text(line.get("mode")),
    "signal": lambda line: f"{text(line.get('signal'))}: {text(line.get('state'))}",
    "environment": _environment,
    "collision": _collision,
    "choice": lambda line: f"{text(line.get('name'))}: {text(line.get('chosen'))}",
    "override": lambda line: " ".join(
        (text(line.get("name")), text(line.get("what")), "because of", text(line.get("by")))
    ),
    "variable": lambda line: f"{text(line.get('name'))} = {_values(line.get('value'))}",
    "cover": _sample,
    "record": _sample,
    "size": _size,
    "jack_knife": lambda line: f"at {_values(line.get('angle'))}° to {text(line.get('tow'))}",
    "simulator_collision": lambda line: f"{text(line.get('actor'))} and {text(line.get('other'))}",
    "simulator_displaced": lambda line: f"{_values(line.get('distance'))} m from its position",
    "simulator_removed": lambda line: "removed by the simulator",
    "simulator_size": _box,
    "criterion": lambda line: text(line.get("what")),
    "violation": lambda line: f"{text(line.get('modifier'))}: {text(line.get('what'))}",
}
