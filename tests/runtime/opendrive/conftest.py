"""Maps for the tests of the OpenDRIVE package."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

import osc2tx_runtime.opendrive
from osc2tx_runtime.opendrive import RoadMap, read_map

OWN_MAPS = Path(osc2tx_runtime.opendrive.__file__).parent.parent / "maps"


@cache
def _read(path: Path) -> RoadMap:
    return read_map(path)


@pytest.fixture(scope="session")
def maps_folder(test_data: Path) -> Path:
    """Folder of third-party maps."""
    folder = test_data / "maps"
    if not folder.is_dir():
        pytest.skip(f"no maps in {test_data}")
    return folder


@pytest.fixture(scope="session")
def load(maps_folder: Path) -> Callable[[str], RoadMap]:
    """Reads a third-party map by its path below the maps folder, once per session."""
    return lambda name: _read(maps_folder / f"{name}.xodr")


@pytest.fixture(scope="session")
def own() -> Callable[[str], RoadMap]:
    """Reads one of our own maps by name, once per session."""
    return lambda name: _read(OWN_MAPS / f"{name}.xodr")
