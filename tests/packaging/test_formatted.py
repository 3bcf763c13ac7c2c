"""The repository's own scenarios are laid out as `osc2tx fmt` does it."""

from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigFiles, GivenOptions

REPOSITORY = Path(__file__).parent.parent.parent
AS_GIVEN = {"hello_world.osc"}  # the text that the product began with stays as it is
OWN = sorted(
    path
    for folder in ("scenarios", "templates/project")
    for path in (REPOSITORY / folder).rglob("*.osc")
    if path.name not in AS_GIVEN
)


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_formatted(path: Path) -> None:
    options = ConfigFiles().for_source(path).options_for(path, GivenOptions())
    compilation = Compilation(path, path.name, options)
    assert compilation.formatted == path.read_text(encoding="utf-8")


def test_there_are_scenarios() -> None:
    assert len(OWN) > 60
