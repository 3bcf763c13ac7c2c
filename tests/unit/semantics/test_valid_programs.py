"""Programs that use the language to its edges; there is nothing to report about them."""

from pathlib import Path

import pytest

from osc2tx.analysis import analyse
from tests.unit.semantics.support import build_file, build_text

PROGRAMS = sorted((Path(__file__).parent / "valid").glob("*.osc"))


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_a_valid_program_is_accepted(path: Path) -> None:
    model, sink = build_file(path)
    assert [d.message for d in sink.sorted()] == []
    analyse(model, sink)
    assert not sink.has_errors, sink.sorted()


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_a_program_of_2_1_is_one_of_2_2(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    _, sink = build_text(text, standard="2.2")
    assert [d.message for d in sink.sorted()] == []
