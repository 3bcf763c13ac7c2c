"""Reader of traffic light control files (`map.set_traffic_lights_control_file`).

The standard leaves the format open. Here it is JSON, a list with one object per cycle:

    [{"group": "1", "synchronization_group_id": 1, "start_offset": 0,
      "phases": [{"state": "go", "duration": 20}, {"state": "stop_attention", "duration": 3}]}]

`group` is the OpenDRIVE id of a controller; `state` is a `semantic_traffic_light_state`, or a list
with a `bulb_state` for each lamp; times are in seconds.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

from osc2tx_runtime.domain.signals.traffic_lights import (
    Bulbs,
    Shown,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
)
from osc2tx_runtime.enums import BulbState, SemanticTrafficLightState
from osc2tx_runtime.errors import InputError
from osc2tx_shared.map_files import SHIPPED

_CYCLE = {"group", "phases", "start_offset", "synchronization_group_id"}
_PHASE = {"state", "duration"}


def read_control_file(name: str, folders: Sequence[Path]) -> list[TrafficLightCycle]:
    """Return the cycles of a file.

    Args:
        name: As stated in the scenario, searched like a map.
        folders: Of the settings.

    Raises:
        InputError: There is no such file, or its format is wrong.
    """
    path = _find(name, folders)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(content, list):
            raise ValueError("it is not a list of cycles")
        return [_cycle(entry) for entry in content]
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"the cycles in {name} cannot be read: {error}") from error


def _find(name: str, folders: Sequence[Path]) -> Path:
    if Path(name).is_absolute() or ".." in Path(name).parts:
        raise InputError(f"{name}: the file must be inside of the folders of --map-path")
    places = [folder for folder in folders if folder.is_dir()]
    for folder in (*places, *(file.parent for file in folders if file.is_file()), SHIPPED):
        if (folder / name).is_file():
            return folder / name
    searched = ", ".join(str(folder) for folder in folders) or "nowhere: give --map-path"
    raise InputError(
        f"there is no file {name} with the cycles of traffic lights; searched {searched}"
    )


def _cycle(entry: Any) -> TrafficLightCycle:
    _check(entry, "a cycle", _CYCLE, {"group", "phases"})
    group = TrafficLightGroup(map_id=str(entry["group"]))
    if not isinstance(entry["phases"], list):
        raise ValueError("phases are not a list")
    number = entry.get("synchronization_group_id")
    return TrafficLightCycle(
        tuple(_phase(each, group) for each in entry["phases"]),
        None if number is None else int(number),
        _seconds(entry.get("start_offset", 0.0)),
    )


def _phase(entry: Any, group: TrafficLightGroup) -> TrafficLightPhase:
    _check(entry, "a phase", _PHASE, _PHASE)
    return TrafficLightPhase(group, _state(entry["state"]), _seconds(entry["duration"]))


def _state(value: Any) -> Bulbs:
    if value in get_args(SemanticTrafficLightState):
        return Shown(value)
    if isinstance(value, list) and value and all(each in get_args(BulbState) for each in value):
        return value
    raise ValueError(f"{json.dumps(value)} is neither a meaning nor a list of bulb states")


def _seconds(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{json.dumps(value)} is not a time in seconds")
    return float(value)


def _check(entry: Any, what: str, known: set[str], needed: set[str]) -> None:
    if not isinstance(entry, Mapping):
        raise ValueError(f"{what} is not an object")
    for name in (*sorted(needed - entry.keys()), *sorted(entry.keys() - known)):
        word = "has no" if name in needed else "knows no"
        raise ValueError(f"{what} {word} {name}")
