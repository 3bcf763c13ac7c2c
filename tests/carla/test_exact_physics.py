"""Bodies with physics that their velocities bring to each pose: others see how fast they are."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime import RunResult, RunSettings
from osc2tx_runtime.simulators.carla.frames import measurement_from, turning_of

from .runs import GENERATED, happenings, in_carla, lines_of, modules, run_all, settings_for
from .stand_in.process import StandInProcess

DT = 0.05


@pytest.mark.slow
@pytest.mark.parametrize("module", modules(), ids=lambda path: path.relative_to(GENERATED).stem)
def test_all_modules_leave_the_same_trace(module: Path, towns: StandInProcess) -> None:
    """As with poses that are written, but for the control modes in the header."""
    settings = settings_for(module)
    physics = in_carla(settings, towns.port, control={"": "exact-physics"})
    here, there = run_all(module, settings), run_all(module, physics)
    assert {name: lines_of(result) for name, result in there.items()} == {
        name: lines_of(result) for name, result in here.items()
    }
    assert towns.ask("stand_in_actors") == {}
    assert towns.ask("stand_in_unknown") == {}
