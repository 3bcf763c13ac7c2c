"""The tools over the protocol: names, descriptions, parameters, and errors as answers."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Lock
from typing import Annotated, Literal

from mcp.server import MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp.types import ToolAnnotations
from pydantic import Field

from osc2tx.config import ConfigError
from osc2tx.mcp_server import answers
from osc2tx.mcp_server.answers import Answer, Answers, CannotAnswer, Fixes
from osc2tx.version import __version__

INSTRUCTIONS = """\
osc2tx compiles ASAM OpenSCENARIO DSL (.osc) into py_trees modules and OpenSCENARIO XML.
To write a scenario: look names up with `reference`; `check` the text; apply the edits of `fixes`,
or call `check` with fix="safe" or "all"; `explain` a code that is not clear; then `run` it."""

Text = Annotated[str, Field(description="A scenario file in OpenSCENARIO DSL.")]
Name = Annotated[str, Field(description="Name of its file, relative to the working folder.")]
Scenario = Annotated[str | None, Field(description="Name of the scenario; the last one if null.")]
"""Annotations of parameters that several tools have."""


def make_server(folder: Path, out: Path | None = None) -> MCPServer:
    """Return a server of the tools.

    Args:
        folder: Folder of imported files and settings.
        out: Folder of the outputs; `None` to write nothing.
    """
    server = MCPServer(
        "osc2tx", instructions=INSTRUCTIONS, version=__version__, log_level="CRITICAL"
    )
    _offer(server, Answers(folder, out))
    return server


def _offer(server: MCPServer, tools: Answers) -> None:
    reads = ToolAnnotations(read_only_hint=True, open_world_hint=False)
    writes = ToolAnnotations(read_only_hint=tools.out is None, open_world_hint=False)
    turn = Lock()  # tools are called in threads; trees of py_trees share a blackboard

    @server.tool(annotations=reads)
    def check(text: Text, name: Name = "scenario.osc", fix: Fixes = "none") -> Answer:
        """Check a scenario: diagnostics with positions, remedies, and fixes as edits.

        With fix="safe" or "all", fixes are applied first, and the result has the new `text`.
        """
        with turn, _refusals():
            return tools.check(text, name, fix)

    @server.tool(annotations=writes)
    def build(text: Text, name: Name = "scenario.osc") -> Answer:
        """Compile a scenario into a py_trees module and OpenSCENARIO XML."""
        with turn, _refusals():
            return tools.build(text, name)

    @server.tool(annotations=reads)
    def run(
        text: Text,
        name: Name = "scenario.osc",
        scenario: Scenario = None,
        seed: int = 0,
        max_time: Annotated[float, Field(gt=0, description="Simulated seconds.")] = 60.0,
    ) -> Answer:
        """Run a scenario in the embedded world: verdict, events, actions, last states."""
        with turn, _refusals():
            return tools.run(text, name, scenario, seed, max_time)

    @server.tool(annotations=reads)
    def tree(
        text: Text,
        name: Name = "scenario.osc",
        scenario: Scenario = None,
        form: Literal["text", "svg"] = "text",
    ) -> str:
        """Draw the behavior tree of a scenario."""
        with turn, _refusals():
            return tools.tree(text, name, scenario, form)

    @server.tool(name="import", annotations=writes)
    def import_(document: str, name: str = "scenario") -> Answer:
        """Make a scenario of an OpenSCENARIO XML document, with a report on what is not exact."""
        with turn, _refusals():
            return tools.import_xml(document, name)

    @server.tool(annotations=reads)
    def explain(code: str) -> Answer:
        """Explain a diagnostic code such as OSC202: meaning, example, remedy."""
        with _refusals():
            return answers.explain(code)

    @server.tool(annotations=reads)
    def reference(name: str | None = None) -> str:
        """Describe a name of the library or the language, such as `drive`, `lane`, `until`, `kph`.

        Without a name, all names are listed.
        """
        with _refusals():
            return answers.reference(name)


@contextmanager
def _refusals() -> Iterator[None]:
    """Turn a use that has no answer, and wrong settings, into errors that the model reads."""
    try:
        yield
    except (CannotAnswer, ConfigError) as error:
        raise ToolError(str(error)) from None
