"""Public scenarios parse, check and build at least as well as they did."""

import warnings
from pathlib import Path

import pytest

from tests.corpus.report import (
    Result,
    accepted,
    bugs,
    compare,
    compile_corpus,
    count,
    read_expected,
    read_reasons,
    reason_of,
)

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def results(test_data: Path) -> list[Result]:
    return compile_corpus(test_data / "corpus")


def test_numbers_only_rise(results: list[Result]) -> None:
    fell, rose = compare(count(results), read_expected())
    if rose:
        report = "; ".join(rose)
        warnings.warn(f"run `python tests/corpus/report.py --update`: {report}", stacklevel=1)
    assert not fell, "some files are treated worse than before; see tests/corpus/report.py"


def test_no_file_breaks_the_compiler(results: list[Result]) -> None:
    assert bugs(results) == []


def test_what_should_be_refused_is_accepted_for_a_reason(results: list[Result]) -> None:
    reasons = read_reasons()
    files = accepted(results)
    assert [file for file in files if reason_of(file, reasons) is None] == []
    assert {end for end in reasons if not any(f.endswith(end) for f in files)} == set()
