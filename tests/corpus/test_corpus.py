"""Public scenarios parse, check and build at least as well as they did."""

import warnings
from pathlib import Path

import pytest

from tests.corpus.report import Result, bugs, compare, compile_corpus, count, read_expected


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
