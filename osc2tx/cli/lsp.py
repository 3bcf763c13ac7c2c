"""`osc2tx lsp`."""

from __future__ import annotations

import click


@click.command()
@click.option(
    "--stdio",
    is_flag=True,
    expose_value=False,
    help="Changes nothing: accepted because many editors pass it.",
)
def lsp() -> None:
    """Serve editors: the Language Server Protocol on standard input and output.

    Editors start it. It needs the extra `lsp`: `pip install "osc2tx[lsp]"`.
    """
    try:
        from osc2tx.language_server.server import make_server
    except ModuleNotFoundError as error:
        if error.name not in ("pygls", "lsprotocol"):
            raise
        message = 'the language server is not installed: `pip install "osc2tx[lsp]"`'
        raise click.UsageError(message) from None
    make_server().start_io()
