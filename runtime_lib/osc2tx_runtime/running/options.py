"""The options of a run: the table for both command lines, and their parsers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, cast, get_args

from osc2tx_runtime.errors import OwnCode, SettingsError
from osc2tx_runtime.language.settings import FAIL_ON, RunSettings
from osc2tx_runtime.plain_numbers import to_float, to_int
from osc2tx_runtime.world.protocol import ControlMode
from osc2tx_runtime.worlds import Option, find_world
from osc2tx_runtime.worlds.world_type import NUMBER_AND_UNIT, parse_pair, parse_seconds
from osc2tx_shared.steps import DEFAULT_STEP

CONTROLS: tuple[str, ...] = get_args(ControlMode)


def parse_signal(text: str) -> tuple[str, float]:
    """Read `go_signal@1s`."""
    example = "--signal go_signal@1s"
    name, at, time = text.partition("@")
    if not at or not name.strip():
        raise SettingsError(f"--signal {text}: write NAME@SECONDS, as in {example}")
    seconds = parse_seconds(time, example)
    if seconds < 0:
        raise SettingsError(f"--signal {text}: the time is negative; the scenario starts at 0s")
    return name.strip(), seconds


def parse_spawn(text: str) -> tuple[str, tuple[str, int, float]]:
    """Read `hero=16,-3,10`."""
    actor, place = parse_pair(text, "--spawn", "ACTOR=ROAD,LANE,S", "hero=16,-3,10")
    parts = [part.strip() for part in place.split(",")]
    try:
        road, lane, s = parts
        return actor, (road, to_int(lane), to_float(s))
    except ValueError:
        raise SettingsError(
            f"--spawn {text}: write ACTOR=ROAD,LANE,S with a road id, a lane id and metres along"
            " the road, as in --spawn hero=16,-3,10"
        ) from None


def parse_destination(text: str) -> tuple[str, str]:
    """Read `hero=obstacle` or `hero=16,-3,200`."""
    return parse_pair(text, "--destination", "ACTOR=ACTOR or ACTOR=ROAD,LANE,S", "hero=obstacle")


def parse_set(text: str) -> tuple[str, float | str]:
    """Read `v=12.5`; other texts are unchanged: `v=60kph` is read when the unit is known."""
    name, value = parse_pair(text, "--set", "NAME=VALUE", "v=12.5")
    try:
        return name, to_float(value)
    except ValueError:
        if (found := NUMBER_AND_UNIT.fullmatch(value)) and not found[2]:
            raise SettingsError(f"--set {text}: the value is larger than any number") from None
        return name, value


def parse_seed(text: str) -> int:
    """Read a whole number."""
    try:
        return to_int(text)
    except ValueError:
        raise SettingsError(f"--seed {text}: write a whole number, as in --seed 7") from None


def parse_control(text: str) -> dict[str, ControlMode]:
    """Read `driven`, `hero=external` or `exact,hero=external`; `""` stands for all others."""
    found: dict[str, ControlMode] = {}
    for part in text.split(","):
        actor, _, mode = part.rpartition("=")
        if mode.strip() not in CONTROLS or ("=" in part and not actor.strip()):
            raise SettingsError(
                f"--control {text}: write MODE[,ACTOR=MODE] with {' or '.join(CONTROLS)}, as in"
                " --control driven,hero=external"
            )
        found[actor.strip()] = cast(ControlMode, mode.strip())
    return found


def parse_physics(text: str) -> str:
    """Read `warn` or `fail`."""
    if text not in ("warn", "fail"):
        raise SettingsError(f"--physics {text}: write warn or fail")
    return text


def parse_conduct(text: str) -> str:
    """Read `as_told` or `standard`."""
    if text not in ("as_told", "standard"):
        raise SettingsError(f"--conduct {text}: write as_told or standard")
    return text


def parse_fail_on(text: str) -> tuple[str, ...]:
    """Read `collision` or `collision,red_light`."""
    names = tuple(part.strip() for part in text.split(","))
    for name in names:
        if name not in FAIL_ON:
            raise SettingsError(f"--fail-on {text}: write {', '.join(FAIL_ON)} or several of them")
    return names


def _joined(given: Iterable[tuple[str, ...]]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for names in given for name in names))


def _merged(controls: Iterable[Mapping[str, ControlMode]]) -> dict[str, ControlMode]:
    return {actor: mode for given in controls for actor, mode in given.items()}


OPTIONS: tuple[Option, ...] = (
    Option("map-path", "PATH", "folder with maps, or the map itself (.xodr)", Path, tuple),
    Option(
        "world",
        "NAME",
        "world that executes the scenario; its options: --world NAME --help",
        str.strip,
        default="embedded",
    ),
    Option(
        "control",
        "MODE[,ACTOR=MODE]",
        "control mode of the actors: exact, exact-physics, driven, external, autopilot",
        parse_control,
        _merged,
    ),
    Option.flag("expect", "actions of external actors are expected of them"),
    Option(
        "physics",
        "warn|fail",
        "reaction to motions beyond the grip limit",
        parse_physics,
        default="warn",
    ),
    Option(
        "conduct",
        "as_told|standard",
        "whether actors avoid collisions and obey lights where the scenario leaves it open",
        parse_conduct,
        default="as_told",
    ),
    Option(
        "fail-on",
        "collision|off_road|red_light",
        "fail the run if this happens, whatever the scenario states",
        parse_fail_on,
        _joined,
    ),
    Option("signal", "NAME@SECONDS", "emit the event NAME at a time", parse_signal, dict),
    Option("spawn", "ACTOR=ROAD,LANE,S", "start position of an actor", parse_spawn, dict),
    Option(
        "destination",
        "ACTOR=GOAL",
        "destination of a vehicle: actor or R,L,S",
        parse_destination,
        dict,
    ),
    Option("set", "NAME=VALUE", "value of a parameter: v=60kph, or in SI units", parse_set, dict),
    Option("seed", "N", "seed of all that is sampled", parse_seed, default=0),
    Option(
        "dt",
        "SECONDS",
        "length of a step",
        lambda t: parse_seconds(t, "--dt 0.05"),
        default=DEFAULT_STEP,
    ),
    Option(
        "max-time",
        "SECONDS",
        "end the run at this time, with a failure",
        lambda t: parse_seconds(t, "--max-time 60"),
        default=300.0,
    ),
    Option("trace", "FILE", "write the trace (JSON Lines)", Path, is_trusted=True),
    Option("report", "FILE", "write the report (HTML)", Path, is_trusted=True),
    Option(
        "allow-external",
        "MODULE.FUNCTION",
        "let the scenario call this Python function",
        str.strip,
        tuple,
        is_trusted=True,
    ),
)


def read_options(
    texts: Mapping[str, str | Sequence[str] | None], *, is_trusted: bool = True
) -> RunSettings:
    """Build settings from the texts of a command line or of a settings file.

    Args:
        texts: Option name (`map-path` or `map_path`) to its text: one text, a sequence for
            repeatable options, None or missing for the default. Flags: `true`.
        is_trusted: Whether they come from the user, as on a command line.

    Raises:
        SettingsError: A text does not have the form of its option, the chosen world has no such
            option, or only the command line may state it.
    """
    given = {
        name.replace("_", "-"): [text] if isinstance(text, str) else list(text)
        for name, text in texts.items()
        if text is not None and text != () and text != []
    }
    values = _take(OPTIONS, given, is_trusted)
    if given:
        world = find_world(values.get("world", "embedded"))
        with OwnCode(f"an option of the world {world.name} cannot be read:", error=SettingsError):
            values["world_options"] = _take(world.options, given, is_trusted)
    if given:
        raise SettingsError(f"unknown option --{min(given)}")
    return RunSettings(**values)


def _take(
    options: Iterable[Option], given: dict[str, list[str]], is_trusted: bool
) -> dict[str, Any]:
    """Read the given options of a list, and remove them."""
    found = {}
    for option in options:
        if option.name in given:
            if option.is_trusted and not is_trusted:
                raise SettingsError(f"`{option.name}` is for the command line alone")
            found[option.field] = option.read(given.pop(option.name))
    return found
