"""Writes the TextMate grammar of the editors from the tables of the front end."""

import json
import re
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REPOSITORY))

from osc2tx.reference import topics  # noqa: E402
from osc2tx.syntax import tokens as t  # noqa: E402

PLACE = REPOSITORY / "editors" / "vscode" / "syntaxes" / "osc2.tmLanguage.json"
NAME = r"[A-Za-z_][A-Za-z0-9_]*"
DECLARING = ("action", "actor", "enum", "event", "extend", "modifier", "scenario", "struct")
DECLARING += ("type", "unit", "def")
COMPOSITIONS = ("serial", "parallel", "one_of")
OPERATORS = ("and", "or", "not", "in", "is", "as", "of")
PRIMITIVES = ("bool", "float", "int", "string", "uint")
CONSTANTS = ("true", "false", "inf", "nan")


def words(names: list[str] | tuple[str, ...]) -> str:
    """Return the pattern of one of some words."""
    return rf"\b(?:{'|'.join(sorted(names))})\b"


def grammar() -> dict[str, object]:
    """Return the grammar; the first pattern that matches at a place counts."""
    others = sorted(set(t.KEYWORDS) - {*DECLARING, *COMPOSITIONS, *OPERATORS})
    conditions = [n for topic in topics() if topic.kind == "event condition" for n in topic.names]
    string = {"match": r"\\.", "name": "constant.character.escape.osc2"}
    return {
        "name": "OpenSCENARIO DSL",
        "scopeName": "source.osc2",
        "fileTypes": ["osc"],
        "patterns": [
            {"match": "#.*$", "name": "comment.line.number-sign.osc2"},
            *(
                {
                    "begin": quote,
                    "end": rf"{quote}|$" if len(quote) == 1 else quote,
                    "name": "string.quoted.osc2",
                    "patterns": [string],
                }
                for quote in ('"""', "'''", '"', "'")
            ),
            {
                "match": rf"\b({'|'.join(sorted(DECLARING))})\s+({NAME}(?:\.{NAME})?)",
                "captures": {
                    "1": {"name": "storage.type.osc2"},
                    "2": {"name": "entity.name.type.osc2"},
                },
            },
            {
                "match": rf"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)({NAME})",
                "captures": {
                    "1": {"name": "constant.numeric.osc2"},
                    "2": {"name": "keyword.other.unit.osc2"},
                },
            },
            {"match": r"\b0x[0-9A-Fa-f]+\b", "name": "constant.numeric.hex.osc2"},
            {
                "match": r"\b\d+(?:\.\d+)?(?:[eE][+-]?\d+)?\b",
                "name": "constant.numeric.osc2",
            },
            {"match": words(CONSTANTS), "name": "constant.language.osc2"},
            {"match": words(COMPOSITIONS), "name": "keyword.control.composition.osc2"},
            {"match": words(OPERATORS), "name": "keyword.operator.word.osc2"},
            {"match": words(DECLARING), "name": "storage.type.osc2"},
            {"match": words(others), "name": "keyword.control.osc2"},
            {"match": words(PRIMITIVES), "name": "support.type.primitive.osc2"},
            {"match": words(conditions), "name": "support.function.osc2"},
            {"match": rf"@{NAME}(?:\.{NAME})*", "name": "variable.other.event.osc2"},
            {"match": rf"\b{NAME}(?=\s*:(?!:))", "name": "variable.parameter.osc2"},
            {"match": rf"\b{NAME}(?=\()", "name": "entity.name.function.osc2"},
            {
                "match": "|".join(
                    re.escape(mark) for mark in ("=>", "->", "==", "!=", "<=", ">=", "..")
                ),
                "name": "keyword.operator.osc2",
            },
        ],
    }


def render() -> str:
    """Return the grammar as JSON."""
    return json.dumps(grammar(), indent=2) + "\n"


if __name__ == "__main__":
    PLACE.write_text(render(), encoding="utf-8", newline="\n")
