"""Poses that are written: what happens in CARLA is what happens in the embedded world."""

from __future__ import annotations

from pathlib import Path

import pytest

from .runs import GENERATED, in_carla, in_the_world, lines_of, modules, run_all, settings_for
from .stand_in.process import StandInProcess

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("module", modules(), ids=lambda path: path.relative_to(GENERATED).stem)
def test_all_modules_leave_the_same_trace(module: Path, towns: StandInProcess) -> None:
    """To the byte, after the header; towing included. Errors are the same errors."""
    here = in_the_world(module)
    there = run_all(module, in_carla(settings_for(module), towns.port))
    assert {name: lines_of(result) for name, result in there.items()} == {
        name: lines_of(result) for name, result in here.items()
    }
    assert towns.ask("stand_in_actors") == {}
    assert towns.ask("stand_in_unknown") == {}
