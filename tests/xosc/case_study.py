"""The scenario of the case study, with what its users supply at run time."""

from __future__ import annotations

from pathlib import Path

from osc2tx.options import CompileOptions, XmlOptions, XmlProfile, XmlVersion
from osc2tx_runtime import RunSettings

SCENARIO = Path(__file__).parents[2] / "scenarios" / "hello_world.osc"
OPTIONS = CompileOptions(dialect="carla")


def maps_in(test_data: Path) -> Path:
    """Return the folder with its map."""
    return test_data / "maps" / "carla-2020"


def run_settings(maps: Path, dt: float) -> RunSettings:
    """Return the settings of a run in the world."""
    return RunSettings(
        dt=dt,
        signal={"go_signal": 1.0},
        spawn={"hero": ("16", -3, 5.0)},
        destination={"hero": "obstacle", "npc": "obstacle"},
        map_path=(maps,),
    )


def xml_options(
    maps: Path, profile: XmlProfile, version: XmlVersion = "1.3", *, allow_approx: bool = False
) -> XmlOptions:
    """Return the same for its document."""
    return XmlOptions(
        profile=profile,
        version=version,
        allow_approx=allow_approx,
        signals=("go_signal@1s",),
        spawns=("hero=16,-3,5",),
        map_path=(str(maps),),
    )
