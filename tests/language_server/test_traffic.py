"""Odd traffic: broken texts, bursts of edits, files that come and go, texts that are no files."""

from __future__ import annotations

from typing import Any

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from tests.language_server.conftest import Editor
from tests.language_server.test_server import at, place

FINE = """import osc.standard

scenario shared_gap:
    ego, other: vehicle
    gap: length = 20m
    do parallel:
        ego.drive(duration: 5s) with:
            speed(50kph)
        other.drive() with:
            position(gap, behind: ego, at: start)
"""
BROKEN = FINE.replace("speed(50kph)", "speed(50kph))")
LIBRARY = "import osc.standard\n\nscenario vehicle.sway:\n    do drive(duration: 2s)\n"
USER = 'import osc.standard\nimport "{0}"\n\nscenario s:\n    v: vehicle\n    do v.sway()\n'


def hovered(editor: Editor, uri: str, position: lsp.Position) -> str:
    found = editor.ask(lsp.TEXT_DOCUMENT_HOVER, at(uri, position))
    return "" if found is None else str(found.contents.value)


def codes(editor: Editor, uri: str) -> list[Any]:
    return [each.code for each in editor.problems[uri]]


def change_at(line: int, column: int, text: str, length: int = 0) -> Any:
    start, end = lsp.Position(line, column), lsp.Position(line, column + length)
    return lsp.TextDocumentContentChangePartial(lsp.Range(start, end), text)


def test_names_of_a_broken_text_are_known(editor: Editor) -> None:
    uri = editor.open("broken.osc", BROKEN)
    assert codes(editor, uri) == ["OSC100"]
    assert "gap: length" in hovered(editor, uri, place(BROKEN, "gap,"))
    asked = at(uri, place(BROKEN, "gap,"), lsp.DefinitionParams)
    found = editor.ask(lsp.TEXT_DOCUMENT_DEFINITION, asked)
    assert (found.uri, found.range.start) == (uri, place(BROKEN, "gap: length"))
    document = lsp.TextDocumentIdentifier(uri)
    tokens = editor.ask(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, lsp.SemanticTokensParams(document))
    assert len(tokens.data) > 5 * 8
    assert editor.ask(lsp.TEXT_DOCUMENT_CODE_LENS, lsp.CodeLensParams(document))


def test_renaming_in_a_broken_text_is_refused(editor: Editor) -> None:
    """A line that cannot be parsed may hold the name."""
    uri = editor.open("broken_names.osc", BROKEN)
    asked = at(uri, place(BROKEN, "gap: length"), lsp.RenameParams, new_name="distance")
    with pytest.raises(JsonRpcException, match="correct the syntax errors of"):
        editor.ask(lsp.TEXT_DOCUMENT_RENAME, asked)


def test_imports_are_what_the_editor_has(editor: Editor) -> None:
    library = editor.open("unsaved/lib.osc", LIBRARY)
    user = editor.open("unsaved/user.osc", USER.format("lib.osc"))
    assert codes(editor, user) == []
    editor.change(library, LIBRARY.replace("sway", "weave"), of=user)
    assert codes(editor, user) == ["OSC211"]
    identifier = lsp.TextDocumentIdentifier(library)
    closed = lsp.DidCloseTextDocumentParams(identifier)
    editor.notify(lsp.TEXT_DOCUMENT_DID_CLOSE, closed, user)  # the file has the old text
    assert codes(editor, user) == []


def test_settings_leave_warnings_out(editor: Editor) -> None:
    use = "namespace null use std, stdtypes\n\n"
    text = f"import osc.standard.all\n\n{use}scenario base:\n    ego: vehicle\n"
    uri = editor.open("lib/base.osc", text)
    assert [found.code for found in editor.problems[uri]] == ["OSC510"]
    settings = editor.folder / "osc2tx.toml"
    settings.write_text('[files."lib/**"]\nignore = ["OSC510"]\n', encoding="utf-8")
    uri = editor.open("lib/other.osc", text.replace("base", "other"))
    assert editor.problems[uri] == []


def test_files_that_come_and_go(editor: Editor) -> None:
    user = editor.open("moving/user.osc", USER.format("lib.osc"))
    assert "OSC205" in codes(editor, user)
    library = editor.folder / "moving" / "lib.osc"
    for kind, expected in ((lsp.FileChangeType.Created, []), (lsp.FileChangeType.Deleted, None)):
        if kind is lsp.FileChangeType.Created:
            library.write_text(LIBRARY)
        else:
            library.unlink()
        event = lsp.FileEvent(library.as_uri(), kind)
        changes = lsp.DidChangeWatchedFilesParams([event])
        editor.notify(lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES, changes, user)
        assert codes(editor, user) == expected or (
            expected is None and "OSC205" in codes(editor, user)
        )


def test_a_file_that_is_deleted_while_open(editor: Editor) -> None:
    uri = editor.open("deleted.osc", FINE)
    (editor.folder / "deleted.osc").unlink()
    editor.change(uri, FINE.replace("50kph", "50 kph"))
    assert codes(editor, uri) == ["OSC100"]
    assert "gap: length" in hovered(editor, uri, place(FINE, "gap: length"))


def test_texts_that_are_no_files(editor: Editor) -> None:
    uri = editor.show("untitled:Untitled-1", FINE)
    assert codes(editor, uri) == []
    asked = at(uri, place(FINE, "gap,"), lsp.DefinitionParams)
    assert editor.ask(lsp.TEXT_DOCUMENT_DEFINITION, asked).uri == uri
    asked = at(uri, place(FINE, "gap,"), lsp.RenameParams, new_name="distance")
    changes = editor.ask(lsp.TEXT_DOCUMENT_RENAME, asked).changes
    assert {uri: len(edits) for uri, edits in changes.items()} == {uri: 2}


def test_a_burst_of_edits_ends_with_the_last_text(editor: Editor) -> None:
    uri = editor.open("burst.osc", FINE)
    line = place(FINE, "speed(50kph)").line
    for _ in range(40):
        editor.edit(uri, change_at(line, 24, " "))
        editor.edit(uri, change_at(line, 24, "", 1))
    editor.edit(uri, change_at(line, 20, " "), of=uri)
    assert codes(editor, uri) == ["OSC100"]
    assert editor.problems[uri][0].range.start.line == line


def test_columns_of_edits_count_utf_16(editor: Editor) -> None:
    text = FINE.replace(
        "gap: length = 20m", "gap: length = 20m  # \N{PILE OF POO} 2\N{PILE OF POO}"
    )
    uri = editor.open("surrogates.osc", text.replace("\n", "\r\n"))
    assert codes(editor, uri) == []
    end = place(text, "gap: length").line, len("    gap: length = 20m  # 12 234")
    editor.edit(uri, change_at(*end, "\r\n    other_gap: lenght"), of=uri)
    (found,) = editor.problems[uri]
    assert (found.code, found.range.start.line) == ("OSC202", end[0] + 1)


def test_a_line_without_end(editor: Editor) -> None:
    members = ", ".join(f"actor_{number}" for number in range(4000))
    text = f"import osc.standard\n\nscenario long_line:\n    {members}: vehicle\n"
    uri = editor.open("long.osc", text)
    assert "OSC100" not in codes(editor, uri)
    position = lsp.Position(3, 4 + members.index("actor_3999") + 1)
    assert "actor_3999: vehicle" in hovered(editor, uri, position)


def test_a_server_goes_on_after_odd_messages(editor: Editor) -> None:
    folder = lsp.WorkspaceFolder((editor.folder / "elsewhere").as_uri(), "elsewhere")
    event = lsp.WorkspaceFoldersChangeEvent(added=[folder], removed=[])
    changed = lsp.DidChangeWorkspaceFoldersParams(event)
    editor.notify(lsp.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS, changed)
    editor.notify(lsp.CANCEL_REQUEST, lsp.CancelParams("nothing"))
    missing = (editor.folder / "missing.osc").as_uri()
    with pytest.raises(JsonRpcException):
        hovered(editor, missing, lsp.Position(0, 0))
    uri = editor.open("afterwards.osc", FINE)
    assert codes(editor, uri) == []
