"""What an editor gets for its questions, over the protocol."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp

from osc2tx.language_server import decorations
from tests.language_server.conftest import SECONDS, Editor

TEXT = """import osc.standard

# Follows its leader.
scenario follow:
    ego: vehicle
    leader: car_ahead
    gap: length = 20m
    do parallel:
        leads: leader.drive(duration: 5s) with:
            speed(50kph)
        ego.drive() with:
            lane(1, at: start)
            speed(gap_speed, at: start)
            position(gap, behind: leader, at: start)

    gap_speed: speed = 36kph
"""
FINE = TEXT.replace("car_ahead", "vehicle")


def place(text: str, word: str, number: int = 0, inside: int = 0) -> lsp.Position:
    """Return the position of an occurrence of a word."""
    offset = -1
    for _ in range(number + 1):
        offset = text.index(word, offset + 1)
    line = text.count("\n", 0, offset)
    return lsp.Position(line, offset - (text.rfind("\n", 0, offset) + 1) + inside)


def at(uri: str, position: lsp.Position, kind: Any = lsp.HoverParams, **more: Any) -> Any:
    return kind(text_document=lsp.TextDocumentIdentifier(uri), position=position, **more)


def edited(text: str, edits: list[lsp.TextEdit]) -> str:
    lines = text.splitlines(keepends=True)
    starts = [sum(map(len, lines[:number])) for number in range(len(lines) + 1)]
    found = sorted(edits, key=lambda each: (each.range.start.line, each.range.start.character))
    for each in reversed(found):
        start = starts[each.range.start.line] + each.range.start.character
        end = starts[each.range.end.line] + each.range.end.character
        text = text[:start] + each.new_text + text[end:]
    return text


def test_diagnostics_come_while_typing(editor: Editor) -> None:
    uri = editor.open("live.osc", TEXT)
    (found,) = editor.problems[uri]
    assert (found.code, found.severity) == ("OSC202", lsp.DiagnosticSeverity.Error)
    assert found.range.start == place(TEXT, "car_ahead")
    editor.change(uri, FINE)
    assert editor.problems[uri] == []


def test_columns_are_utf_16(editor: Editor) -> None:
    text = 'import osc.standard\n\nscenario s:\n    name: string = "\N{PILE OF POO}" + 1\n'
    uri = editor.open("emoji.osc", text)
    found, *_ = editor.problems[uri]
    assert found.range.end.character >= 23


def test_a_fix_is_offered_and_mends_the_text(editor: Editor) -> None:
    text = FINE.replace("parallel:", "paralel:").replace("50kph", "50 kph")
    uri = editor.open("fix.osc", text)
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(50, 0))
    params = lsp.CodeActionParams(
        lsp.TextDocumentIdentifier(uri), whole, lsp.CodeActionContext(editor.problems[uri])
    )
    actions = editor.ask(lsp.TEXT_DOCUMENT_CODE_ACTION, params)
    assert "write `50kph`" in [each.title for each in actions]
    (together,) = [each for each in actions if each.kind == "source.fixAll.osc2tx"]
    assert edited(text, together.edit.changes[uri]) == FINE


def test_hover_has_declaration_comment_and_values(editor: Editor) -> None:
    uri = editor.open("hover.osc", FINE)

    def hover(word: str, number: int = 0) -> str:
        found = editor.ask(lsp.TEXT_DOCUMENT_HOVER, at(uri, place(FINE, word, number, 1)))
        return str(found.contents.value)

    assert "gap: length" in hover("gap:")
    assert "Follows its leader." in hover("follow")
    assert "action vehicle.drive" in hover("drive")
    assert "10 m/s" in hover("36kph")
    assert "member of `follow`" in hover("gap_speed")
    assert "ends when all have ended" in hover("parallel")


def test_definitions_of_own_names_and_of_the_library(editor: Editor) -> None:
    uri = editor.open("definition.osc", FINE)

    def definition(word: str, number: int = 0) -> lsp.Location:
        asked = at(uri, place(FINE, word, number, 1), lsp.DefinitionParams)
        found = editor.ask(lsp.TEXT_DOCUMENT_DEFINITION, asked)
        assert isinstance(found, lsp.Location)
        return found

    assert definition("gap_speed") == lsp.Location(
        uri, lsp.Range(place(FINE, "gap_speed:"), place(FINE, ": speed = 36"))
    )
    library = definition("lane(")
    assert library.uri.endswith("/domain.osc")
    path = Path(library.uri.removeprefix("file://"))
    line = path.read_text(encoding="utf-8").splitlines()[library.range.start.line]
    assert line.startswith("modifier lane")


def test_references_and_rename_across_files(editor: Editor) -> None:
    library = "import osc.standard\n\nscenario vehicle.sway:\n    do drive(duration: 2s)\n"
    user = 'import osc.standard\nimport "lib.osc"\n\nscenario s:\n    v: vehicle\n    do v.sway()\n'
    first = editor.open("lib.osc", library)
    second = editor.open("user.osc", user)
    asked = at(
        first,
        place(library, "sway"),
        lsp.ReferenceParams,
        context=lsp.ReferenceContext(include_declaration=True),
    )
    found = editor.ask(lsp.TEXT_DOCUMENT_REFERENCES, asked)
    assert {each.uri for each in found} == {first, second}
    asked = at(second, place(user, "sway"), lsp.RenameParams, new_name="weave")
    changes = editor.ask(lsp.TEXT_DOCUMENT_RENAME, asked).changes
    assert edited(library, changes[first]) == library.replace("sway", "weave")
    assert edited(user, changes[second]) == user.replace("sway", "weave")


def test_formatting_whole_and_in_part(editor: Editor) -> None:
    text = FINE.replace("gap: length = 20m", "gap:length=20m").replace("(1, at", "(1,at")
    uri = editor.open("format.osc", text)
    document, options = lsp.TextDocumentIdentifier(uri), lsp.FormattingOptions(4, True)
    edits = editor.ask(
        lsp.TEXT_DOCUMENT_FORMATTING, lsp.DocumentFormattingParams(document, options)
    )
    formatted = edited(text, edits)
    assert "gap: length = 20m" in formatted
    assert "(1, at" in formatted
    line = place(text, "gap:length").line
    part = lsp.Range(lsp.Position(line, 0), lsp.Position(line, 5))
    edits = editor.ask(
        lsp.TEXT_DOCUMENT_RANGE_FORMATTING,
        lsp.DocumentRangeFormattingParams(document, part, options),
    )
    assert edited(text, edits) == text.replace("gap:length=20m", "gap: length = 20m")


def test_outline_folding_tokens_hints_and_lenses(editor: Editor) -> None:
    uri = editor.open("outline.osc", FINE)
    document = lsp.TextDocumentIdentifier(uri)
    (top,) = editor.ask(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL, lsp.DocumentSymbolParams(document))
    names = [each.name for each in top.children]
    assert (top.name, names) == ("follow", ["ego", "leader", "gap", "leads", "gap_speed"])
    folds = editor.ask(lsp.TEXT_DOCUMENT_FOLDING_RANGE, lsp.FoldingRangeParams(document))
    assert (3, 15) in [(each.start_line, each.end_line) for each in folds]
    asked = lsp.SemanticTokensParams(document)
    data = editor.ask(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, asked).data
    tokens = named_tokens(FINE, data)
    assert ("follow", "function", 1) in tokens  # declared here
    assert ("vehicle", "class", 2) in tokens  # of the library
    assert {("gap", "property", 1), ("gap", "property", 0)} <= set(tokens)
    assert ("drive", "function", 2) in tokens
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(50, 0))
    hints = editor.ask(lsp.TEXT_DOCUMENT_INLAY_HINT, lsp.InlayHintParams(document, whole))
    assert "= 13.8889 m/s" in [each.label for each in hints]
    (level,) = [each for each in hints if each.position == place(FINE, ":\n    ego")]
    assert level.label == "abstract"
    lenses = editor.ask(lsp.TEXT_DOCUMENT_CODE_LENS, lsp.CodeLensParams(document))
    assert lenses[0].command.title == "run"
    asked = lsp.ExecuteCommandParams("osc2tx.showModule", [uri, "follow"])
    assert "class Follow(Scenario):" in editor.ask(lsp.WORKSPACE_EXECUTE_COMMAND, asked)


def named_tokens(text: str, data: list[int]) -> list[tuple[str, str, int]]:
    """Return the semantic tokens of a text: word, kind, and bits of modifiers."""
    lines, line, column, found = text.splitlines(), 0, 0, []
    for down, right, length, kind, modifiers in zip(*[iter(data)] * 5, strict=True):
        line, column = line + down, right + (0 if down else column)
        word = lines[line][column : column + length]
        found.append((word, decorations.TOKEN_TYPES[kind], modifiers))
    return found


def completed(editor: Editor, name: str, text: str) -> list[str]:
    """Return what is offered at the `|` of a text."""
    offset = text.index("|")
    line = text.count("\n", 0, offset)
    position = lsp.Position(line, offset - (text.rfind("\n", 0, offset) + 1))
    uri = editor.open(name, text.replace("|", ""))
    asked = at(uri, position, lsp.CompletionParams)
    return [each.label for each in editor.ask(lsp.TEXT_DOCUMENT_COMPLETION, asked)]


def test_completion_in_unfinished_texts(editor: Editor) -> None:
    def offered(line: str, below: str = "do parallel:") -> list[str]:
        return completed(editor, "completion.osc", FINE.replace(below, f"{below}\n{line}"))

    assert {"drive", "change_lane"} <= set(offered("        ego.|"))
    assert "osc_action" not in offered("        ego.|")
    assert offered("            |", "ego.drive() with:")[:3] != []
    assert {"speed", "lane", "until"} <= set(offered("            |", "ego.drive() with:"))
    assert {"side", "side_of", "at"} <= set(offered("            lane(|", "ego.drive() with:"))
    assert offered("            lane(side: |", "ego.drive() with:")[:2] == ["left", "right"]
    assert "kph" in offered("            speed(5|", "ego.drive() with:")
    assert {"start", "leads"} <= set(offered("        wait @|"))
    assert {"speed", "time_headway"} <= set(offered("        wait ego.|"))
    assert "drive" not in offered("        wait ego.|")
    assert {"vehicle", "speed", "follow"} <= set(offered("    other: |", "scenario follow:"))
    assert {"serial:", "wait", "ego"} <= set(offered("        |"))
    assert "scenario" in completed(editor, "empty.osc", "import osc.standard\n|")


def test_completion_fits_the_place(editor: Editor) -> None:
    """Units of the expected type, events to emit, members of `it`, maps and modules."""

    def offered(line: str) -> list[str]:
        text = FINE.replace("    do parallel:", f"    event done\n    do parallel:\n{line}")
        return completed(editor, "places/fitting.osc", text)

    all_units = {"kph", "m", "s", "deg"}

    def units(line: str) -> set[str]:
        return all_units & set(offered(line))

    assert units("        ego.change_speed(5|") == {"kph"}
    assert units("        wait ego.space_gap(leader) > 5|") == {"m"}
    assert units("        wait elapsed(5|") == {"s"}
    assert units("        wait 5|") == all_units
    assert offered("        emit |") == ["done"]
    assert set(offered("        wait @leader.|")) == {"start", "end", "fail"}
    head = FINE.replace(
        "    ego: vehicle", "    road: map with:\n        keep(it.|)\n    ego: vehicle"
    )
    assert "map_file" in completed(editor, "places/it.osc", head)
    named = head.replace("it.|", 'it.map_file == "|"')
    assert "highway.xodr" in completed(editor, "places/maps.osc", named)
    modules = completed(editor, "places/modules.osc", "import |\n")
    assert {"osc.standard", "fitting"} <= set(modules)


def test_signatures(editor: Editor) -> None:
    text = FINE.replace("drive(duration: 5s)", "change_lane(1, )")
    uri = editor.open("signature.osc", text)
    asked = at(uri, place(text, "1, )", inside=3), lsp.SignatureHelpParams)
    found = editor.ask(lsp.TEXT_DOCUMENT_SIGNATURE_HELP, asked)
    assert found.signatures[0].label.startswith("leader.change_lane(num_of_lanes: uint")
    assert found.active_parameter == 1


def test_wrong_settings_are_a_diagnostic(editor: Editor) -> None:
    folder = editor.folder / "wrong"
    folder.mkdir()
    (folder / "osc2tx.toml").write_text("nonsense = 1\n")
    uri = editor.open("wrong/a.osc", FINE)
    (found,) = editor.problems[uri]
    assert "nonsense" in found.message


def test_the_option_that_many_editors_pass() -> None:
    """The client of VS Code adds `--stdio` to the command line."""
    command = [sys.executable, "-m", "osc2tx", "lsp", "--stdio"]
    ended = subprocess.run(command, input=b"", capture_output=True, timeout=SECONDS)
    assert (ended.returncode, ended.stderr) == (0, b"")
