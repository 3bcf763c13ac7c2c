"""Every static rule of the language has a case that breaks it, and a neighbor that does not."""

import re
import tomllib
from pathlib import Path

from osc2tx.diagnostics import CODES

GOLDEN = Path(__file__).parents[2] / "golden" / "diagnostics"
RULES = tomllib.loads((GOLDEN / "rules.toml").read_text(encoding="utf-8"))["rule"]


def test_a_rule_has_its_cases() -> None:
    """That the marks of the cases are true, and the neighbors valid, the goldens test."""
    for rule in RULES:
        assert rule["code"] in CODES, rule
        case = GOLDEN / rule["case"]
        marks = re.findall(r"#!.*", (case / "input.osc").read_text(encoding="utf-8"))
        assert any(rule["code"] in mark for mark in marks), rule
        assert (case / "expected" / "diagnostics.txt").is_file(), rule
        assert (case / "valid.osc").is_file(), rule


def test_every_error_of_semantics_is_of_a_rule() -> None:
    """Warnings, relaxations of dialects and budgets are no rules of the standard."""
    ours = {c for c in CODES if c.startswith(("OSC2", "OSC3", "OSC40", "OSC41"))}
    advice = {"OSC414", "OSC415", "OSC416", "OSC417"}
    budgets = {"OSC324"}
    assert ours - {rule["code"] for rule in RULES} == advice | budgets
