"""Loss reports have the form that `docs/xml-report.md` describes."""

import json
import re
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from osc2tx.backends.xosc.report import Grade
from tests.golden.test_xosc import CASES, written

DOCS = Path(__file__).parents[4] / "docs"
SCHEMA = json.loads((DOCS / "xml-report.schema.json").read_text(encoding="utf-8"))


def faults(report: object) -> list[str]:
    return [error.message for error in Draft202012Validator(SCHEMA).iter_errors(report)]


def test_the_schema_is_one() -> None:
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_reports_fit_it(case: Path) -> None:
    for version in ("1.0", "1.3"):
        found = written(case, version)
        report = json.loads(found.report_json)
        assert faults(report) == []
        assert report["written"] is (found.xml is not None)
        entries = found.report.entries
        exact = [entry.construct for entry in entries if entry.grade is Grade.EXACT]
        assert report["exact"] == {name: exact.count(name) for name in sorted(set(exact))}
        lost = [(entry["grade"], entry["construct"]) for entry in report["losses"]]
        assert lost == [
            (entry.grade.value, entry.construct)
            for entry in entries
            if entry.grade is not Grade.EXACT
        ]


def test_places_are_paths_of_labels_and_texts() -> None:
    """A report stays as it is when lines move."""
    (case,) = (case for case in CASES if case.name == "computed_condition")
    text = (case / "input.osc").read_text(encoding="utf-8")
    (loss,) = json.loads(written(case, "1.3").report_json)["losses"]
    assert loss["within"].split(".")[0] == "computed_condition"
    assert loss["text"] in text
    assert all(f"{label}:" in text for label in loss["within"].split("."))


def test_the_schema_refuses() -> None:
    (case,) = (case for case in CASES if case.name == "computed_condition")
    report = json.loads(written(case, "1.3").report_json)
    assert faults(report | {"written": 1}) and faults(report | {"more": 1})
    (loss,) = report["losses"]
    assert faults(report | {"losses": [{key: loss[key] for key in loss if key != "reason"}]})
    for grade in ("exact", "approximated", "lost"):
        assert faults(report | {"losses": [loss | {"grade": grade}]})


def test_the_example_of_the_page_is_true() -> None:
    page = (DOCS / "xml-report.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    shown = json.loads(example)
    (case,) = (case for case in CASES if case.name == shown["scenario"])
    real = json.loads(written(case, "1.3").report_json)
    assert shown == real
