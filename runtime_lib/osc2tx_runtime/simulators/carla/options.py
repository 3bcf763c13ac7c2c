"""Options of this world, and their texts."""

from __future__ import annotations

from pathlib import Path

from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.plain_numbers import to_int
from osc2tx_runtime.worlds import Option
from osc2tx_runtime.worlds.option import parse_pair, parse_seconds

__all__ = ["DEFAULT_ADDRESS", "OPTIONS", "PATIENCE", "TIMEOUT"]

DEFAULT_ADDRESS = ("127.0.0.1", 2000)
TIMEOUT = 10.0
"""How long (s) the server may take for a call."""

PATIENCE = 60.0
"""How long (s) to wait for an actor that somebody else spawns."""


def parse_address(text: str) -> tuple[str, int]:
    """Read `localhost:2000`, `localhost` or `:2000`."""
    host, _, port = text.strip().partition(":")
    try:
        number = to_int(port) if port else DEFAULT_ADDRESS[1]
        if not 0 < number < 65536:
            raise ValueError("no port")
        return host or DEFAULT_ADDRESS[0], number
    except ValueError:
        raise SettingsError(
            f"--carla {text}: write HOST:PORT, as in --carla localhost:2000"
        ) from None


def parse_wait(text: str) -> tuple[str, float]:
    """Read `hero` or `hero=60s`."""
    actor, equals, patience = text.strip().partition("=")
    if not equals:
        return actor, PATIENCE
    return actor, parse_seconds(patience, "--wait-for hero=60s")


def parse_sensors(text: str) -> tuple[str, Path]:
    """Read `hero=stack.json`."""
    actor, file = parse_pair(text, "--sensors", "ACTOR=FILE", "hero=stack.json")
    return actor, Path(file)


OPTIONS: tuple[Option, ...] = (
    Option("carla", "HOST:PORT", "where the server is", parse_address, default="localhost:2000"),
    Option.flag("carla-load", "load the scenario's map if the server has another one"),
    Option(
        "carla-timeout",
        "SECONDS",
        "how long the server may take to answer",
        lambda text: parse_seconds(text, "--carla-timeout 10"),
        default=TIMEOUT,
    ),
    Option(
        "wait-for",
        "ACTOR[=SECONDS]",
        "take this actor from whom spawns it, and leave it in the end",
        parse_wait,
        dict,
    ),
    Option("sensors", "ACTOR=FILE", "sensors to attach to an actor (JSON)", parse_sensors, dict),
    Option.flag("no-tick", "another client makes the steps"),
)
