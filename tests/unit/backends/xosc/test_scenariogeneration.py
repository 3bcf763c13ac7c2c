"""The parser of `scenariogeneration`, by which many read OpenSCENARIO XML in Python.

Its import takes longer than most tests: it is for the process that carries these out.
"""

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from scenariogeneration.xosc import ParseOpenScenario

ROOT = Path(__file__).parents[4]
WRITTEN = [
    *(path for path in (ROOT / "generated").rglob("*.xosc") if ".params." not in path.name),
    *(ROOT / "tests" / "golden" / "xosc").glob("*/expected/scenario.xosc"),
]
UNKNOWN = "<RelativeClearanceCondition"
"""The parser has no word for it."""


@pytest.fixture(autouse=True)
def _is_valid(monkeypatch: pytest.MonkeyPatch) -> None:
    """Schemas are tested elsewhere, by a library that takes much less time."""
    monkeypatch.setattr("scenariogeneration.xosc.xosc_reader.validate_schema", lambda _: True)


def parsed(path: Path) -> "ParseOpenScenario":
    from scenariogeneration.xosc import ParseOpenScenario

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ParseOpenScenario(str(path))


def loads(path: Path) -> bool:
    """Whether it has words for a document, and then loads all of its actors."""
    from scenariogeneration.xosc import NotAValidElement

    text = path.read_text(encoding="utf-8")
    if UNKNOWN in text:
        with pytest.raises(NotAValidElement):
            parsed(path)
        return False
    found = parsed(path)
    names = [each.name for each in found.entities.scenario_objects]
    assert all(f'<ScenarioObject name="{name}"' in text for name in names), path
    assert len(names) == text.count("<ScenarioObject "), path
    return True


def test_it_loads_a_document() -> None:
    assert loads(ROOT / "generated" / "follow_leader.xosc")


@pytest.mark.slow
def test_it_loads_every_document_that_it_has_words_for() -> None:
    assert sum(map(loads, WRITTEN)) > len(WRITTEN) // 2
