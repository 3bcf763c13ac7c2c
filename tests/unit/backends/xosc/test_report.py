"""Loss reports have the form that `docs/xml-report.md` describes."""

import json
import re
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

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
        grades = [entry["grade"] for entry in report["constructs"]]
        assert report["counts"] == {grade: grades.count(grade) for grade in report["counts"]}
        places = [(entry["line"], entry["column"]) for entry in report["constructs"]]
        assert places == sorted(places)


def test_the_schema_refuses() -> None:
    report = json.loads(written(CASES[0], "1.3").report_json)
    assert faults(report | {"written": 1}) and faults(report | {"more": 1})
    entry = {key: value for key, value in report["constructs"][0].items() if key != "reason"}
    for grade in ("inexpressible", "approximated", "lost"):
        assert faults(report | {"constructs": [entry | {"grade": grade}]})


def test_the_example_of_the_page_is_true() -> None:
    page = (DOCS / "xml-report.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    shown = json.loads(example)
    (case,) = (case for case in CASES if case.name == shown["scenario"])
    real = json.loads(written(case, "1.3").report_json)
    wrong = [entry for entry in real["constructs"] if entry["grade"] != "exact"]
    assert shown == real | {"constructs": wrong}
