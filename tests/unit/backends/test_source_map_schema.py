"""Source maps have the form that their schema explains."""

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from osc2tx.compilation.driver import Compilation
from tests.golden.test_stages import HERE, options_for
from tests.unit.backends.xosc.test_report import unexplained

DOCS = Path(__file__).parents[3] / "docs"
SCHEMA = json.loads((DOCS / "source-map.schema.json").read_text(encoding="utf-8"))
SOURCES = sorted((HERE / "py_trees").rglob("input.osc"))


def test_the_schema_explains_each_key() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert list(unexplained(SCHEMA)) == []


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.parent.name)
def test_maps_fit_it(path: Path) -> None:
    compilation = Compilation(path, path.name, options_for(path.parent))
    outputs = compilation.module_outputs()
    found = [each.text for each in outputs if each.suffix == ".map.json"]
    for text in found:
        assert isinstance(text, str)
        faults = Draft202012Validator(SCHEMA).iter_errors(json.loads(text))
        assert [each.message for each in faults] == []
    assert found
