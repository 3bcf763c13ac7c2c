"""What programs read: JSON, SARIF and GitHub's commands."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from osc2tx.diagnostics import CODES, Diagnostic, Label, SourceFile, Span
from osc2tx.diagnostics.fixes import Edit, Fix
from osc2tx.diagnostics.render import render_github, render_json, render_rdjson, render_sarif
from osc2tx.diagnostics.render.github import MOST_COMMANDS
from osc2tx.diagnostics.report import Report, make_report

REPOSITORY = Path(__file__).parents[3]
SCHEMA = json.loads((REPOSITORY / "docs/diagnostics.schema.json").read_text(encoding="utf-8"))
TEXT = "a\n  𝄞 é: vehicel\nlast line\n"


def report_on(text: str, part: str, folder: Path, **more: Any) -> Report:
    source = SourceFile("x.osc", text, folder / "sub dir" / "x,y:ü.osc")
    start = text.index(part)
    code = more.pop("code", "OSC202")
    message = more.pop("message", "no type `vehicel`")
    span = Span(source, start, start + len(part))
    diagnostic = Diagnostic(code, CODES[code].severity, message, span, **more)
    return make_report([diagnostic], files=1, folder=folder)


def no_place() -> Report:
    entry = CODES["OSC101"]
    return make_report([Diagnostic("OSC101", entry.severity, "cannot read", None)], files=1)


def with_all(folder: Path) -> Report:
    library = SourceFile("<library>/domain.osc", "actor vehicle\n")
    return report_on(
        TEXT,
        "vehicel",
        folder,
        labels=(Label(Span(library, 6, 13), "declared here"),),
        notes=("one", "two"),
        help="did you mean `vehicle`?",
    )


# --- order and cap ---


def test_a_report_is_ordered_by_file_and_place_and_capped_for_each_file(tmp_path: Path) -> None:
    sources = [SourceFile("same", "ab\ncd\n", tmp_path / name) for name in ("b.osc", "a.osc")]
    found = [
        Diagnostic(code, CODES[code].severity, code, Span(source, start, start + 1))
        for source in sources
        for code, start in (("OSC202", 3), ("OSC413", 0), ("OSC201", 0))
    ]
    report = make_report(found, files=2, folder=tmp_path, most_shown=2)
    shown = [(d.primary and d.primary.source.path, d.code) for d in report.diagnostics]
    a, b = tmp_path / "a.osc", tmp_path / "b.osc"
    assert shown == [(a, "OSC201"), (a, "OSC413"), (b, "OSC201"), (b, "OSC413")]
    assert report.hidden == {"a.osc": 1, "b.osc": 1}
    assert (report.errors, report.warnings) == (4, 2)


# --- JSON ---


def test_json_follows_its_schema(tmp_path: Path) -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    capped = make_report(with_all(tmp_path).diagnostics * 3, files=1, most_shown=1)
    for report in (Report(), no_place(), with_all(tmp_path), capped):
        jsonschema.validate(json.loads(render_json(report, version="1.0")), SCHEMA)


def test_the_schema_refuses_other_forms(tmp_path: Path) -> None:
    document = json.loads(render_json(with_all(tmp_path), version="1.0"))
    document["diagnostics"][0]["code"] = "E1"
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(document, SCHEMA)


def test_json_counts_characters(tmp_path: Path) -> None:
    (found,) = json.loads(render_json(with_all(tmp_path), version="1.0"))["diagnostics"]
    assert found["location"] == {
        "file": "sub dir/x,y:ü.osc",
        "start": {"line": 2, "column": 8},
        "end": {"line": 2, "column": 15},
    }
    assert found["related"][0]["location"]["file"] == "<library>/domain.osc"
    assert (found["slug"], found["section"]) == ("unknown-type", "7.3")


def test_json_can_be_written_in_any_encoding(tmp_path: Path) -> None:
    assert render_json(with_all(tmp_path), version="1.0").isascii()
    assert render_sarif(with_all(tmp_path), version="1.0").isascii()
    assert render_rdjson(with_all(tmp_path)).isascii()


# --- SARIF ---


def sarif(report: Report) -> dict[str, Any]:
    document: dict[str, Any] = json.loads(render_sarif(report, version="1.0"))
    assert document["version"] == "2.1.0"
    assert document["$schema"].endswith("sarif-schema-2.1.0.json")
    (run,) = document["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == sorted({rule["id"] for rule in rules})
    for result in run["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
        assert result["level"] in ("error", "warning")
        assert result["message"]["text"]
    found: dict[str, Any] = run
    return found


def test_sarif_counts_utf16_code_units(tmp_path: Path) -> None:
    run = sarif(with_all(tmp_path))
    assert run["columnKind"] == "utf16CodeUnits"
    (result,) = run["results"]
    (location,) = result["locations"]
    assert location["physicalLocation"] == {
        "artifactLocation": {"uri": "sub%20dir/x%2Cy%3A%C3%BC.osc", "uriBaseId": "%SRCROOT%"},
        "region": {"startLine": 2, "startColumn": 9, "endLine": 2, "endColumn": 16},
    }
    (related,) = result["relatedLocations"]
    assert related["physicalLocation"]["artifactLocation"] == {"uri": "%3Clibrary%3E/domain.osc"}


def test_sarif_names_files_elsewhere_by_their_uri(tmp_path: Path) -> None:
    report = report_on(TEXT, "vehicel", tmp_path)
    (result,) = sarif(make_report(report.diagnostics, files=1, folder=tmp_path / "z"))["results"]
    artifact = result["locations"][0]["physicalLocation"]["artifactLocation"]
    assert artifact["uri"].startswith("file:///")
    assert "uriBaseId" not in artifact


def test_sarif_of_a_place_of_several_lines_or_none(tmp_path: Path) -> None:
    (result,) = sarif(report_on(TEXT, "vehicel\nlast", tmp_path))["results"]
    region = result["locations"][0]["physicalLocation"]["region"]
    assert region == {"startLine": 2, "startColumn": 9, "endLine": 3, "endColumn": 5}
    assert "locations" not in sarif(no_place())["results"][0]


def test_sarif_rules_have_help(tmp_path: Path) -> None:
    (rule,) = sarif(with_all(tmp_path))["tool"]["driver"]["rules"]
    assert rule["name"] == "UnknownType"
    assert rule["defaultConfiguration"] == {"level": "error"}
    assert "hero: vehicel" in rule["help"]["markdown"]
    assert CODES["OSC202"].explanation is not None
    assert CODES["OSC202"].explanation.remedy in rule["help"]["text"]


def test_sarif_says_braces_and_brackets_as_they_are_meant(tmp_path: Path) -> None:
    report = report_on(TEXT, "vehicel", tmp_path, message="unexpected `{0}` in [a](b)")
    assert sarif(report)["results"][0]["message"]["text"] == "unexpected `{{0}}` in [a\\](b)"


def test_sarif_says_whether_osc2tx_failed() -> None:
    document = json.loads(render_sarif(Report(), version="1.0", failed=True))
    assert document["runs"][0]["invocations"] == [{"executionSuccessful": False}]
    assert sarif(Report())["invocations"] == [{"executionSuccessful": True}]


# --- rdjson ---

RANGE = {
    "type": "object",
    "required": ["start", "end"],
    "additionalProperties": False,
    "properties": {
        place: {
            "type": "object",
            "required": ["line", "column"],
            "additionalProperties": False,
            "properties": {key: {"type": "integer", "minimum": 1} for key in ("line", "column")},
        }
        for place in ("start", "end")
    },
}
# What reviewdog reads of its Diagnostic Format; it drops other members.
RDJSON = {
    "type": "object",
    "required": ["source", "diagnostics"],
    "additionalProperties": False,
    "properties": {
        "source": {"type": "object", "properties": {"name": {"type": "string"}}},
        "diagnostics": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["message", "severity"],
                "additionalProperties": False,
                "properties": {
                    "message": {"type": "string", "minLength": 1},
                    "severity": {"enum": ["ERROR", "WARNING", "INFO"]},
                    "code": {
                        "type": "object",
                        "required": ["value"],
                        "additionalProperties": False,
                        "properties": {key: {"type": "string"} for key in ("value", "url")},
                    },
                    "location": {
                        "type": "object",
                        "required": ["path"],
                        "additionalProperties": False,
                        "properties": {"path": {"type": "string"}, "range": RANGE},
                    },
                    "suggestions": {
                        "type": "array",
                        "items": {
                            "type": "object",
                            "required": ["range", "text"],
                            "additionalProperties": False,
                            "properties": {"range": RANGE, "text": {"type": "string"}},
                        },
                    },
                },
            },
        },
    },
}


def rdjson(report: Report) -> list[dict[str, Any]]:
    document = json.loads(render_rdjson(report))
    jsonschema.validate(document, RDJSON)
    found: list[dict[str, Any]] = document["diagnostics"]
    return found


def fix_of(source: SourceFile, *edits: tuple[str, str]) -> Fix:
    spans = [(source.text.index(old), old, new) for old, new in edits]
    return Fix("x", tuple(Edit(Span(source, at, at + len(old)), new) for at, old, new in spans))


def test_rdjson_counts_bytes_and_names_the_file_as_it_is(tmp_path: Path) -> None:
    (found,) = rdjson(with_all(tmp_path))
    assert found["location"] == {
        "path": "sub dir/x,y:ü.osc",
        "range": {"start": {"line": 2, "column": 12}, "end": {"line": 2, "column": 19}},
    }
    assert found["message"].endswith("help: did you mean `vehicle`?")
    assert (found["code"], found["severity"]) == ({"value": "OSC202"}, "ERROR")


def test_rdjson_joins_the_edits_of_a_fix_to_one_suggestion() -> None:
    source, other = SourceFile("a.osc", "one two\nthree\n"), SourceFile("b.osc", "four\n")
    fixes = (fix_of(source, ("one", "1"), ("three", "3")), fix_of(other, ("four", "4")))
    entry = CODES["OSC202"]
    item = Diagnostic("OSC202", entry.severity, "m", Span(source, 4, 7), fixes=fixes)
    (found,) = rdjson(make_report([item], files=1))
    assert found["suggestions"] == [
        {
            "range": {"start": {"line": 1, "column": 1}, "end": {"line": 2, "column": 6}},
            "text": "1 two\n3",
        }
    ]


def test_rdjson_of_what_has_no_place() -> None:
    (found,) = rdjson(no_place())
    assert "location" not in found
    (failure,) = rdjson(Report(failure="wrong usage"))
    assert failure == {"message": "wrong usage", "severity": "ERROR"}
    link = json.loads(render_rdjson(no_place(), docs_url="https://docs.example.org"))
    assert link["diagnostics"][0]["code"]["url"].endswith("org/diagnostics/osc101.html")


# --- GitHub ---


def test_github_commands_are_escaped(tmp_path: Path) -> None:
    report = report_on(TEXT, "vehicel", tmp_path, message="100%\r\n::set-env name=x::y", help="no")
    assert render_github(report) == (
        "::error file=sub dir/x%2Cy%3Aü.osc,line=2,endLine=2,col=8,endColumn=14,"
        "title=OSC202 unknown-type::100%25\\r\\n::set-env name=x::y%0Ahelp: no\n"
    )


def test_github_has_no_columns_for_several_lines_and_no_file_without_place(tmp_path: Path) -> None:
    command = render_github(report_on(TEXT, "vehicel\nlast", tmp_path))
    assert ",line=2,endLine=3,title=" in command
    assert render_github(no_place()).startswith("::error title=OSC101 unreadable-source::")


def test_github_says_what_is_not_shown(tmp_path: Path) -> None:
    report = make_report(with_all(tmp_path).diagnostics * 3, files=1, most_shown=1)
    assert render_github(report).endswith("\n::notice file=x.osc::2 more not shown\n")


def test_github_shows_errors_first_where_there_are_too_many() -> None:
    source = SourceFile("a.osc", "text\n" * 400)
    codes = ["OSC433"] * 300 + ["OSC202"] * 5
    found = [
        Diagnostic(code, CODES[code].severity, f"number {n}", Span(source, 5 * n, 5 * n + 4))
        for n, code in enumerate(codes)
    ]
    *commands, last = render_github(make_report(found, files=1)).splitlines()
    assert len(commands) == MOST_COMMANDS
    assert [command.split()[0] for command in commands[:6]] == ["::error"] * 5 + ["::warning"]
    assert last == (
        "::notice title=osc2tx::105 more annotations not shown, errors come first;"
        " `--output-format json` has all"
    )


def test_every_code_can_be_rendered() -> None:
    source = SourceFile("a.osc", "text\n")
    found = [
        Diagnostic(code, entry.severity, entry.summary.lower(), Span(source, 0, 4))
        for code, entry in CODES.items()
    ]
    report = make_report(found, files=1)
    jsonschema.validate(json.loads(render_json(report, version="1.0")), SCHEMA)
    assert len(sarif(report)["tool"]["driver"]["rules"]) == len(CODES)
    assert render_github(report).count("\n") == len(CODES)
    assert len(rdjson(report)) == len(CODES)


@given(st.text(), st.text())
def test_no_text_begins_a_further_command(message: str, help: str) -> None:
    source = SourceFile(message.replace("\0", ""), "text\n")
    entry = CODES["OSC413"]
    diagnostic = Diagnostic("OSC413", entry.severity, message, Span(source, 0, 4), help=help)
    command = render_github(make_report([diagnostic], files=1))
    assert command.count("\n") == 1
    assert "\r" not in command
    properties = command.removeprefix("::warning ").partition("::")[0]
    assert len(properties.split(",")) == 6


def fingerprint_of(text: str, folder: Path) -> str:
    log = json.loads(render_sarif(report_on(text, "vehicel", folder), version="1"))
    (result,) = log["runs"][0]["results"]
    return str(result["partialFingerprints"]["osc2tx/v1"])


def test_sarif_knows_a_message_again(tmp_path: Path) -> None:
    """Lines that come above it change nothing; another text of its line does."""
    known = fingerprint_of(TEXT, tmp_path)
    assert known == fingerprint_of(f"# new\n\n{TEXT}", tmp_path)
    assert known != fingerprint_of(TEXT.replace("é", "other"), tmp_path)


@pytest.mark.parametrize(
    "address", ["https://docs.example.org/osc", "https://docs.example.org/osc/"]
)
def test_sarif_links_to_documentation_that_is_published(tmp_path: Path, address: str) -> None:
    report = report_on(TEXT, "vehicel", tmp_path)
    rules = json.loads(render_sarif(report, version="1", docs_url=address))["runs"][0]["tool"]
    links = {rule["id"]: rule["helpUri"] for rule in rules["driver"]["rules"]}
    assert links == {"OSC202": "https://docs.example.org/osc/diagnostics/osc202.html"}
    assert "helpUri" not in render_sarif(report, version="1")
