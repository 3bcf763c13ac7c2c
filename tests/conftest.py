"""Shared fixtures: golden files and the optional test data; how properties are tried."""

import gc
import os
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import HealthCheck, settings

from osc2tx.start import collect_rarely

DATA_VARIABLE = "OSC2TX_TEST_DATA"
RUNS_VARIABLE = "OSC2TX_TESTS_RUNS"  # read by tests/unit/backends/xosc/kept_runs.py

# The same examples each time, and no clock decides: the machine may be busy.
# tests/fuzz/run.py tries other ones for as long as one likes.
settings.register_profile(
    "osc2tx",
    max_examples=50,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
settings.load_profile("osc2tx")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden", action="store_true", help="rewrite expected files instead of comparing"
    )


def pytest_configure(config: pytest.Config) -> None:
    if not hasattr(config, "workerinput"):  # those of pytest-xdist inherit it
        config.add_cleanup(own_environment())
    if config.getoption("--update-golden") and os.environ.get("CI"):
        raise pytest.UsageError("--update-golden is refused when CI is set")


def own_environment() -> Callable[[], None]:
    """Give tests a cache of their own, and none of our plugins to the pytest that they start.

    Beside it are the runs that they share.

    pytest-lsp brings pytest-asyncio, which warns where it is not configured.

    Returns:
        What ends it.
    """
    stack = ExitStack()
    folder = stack.enter_context(TemporaryDirectory(prefix="osc2tx-tests-"))
    patch = stack.enter_context(pytest.MonkeyPatch.context())
    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        patch.setenv(name, folder)
    patch.setenv(RUNS_VARIABLE, str(Path(folder, "runs")))
    patch.setenv("PYTEST_ADDOPTS", "-p no:asyncio")
    return stack.close


def pytest_collection_finish() -> None:
    """Look for garbage as rarely as the command does, and not among what is there to stay."""
    gc.collect()
    gc.freeze()
    collect_rarely()


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Callable[[str | None, Path], None]:
    """Compare a text with an expected file, or rewrite that file under --update-golden.

    Where there is no text there is to be no file.
    """

    def check(actual: str | None, expected: Path) -> None:
        if request.config.getoption("--update-golden"):
            if actual is None:
                expected.unlink(missing_ok=True)
                return
            expected.parent.mkdir(parents=True, exist_ok=True)
            expected.write_text(actual, encoding="utf-8", newline="\n")
            return
        if actual is None:
            assert not expected.exists(), f"{expected} is left over"
            return
        if not expected.exists():
            pytest.fail(f"missing golden file {expected}; run pytest --update-golden")
        assert actual == expected.read_text(encoding="utf-8")

    return check


@pytest.fixture(scope="session")
def test_data() -> Path:
    """Folder of public scenarios and maps that are not part of the product."""
    folder = os.environ.get(DATA_VARIABLE)
    if not folder or not Path(folder).is_dir() or not any(Path(folder).iterdir()):
        pytest.skip(f"{DATA_VARIABLE} does not name a folder with test data")
    return Path(folder)
