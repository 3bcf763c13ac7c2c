"""What tests of the build have: a project, and a cache of their own.

With that they remember builds of theirs, whoever edits osc2tx meanwhile.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from osc2tx.building import result_cache
from tests.unit.building.projects import Project


@pytest.fixture(autouse=True)
def cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("OSC2TX_NO_CACHE", raising=False)
        for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
            patch.setenv(name, str(folder))
        patch.setattr(result_cache, "tool_stamp", lambda cache: "this osc2tx")
        yield folder


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)
