"""The tools over the protocol, asked by its own client.

Its import takes longer than most tests: it is for the process that carries these out.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable, Coroutine, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest

if TYPE_CHECKING:
    from mcp import Client

if find_spec("mcp") is None:
    pytest.skip("mcp is not installed", allow_module_level=True)

SECONDS = 120

SCENARIO = """import osc.standard

scenario follow:
    ego: vehicle
    leader: vehicle
    event done
    do parallel:
        leader.drive(duration: 3s) with:
            speed(50kph)
        serial:
            ego.drive(duration: 2s) with:
                speed(10mps)
                position(20m, behind: leader, at: start)
            emit done
"""

Work: TypeAlias = "Callable[[Client], Coroutine[Any, Any, Any]]"


def served(folder: Path, work: Work, *options: str) -> Any:
    """Return what becomes of work with a client of a server that runs in a folder."""
    from mcp import Client, StdioServerParameters

    command = ["-m", "osc2tx", "mcp", *options]
    server = StdioServerParameters(command=sys.executable, args=command, cwd=folder)

    async def talk() -> Any:
        async with Client(server) as client:
            return await work(client)

    return asyncio.run(asyncio.wait_for(talk(), SECONDS))


def asked(folder: Path, *calls: tuple[str, dict[str, Any]], options: Sequence[str] = ()) -> Any:
    """Return what one server answers to calls of tools with arguments."""

    async def ask(client: Client) -> list[Any]:
        return [await client.call_tool(tool, arguments) for tool, arguments in calls]

    return served(folder, ask, *options)


def value_of(result: Any) -> Any:
    """Return what a call gives; it must not fail."""
    assert not result.is_error, result.content
    found = result.structured_content
    return found["result"] if set(found) == {"result"} else found


def reason_of(result: Any) -> str:
    """Return why a call fails, which it has to."""
    assert result.is_error
    return str(result.content[0].text)


def called(folder: Path, tool: str, *options: str, **arguments: Any) -> Any:
    (result,) = asked(folder, (tool, arguments), options=options)
    return value_of(result)


def refused(folder: Path, tool: str, **arguments: Any) -> str:
    (result,) = asked(folder, (tool, arguments))
    return reason_of(result)


def test_the_tools_and_what_they_may_do(tmp_path: Path) -> None:
    async def listed(client: Client) -> Any:
        return (await client.list_tools()).tools

    tools = served(tmp_path, listed)
    names = {tool.name for tool in tools}
    assert names == {"check", "build", "run", "explain", "reference", "tree", "import"}
    assert all(tool.description and tool.annotations.read_only_hint for tool in tools)
    writing = served(tmp_path, listed, "--out", "made")
    writers = {tool.name for tool in writing if not tool.annotations.read_only_hint}
    assert writers == {"build", "import"}


def test_one_client_writes_checks_and_runs_a_scenario(tmp_path: Path) -> None:
    wrong = SCENARIO.replace("do parallel:", "do paralel:").replace("3s", "3 s")

    async def loop(client: Client) -> list[Any]:
        first = await client.call_tool("check", {"text": wrong})
        fixed = await client.call_tool("check", {"text": wrong, "fix": "all"})
        text = fixed.structured_content["text"]
        run = await client.call_tool("run", {"text": text})
        tree = await client.call_tool("tree", {"text": text})
        return [each.structured_content for each in (first, fixed, run, tree)]

    first, fixed, run, tree = served(tmp_path, loop)
    assert not first["ok"] and first["diagnostics"][0]["fixes"]
    assert fixed["ok"] and fixed["text"] == SCENARIO
    assert (run["status"], round(run["time"])) == ("success", 3)
    assert [line["t"] for line in run["trace"] if line["kind"] == "event"] == pytest.approx([2.0])
    assert {line["actor"] for line in run["last_states"]} == {"ego", "leader"}
    assert "leader" in tree["result"]


def test_imports_are_those_of_the_working_folder(tmp_path: Path) -> None:
    (tmp_path / "shared.osc").write_text("struct limits:\n    top: int\n")
    text = 'import "shared.osc"\nactor a:\n    x: limits\n'
    assert called(tmp_path, "check", text=text)["ok"]
    assert "below the folder" in refused(tmp_path, "check", text=text, name="../a.osc")


def test_outputs_are_written_only_to_the_folder_given(tmp_path: Path) -> None:
    kept = called(tmp_path, "build", text=SCENARIO, name="follow.osc")
    assert "class Follow(Scenario):" in kept["outputs"]["follow.py"]
    assert list(tmp_path.iterdir()) == []
    written = called(tmp_path, "build", "--out", "made", text=SCENARIO, name="follow.osc")
    assert "follow.py" in written["written"]
    assert [each.name for each in tmp_path.iterdir()] == ["made"]
    assert (tmp_path / "made" / "follow.py").read_text() == kept["outputs"]["follow.py"]


def test_a_written_document_is_imported(tmp_path: Path) -> None:
    made = called(tmp_path, "build", text=SCENARIO, name="follow.osc")["outputs"]
    (document,) = (text for name, text in made.items() if name.endswith("follow.xosc"))
    back = called(tmp_path, "import", document=document, name="follow")
    assert called(tmp_path, "check", text=back["text"])["ok"]


def test_look_up(tmp_path: Path) -> None:
    one, all_of_them, code, misspelt, unknown = asked(
        tmp_path,
        ("reference", {"name": "change_lane"}),
        ("reference", {}),
        ("explain", {"code": "OSC202"}),
        ("reference", {"name": "chang_lane"}),
        ("explain", {"code": "OSC999"}),
    )
    assert "num_of_lanes" in value_of(one)
    assert "action vehicle.drive" in value_of(all_of_them)
    assert value_of(code)["code"] == "OSC202"
    assert "did you mean" in reason_of(misspelt)
    assert "no code" in reason_of(unknown)


def test_what_cannot_be_run_is_an_error_that_states_why(tmp_path: Path) -> None:
    unknown_type, empty, other = asked(
        tmp_path,
        ("run", {"text": SCENARIO.replace("ego: vehicle", "ego: car")}),
        ("tree", {"text": "import osc.standard\n"}),
        ("run", {"text": SCENARIO, "scenario": "other"}),
    )
    said = reason_of(unknown_type)
    assert "OSC202" in said and "car" in said
    assert "declares no scenario" in reason_of(empty)
    assert "follow" in reason_of(other)
    (tmp_path / "osc2tx.toml").write_text("nonsense = 1\n")
    assert "nonsense" in refused(tmp_path, "check", text=SCENARIO)
