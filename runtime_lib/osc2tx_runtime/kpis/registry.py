"""Measures by name: those of this package, and those of installed packages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError

from .encroachment import MinEncroachment
from .measure import Measure
from .motion import MaxDeceleration, MaxJerk, MaxLateralAcceleration
from .pairs import MinGap, MinTimeGap, MinTimeToCollision
from .rules import Collisions, OffRoad, RedLights

__all__ = ["ENTRY_POINTS", "MEASURES", "measures_by_name"]

ENTRY_POINTS = "osc2tx.kpis"
"""Group of entry points; each names a class of measures, by the name that `--kpi` takes."""

MEASURES: Mapping[str, Callable[[], Measure]] = {
    each.name: each
    for each in (
        MinTimeToCollision,
        MinGap,
        MinTimeGap,
        MinEncroachment,
        MaxDeceleration,
        MaxJerk,
        MaxLateralAcceleration,
        Collisions,
        OffRoad,
        RedLights,
    )
}
"""Those of this package; a campaign takes all of them where it names none."""


def measures_by_name(names: Sequence[str]) -> dict[str, Callable[[], Measure]]:
    """Return classes of measures.

    Raises:
        SettingsError: There is none of a name, or it cannot be loaded.
    """
    return {name: MEASURES[name] if name in MEASURES else _installed(name) for name in names}


def _installed(name: str) -> Callable[[], Measure]:
    from importlib.metadata import entry_points

    entries = {entry.name: entry for entry in entry_points(group=ENTRY_POINTS)}
    if name not in entries:
        known = ", ".join([*MEASURES, *sorted(entries)])
        raise SettingsError(f"--kpi {name}: there is no such measure; there is: {known}")
    try:
        with OwnCode(f"--kpi {name}: {entries[name].value}:"):
            found: Callable[[], Measure] = entries[name].load()
    except ScenarioError as error:
        raise SettingsError(error.message) from error
    if not callable(found):
        raise SettingsError(f"--kpi {name}: {entries[name].value} is no class")
    return found
