"""Settings of one run."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.world.protocol import ControlMode
from osc2tx_shared.classes import dataclass
from osc2tx_shared.steps import DEFAULT_STEP

MOST_STEPS = 100_000_000
"""Upper limit of the length of a run (steps): hours of computing."""

FAIL_ON = ("collision", "off_road", "red_light")
"""The criteria of a failed run."""


@dataclass(frozen=True, slots=True)
class RunSettings:
    """The settings of a run besides the scenario; every field has a default.

    Attributes:
        map_path: Folders searched for map files, before the maps of this package; a file among
            them is used as the map itself.
        world: Name of the world to run in.
        world_options: Values of the options of the world, by `Option.field`.
        control: Control mode of an actor, by id; `""` stands for all others. Default: of the world.
        expect: Commands to external actors become expectations, not errors.
        physics: Response to motions beyond the limits of tyres: `warn` or `fail`.
        conduct: `as_told`: actors follow the scenario alone; `standard`: they also avoid collisions
            and obey lights, unless the scenario states otherwise (DSL 8.9.18).
        fail_on: Further criteria of failure, see `FAIL_ON`.
        signal: Events given from outside: name to time in seconds.
        spawn: Start position of actors: id to (road id, lane id, road s in metres).
        destination: Destinations of vehicles: id to an actor id or `ROAD,LANE,S`.
        set: Values of the scenario's parameters, SI units: name to number or text.
        seed: Seed of all sampled values.
        draw: Number of the draw of the seed; earlier draws do not fit the map.
        dt: Length of a step in seconds.
        max_time: Simulated seconds after which the run ends with status `timeout`.
        trace: File of the trace (JSON Lines).
        report: File of the report (HTML).
        allow_external: Functions of the user that the scenario may call, `module.function`.
        draws: Returns the random number of a parameter, by its name; default: from the seed.
    """

    map_path: tuple[Path, ...] = ()
    world: str = "embedded"
    world_options: Mapping[str, Any] = field(default_factory=dict)
    control: Mapping[str, ControlMode] = field(default_factory=dict)
    expect: bool = False
    physics: str = "warn"
    conduct: str = "as_told"
    fail_on: tuple[str, ...] = ()
    signal: Mapping[str, float] = field(default_factory=dict)
    spawn: Mapping[str, tuple[str, int, float]] = field(default_factory=dict)
    destination: Mapping[str, str] = field(default_factory=dict)
    set: Mapping[str, float | str] = field(default_factory=dict)
    seed: int = 0
    draw: int = 0
    dt: float = DEFAULT_STEP
    max_time: float = 300.0
    trace: Path | None = None
    report: Path | None = None
    allow_external: tuple[str, ...] = ()
    draws: Callable[[str], random.Random] | None = None

    @property
    def draws_from(self) -> int | str:
        """The origin of the random numbers of parameters."""
        return f"{self.seed}/draw {self.draw}" if self.draw else self.seed

    def __post_init__(self) -> None:
        if not (math.isfinite(self.dt) and self.dt > 0):
            raise SettingsError(f"dt is {self.dt}: write a step length above zero, as in --dt 0.05")
        if not (math.isfinite(self.max_time) and self.max_time > 0):
            raise SettingsError(
                f"max-time is {self.max_time}: write seconds above zero, as in --max-time 60"
            )
        if self.max_time / self.dt > MOST_STEPS:
            raise SettingsError(
                f"dt {self.dt:g} until max-time {self.max_time:g} would be more than {MOST_STEPS:,}"
                " steps: give a larger --dt or a smaller --max-time"
            )
        for name, seconds in self.signal.items():
            if not (math.isfinite(seconds) and seconds >= 0):
                raise SettingsError(f"--signal {name}: {seconds} is not a time of a run")


def check_known(option: str, what: str, given: Any, known: Any) -> None:
    """Raise SettingsError for names in the settings that the scenario does not have."""
    for name in given:
        if name not in known:
            has = f"it has {', '.join(known)}" if known else "it has none"
            hint = near(name, known) or f" ({has})"
            raise SettingsError(f"{option} {name}: the scenario has no such {what}{hint}")


def near(name: str, known: Any) -> str:
    """Return a question that offers similar names, or nothing."""
    from difflib import get_close_matches  # only needed where something is wrong

    found = get_close_matches(name, sorted(known), n=3)
    return f"; did you mean {' or '.join(found)}?" if found else ""
