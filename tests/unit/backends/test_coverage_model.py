"""Coverage models have the form that their schema explains, in short lines."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.golden.test_stages import HERE
from tests.unit.backends.xosc.test_report import unexplained

DOCS = Path(__file__).parents[3] / "docs"
SCHEMA = json.loads((DOCS / "coverage-model.schema.json").read_text(encoding="utf-8"))
COVERAGE = (HERE / "py_trees" / "coverage" / "input.osc").read_text(encoding="utf-8")
IMPOSSIBLE = """import osc.standard

enum light: [red, amber, green]

scenario sampled:
    ego: vehicle
    v: speed with:
        keep(it in [10kph..30kph])
    colour: light with:
        keep(it != amber)
    cover(v, unit: kph, range: [0..100], every: 2, target: 3, text: "how fast")
    cover(colour)
    cover(both, items: [v, colour])
    do ego.drive(duration: 1s) with:
        speed(v)
"""


def model_of(text: str, folder: Path) -> str:
    path = folder / "sampled.osc"
    path.write_text(text, encoding="utf-8")
    outputs = Compilation(path, path.name, CompileOptions()).module_outputs()
    (found,) = [each.text for each in outputs if each.suffix == ".coverage.json"]
    assert isinstance(found, str)
    return found


def test_the_schema_explains_each_key() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert list(unexplained(SCHEMA)) == []


@pytest.mark.parametrize("text", [COVERAGE, IMPOSSIBLE], ids=["golden", "impossible"])
def test_models_fit_it_in_short_lines(text: str, tmp_path: Path) -> None:
    model = model_of(text, tmp_path)
    faults = [each.message for each in Draft202012Validator(SCHEMA).iter_errors(json.loads(model))]
    assert faults == []
    assert max(map(len, model.splitlines())) <= 100


def test_what_constraints_exclude_is_listed_by_bucket(tmp_path: Path) -> None:
    found = json.loads(model_of(IMPOSSIBLE, tmp_path))["scenarios"]["sampled"]
    by_name = {item["name"]: item for item in found}
    assert by_name["colour"]["buckets"][1] == {"value": "amber"}
    assert by_name["colour"]["impossible"] == [[1]]
    assert all(len(cell) == 2 for cell in by_name["both"]["impossible"])
