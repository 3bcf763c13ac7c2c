"""A cache of the tests' own: they remember builds of theirs, whoever edits osc2tx meanwhile."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from osc2tx.building import memory


@pytest.fixture(scope="session", autouse=True)
def cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("OSC2TX_NO_CACHE", raising=False)
        for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
            patch.setenv(name, str(folder))
        patch.setattr(memory, "tool_stamp", lambda: "this osc2tx")
        yield folder
