"""The server: the questions of the protocol, and which module answers them."""

from __future__ import annotations

import asyncio
import difflib
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlparse

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer
from pygls.uris import to_fs_path

from osc2tx.config import ConfigError
from osc2tx.language_server import decorations, descriptions, navigation, problems
from osc2tx.language_server.completion import completions, signature
from osc2tx.language_server.documents import Document
from osc2tx.language_server.positions import offset_of, range_of, whole
from osc2tx.language_server.project import Project
from osc2tx.support.recursion import collect_earlier_trees
from osc2tx.version import __version__

PAUSE = 0.02  # s without another change, after which a text is checked
WATCHED = ("**/*.osc", "**/osc2tx.toml", "**/pyproject.toml")


class OscServer(LanguageServer):
    """A language server for OpenSCENARIO DSL."""

    def __init__(self) -> None:
        """Begin without documents."""
        super().__init__("osc2tx", __version__)
        self.project = Project()
        self._changed: dict[str, None] = {}
        self._timer: asyncio.TimerHandle | None = None

    def of(self, identifier: lsp.TextDocumentIdentifier) -> Document:
        """Return the document that a question is about."""
        return self.project.document(path_of(identifier.uri))

    def changed(self, uri: str) -> None:
        """Take the text that the editor has now; it is checked when no other change follows."""
        self._changed[uri] = None
        try:
            self.project.change(path_of(uri), self.workspace.get_text_document(uri).source, uri)
        except ConfigError as error:
            del self._changed[uri]
            self._publish_settings(uri, error)
            return
        if self._timer is not None:
            self._timer.cancel()
        self._timer = asyncio.get_running_loop().call_later(PAUSE, self._check_changed)

    def _check_changed(self) -> None:
        uris = list(self._changed)
        self._changed.clear()
        for uri in uris:
            self._publish(self.project.document(path_of(uri)))
            for importer in self.project.renew_importers(path_of(uri)):
                self._publish(importer)

    def forget(self, uri: str) -> None:
        """Take the text on disk for a document that the editor closed."""
        self._changed.pop(uri, None)
        self.project.close(path_of(uri))
        self._send(uri, [])
        for importer in self.project.renew_importers(path_of(uri)):
            self._publish(importer)

    def refresh(self) -> None:
        """Check the open documents again after changes on disk."""
        try:
            for document in self.project.refreshed():
                self._publish(document)
        except ConfigError as error:
            for uri in self.workspace.text_documents:
                self._publish_settings(uri, error)

    def _publish(self, document: Document) -> None:
        self._send(document.uri, problems.problems(document))
        collect_earlier_trees()  # now that the editor has its answer

    def _publish_settings(self, uri: str, error: ConfigError) -> None:
        """Send an error of the settings as the diagnostic of a document."""
        start = lsp.Range(lsp.Position(0, 0), lsp.Position(0, 0))
        self._send(uri, [lsp.Diagnostic(start, str(error), source="osc2tx")])

    def _send(self, uri: str, found: Sequence[lsp.Diagnostic]) -> None:
        """Send the diagnostics of a document, with the version of its text if it is open."""
        shown = self.workspace.text_documents.get(uri)
        version = None if shown is None else shown.version
        self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, found, version))


def path_of(uri: str) -> Path:
    """Return the path of a document; one that is not a file gets a name in the working folder."""
    # Not by `urllib.request`, which loads a twentieth of all that the server loads.
    return Path(to_fs_path(uri) or unquote(urlparse(uri).path) or "a.osc").absolute()


def make_server() -> OscServer:
    """Return a server with all that it answers."""
    server = OscServer()
    _documents(server)
    _questions(server)
    _edits(server)
    return server


def _documents(server: OscServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: lsp.DidOpenTextDocumentParams) -> None:
        server.changed(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def did_change(params: lsp.DidChangeTextDocumentParams) -> None:
        server.changed(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    def did_save(params: lsp.DidSaveTextDocumentParams) -> None:
        server.refresh()

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: lsp.DidCloseTextDocumentParams) -> None:
        server.forget(params.text_document.uri)

    @server.feature(lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def did_change_watched_files(params: lsp.DidChangeWatchedFilesParams) -> None:
        server.refresh()

    @server.feature(lsp.INITIALIZED)
    async def initialized(params: lsp.InitializedParams) -> None:
        if watches_files(server.client_capabilities):
            watchers = [lsp.FileSystemWatcher(pattern) for pattern in WATCHED]
            options = lsp.DidChangeWatchedFilesRegistrationOptions(watchers)
            method = lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES
            asked = lsp.RegistrationParams([lsp.Registration(method, method, options)])
            await server.client_register_capability_async(asked)


def watches_files(client: lsp.ClientCapabilities) -> bool:
    """Whether an editor can report changes on disk."""
    watching = client.workspace and client.workspace.did_change_watched_files
    return bool(watching and watching.dynamic_registration)


def _questions(server: OscServer) -> None:
    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        return descriptions.hover(server.of(params.text_document), params.position)

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        return navigation.definition(server.of(params.text_document), params.position)

    @server.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        document = server.of(params.text_document)
        found = document.occurrence_at(offset_of(document.source, params.position))
        if found is None:
            return []
        documents = server.project.documents_with(path_of(document.uri), found.symbol.name)
        wanted = params.context.include_declaration
        return [
            lsp.Location(each.uri, range_of(name.span))
            for each, name in navigation.references(
                documents, found.symbol, with_declaration=wanted
            )
        ]

    @server.feature(
        lsp.TEXT_DOCUMENT_COMPLETION,
        lsp.CompletionOptions(trigger_characters=[".", "@", "(", ":", '"']),
    )
    def completion(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        document = server.of(params.text_document)
        offset = offset_of(document.source, params.position)
        model = server.project.model_near(path_of(document.uri), offset)
        return completions(document.text, offset, model, document.job)

    @server.feature(
        lsp.TEXT_DOCUMENT_SIGNATURE_HELP, lsp.SignatureHelpOptions(trigger_characters=["(", ","])
    )
    def signature_help(params: lsp.SignatureHelpParams) -> lsp.SignatureHelp | None:
        document = server.of(params.text_document)
        offset = offset_of(document.source, params.position)
        model = server.project.model_near(path_of(document.uri), offset)
        return signature(document.text, offset, model)

    @server.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def document_symbol(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        return navigation.outline(server.of(params.text_document))

    @server.feature(lsp.TEXT_DOCUMENT_FOLDING_RANGE)
    def folding_range(params: lsp.FoldingRangeParams) -> list[lsp.FoldingRange]:
        return navigation.foldings(server.of(params.text_document))

    @server.feature(lsp.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, decorations.LEGEND)
    def semantic_tokens(params: lsp.SemanticTokensParams) -> lsp.SemanticTokens:
        return decorations.semantic_tokens(server.of(params.text_document))

    @server.feature(lsp.TEXT_DOCUMENT_INLAY_HINT)
    def inlay_hint(params: lsp.InlayHintParams) -> list[lsp.InlayHint]:
        return decorations.inlay_hints(server.of(params.text_document), params.range)

    @server.feature(lsp.TEXT_DOCUMENT_CODE_LENS)
    def code_lens(params: lsp.CodeLensParams) -> list[lsp.CodeLens]:
        document = server.of(params.text_document)
        return decorations.lenses(document, params.text_document.uri)


def _edits(server: OscServer) -> None:
    @server.feature(
        lsp.TEXT_DOCUMENT_CODE_ACTION,
        lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix, problems.FIX_ALL]),
    )
    def code_action(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        uri = params.text_document.uri
        only = [str(getattr(kind, "value", kind)) for kind in params.context.only or ()] or None
        return problems.actions(server.of(params.text_document), uri, params.range, only)

    @server.feature(lsp.TEXT_DOCUMENT_FORMATTING)
    def formatting(params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
        document = server.of(params.text_document)
        formatted = document.compilation.formatted
        if formatted is None or formatted == document.text:
            return []
        return [lsp.TextEdit(whole(document.source), formatted)]

    @server.feature(lsp.TEXT_DOCUMENT_RANGE_FORMATTING)
    def range_formatting(params: lsp.DocumentRangeFormattingParams) -> list[lsp.TextEdit]:
        return _formatted_lines(server.of(params.text_document), params.range)

    @server.feature(lsp.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepare_rename(params: lsp.PrepareRenameParams) -> lsp.Range | None:
        document = server.of(params.text_document)
        found = document.occurrence_at(offset_of(document.source, params.position))
        return None if found is None or found.symbol.origin != "user" else range_of(found.span)

    @server.feature(lsp.TEXT_DOCUMENT_RENAME, lsp.RenameOptions(prepare_provider=True))
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
        document = server.of(params.text_document)
        found = document.occurrence_at(offset_of(document.source, params.position))
        if found is None:
            return None
        documents = server.project.documents_with(path_of(document.uri), found.symbol.name)
        try:
            navigation.check_rename(found.symbol, params.new_name, documents)
        except navigation.CannotRename as error:
            raise JsonRpcInvalidParams(str(error)) from None
        changes: dict[str, Sequence[lsp.TextEdit]] = {}
        for each, name in navigation.references(documents, found.symbol):
            edit = lsp.TextEdit(range_of(name.span), params.new_name)
            changes[each.uri] = [*changes.get(each.uri, ()), edit]
        return lsp.WorkspaceEdit(changes=changes)

    @server.command("osc2tx.showModule")
    def show_module(uri: str, *_: Any) -> str | None:
        module = server.project.document(path_of(uri)).compilation.module
        return None if module is None else module.python

    @server.command("osc2tx.showXml")
    def show_xml(uri: str, scenario: str = "", *_: Any) -> str | None:
        found = server.project.document(path_of(uri)).compilation.xml
        return next((each.xml for each in found if scenario in ("", each.name)), None)


def _formatted_lines(document: Document, asked: lsp.Range) -> list[lsp.TextEdit]:
    """Return the changes of the formatter that lie within some lines."""
    formatted = document.compilation.formatted
    if formatted is None:
        return []
    old, new = document.text.splitlines(keepends=True), formatted.splitlines(keepends=True)
    edits = []
    for tag, first, last, from_, to in difflib.SequenceMatcher(None, old, new, False).get_opcodes():
        if tag != "equal" and asked.start.line <= first and last <= asked.end.line + 1:
            place = lsp.Range(lsp.Position(first, 0), lsp.Position(last, 0))
            edits.append(lsp.TextEdit(place, "".join(new[from_:to])))
    return edits
