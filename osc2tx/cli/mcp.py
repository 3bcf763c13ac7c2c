"""`osc2tx mcp`."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.option(
    "-o",
    "--out",
    metavar="DIR",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder that outputs of `build` and `import` are written to; else nothing is written.",
)
def mcp(out: Path | None) -> None:
    """Serve language models: the Model Context Protocol on standard input and output.

    Clients start it in the folder whose files scenarios may import. It needs the extra `mcp`:
    `pip install "osc2tx[mcp]"`.
    """
    try:
        from osc2tx.mcp_server.server import make_server
    except ModuleNotFoundError as error:
        if error.name not in ("mcp", "pydantic"):
            raise
        message = 'the server is not installed: `pip install "osc2tx[mcp]"`'
        raise click.UsageError(message) from None
    make_server(Path.cwd(), out).run()
