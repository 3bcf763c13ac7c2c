"""Loss reports have the form that `docs/xml-report.md` describes."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from osc2tx.losses.entries import Grade
from tests.golden.test_xosc import CASES, written

DOCS = Path(__file__).parents[4] / "docs"
SCHEMA = json.loads((DOCS / "xml-report.schema.json").read_text(encoding="utf-8"))
VALIDATOR = Draft202012Validator(SCHEMA)


def faults(report: object) -> list[str]:
    return [error.message for error in VALIDATOR.iter_errors(report)]


def test_the_schema_is_one() -> None:
    Draft202012Validator.check_schema(SCHEMA)


def unexplained(schema: dict[str, Any], path: str = "") -> Iterator[str]:
    """Yield the keys below a schema that have no description."""
    for key, value in schema.get("properties", {}).items():
        if "description" not in value and "$ref" not in value:
            yield f"{path}.{key}"
        yield from unexplained(value, f"{path}.{key}")
    inside = [schema["items"]] if "items" in schema else []
    for inner in (*inside, *schema.get("$defs", {}).values()):
        yield from unexplained(inner, f"{path}[]")


def test_each_key_is_explained() -> None:
    assert list(unexplained(SCHEMA)) == []


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_reports_fit_it(case: Path) -> None:
    for version in ("1.0", "1.3"):
        found = written(case, version)
        entries = found.report.entries
        lost = [
            (entry.grade.value, entry.construct)
            for entry in entries
            if entry.grade is not Grade.EXACT
        ]
        if found.report_json is None:
            assert found.xml is not None and not lost
            assert not any(entry.reason for entry in entries)
            continue
        report = json.loads(found.report_json)
        assert faults(report) == []
        assert report["written"] is (found.xml is not None)
        told = report["losses"]
        grades = [entry["grade"] for entry in told]
        assert grades == sorted(grades, reverse=True), "the worst comes first"
        each = [(e["grade"], e["construct"]) for e in told for _ in ("", *e.get("also", ()))]
        assert sorted(lost) == sorted(each)
        assert lost or report["notes"] or report["unmeasured"]


def test_an_exact_document_needs_no_report() -> None:
    reports = [written(case, "1.3").report_json for case in CASES]
    assert None in reports and any(reports)


def report_of(name: str) -> dict[str, Any]:
    (case,) = (case for case in CASES if case.name == name)
    text = written(case, "1.3").report_json
    assert text is not None
    return dict(json.loads(text))


def test_places_are_paths_of_labels_and_texts() -> None:
    """A report stays as it is when lines move."""
    (case,) = (case for case in CASES if case.name == "computed_condition")
    text = (case / "input.osc").read_text(encoding="utf-8")
    (loss,) = report_of(case.name)["losses"]
    assert loss["within"].split(".")[0] == "computed_condition"
    assert loss["text"] in text
    assert all(f"{label}:" in text for label in loss["within"].split("."))


def test_the_schema_refuses() -> None:
    report = report_of("computed_condition")
    assert faults(report | {"written": 1}) and faults(report | {"more": 1})
    (loss,) = report["losses"]
    assert faults(report | {"losses": [{key: loss[key] for key in loss if key != "reason"}]})
    for grade in ("exact", "approximated", "lost"):
        assert faults(report | {"losses": [loss | {"grade": grade}]})


def test_the_example_of_the_page_is_true() -> None:
    page = (DOCS / "xml-report.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    shown = json.loads(example)
    assert shown == report_of(shown["scenario"])
