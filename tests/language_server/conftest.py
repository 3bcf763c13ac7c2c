"""A client that speaks the protocol with `osc2tx lsp`, as an editor does."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Awaitable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import pytest

pytest.importorskip("pygls")
pytest.importorskip("pytest_lsp")
import pytest_lsp
from lsprotocol import types as lsp
from pytest_lsp.client import (
    DEFAULT_CLIENT_FEATURES,
    LanguageClient,
    default_converter,
    register_lsp_features,
)

T = TypeVar("T")
PUBLISHED = lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS
SECONDS = 120  # until a server that does not answer is given up


class Editor:
    """An editor with one server; each call waits for its answer.

    The client of pytest-lsp warns of answers that the capabilities of the editor do not allow.

    Attributes:
        folder: The folder of the project.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._loop = asyncio.new_event_loop()
        self._client = LanguageClient(converter_factory=default_converter)
        self._versions: dict[str, int] = {}
        self._checked: dict[str, int | None] = {}

        def take(params: lsp.PublishDiagnosticsParams) -> None:
            self._client.diagnostics[params.uri] = params.diagnostics
            self._checked[params.uri] = params.version

        register_lsp_features(self._client, {**DEFAULT_CLIENT_FEATURES, PUBLISHED: take})

    @property
    def problems(self) -> dict[str, list[lsp.Diagnostic]]:
        """The diagnostics of each document, as last sent."""
        return {uri: list(found) for uri, found in self._client.diagnostics.items()}

    def start(self) -> None:
        self._run(self._client.start_io(sys.executable, "-m", "osc2tx", "lsp"))
        capabilities = pytest_lsp.client_capabilities("visual-studio-code")
        asked = lsp.InitializeParams(capabilities=capabilities, root_uri=self.folder.as_uri())
        self._run(self._client.initialize_session(asked))

    def stop(self) -> None:
        self._run(self._client.shutdown_session())
        self._run(self._client.stop())
        self._loop.close()

    def open(self, name: str, text: str) -> str:
        """Open a text as a file of the project; return its address after its diagnostics came."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return self.show(path.as_uri(), text)

    def show(self, uri: str, text: str) -> str:
        """Open a text that need not be a file."""
        self._versions[uri] = 1
        item = lsp.TextDocumentItem(uri, "osc2", 1, text)
        self.notify(lsp.TEXT_DOCUMENT_DID_OPEN, lsp.DidOpenTextDocumentParams(item), uri)
        return uri

    def change(self, uri: str, text: str, *, of: str | None = None) -> None:
        """Replace the text of a document; return after its diagnostics, or those of another."""
        whole = lsp.TextDocumentContentChangeWholeDocument(text)
        self.edit(uri, whole, of=of or uri)

    def edit(self, uri: str, *changes: Any, of: str | None = None) -> None:
        """Send changes of a document; return after diagnostics came, if some are awaited."""
        self._versions[uri] += 1
        document = lsp.VersionedTextDocumentIdentifier(self._versions[uri], uri)
        params = lsp.DidChangeTextDocumentParams(document, changes)
        self.notify(lsp.TEXT_DOCUMENT_DID_CHANGE, params, of)

    def notify(self, method: str, params: Any, of: str | None = None) -> None:
        """Send a notification; return after the diagnostics of a document, if one is given.

        Those of an earlier text of the document do not count.
        """

        def is_checked(uri: str) -> bool:
            is_present = self._checked.get(uri) == self._versions.get(uri)
            return is_present and uri in self._client.diagnostics

        async def wait() -> None:
            self._client.diagnostics.pop(of, None)
            self._client.protocol.notify(method, params)
            while of is not None and not is_checked(of):
                await self._client.wait_for_notification(PUBLISHED)

        self._run(wait())

    def ask(self, method: str, params: Any) -> Any:
        """Send a request; return its result."""

        async def send() -> Any:
            return await self._client.protocol.send_request_async(method, params)

        return self._run(send())

    def _run(self, work: Awaitable[T]) -> T:
        async def limited() -> T:
            return await asyncio.wait_for(work, SECONDS)

        return self._loop.run_until_complete(limited())


@pytest.fixture(scope="module")
def editor(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Editor]:
    made = Editor(tmp_path_factory.mktemp("project"))
    made.start()
    yield made
    made.stop()
