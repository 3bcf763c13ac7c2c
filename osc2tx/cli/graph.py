"""`osc2tx graph`: the uses of declarations, files and maps in a project."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from osc2tx.building.affected import affected_since
from osc2tx.building.jobs import find_jobs
from osc2tx.building.source_index import SourceIndex
from osc2tx.building.usage_graph import Node, UsageGraph, reach
from osc2tx.cli.graph_output import Graph, render_dot, render_json, render_svg, render_tree
from osc2tx.cli.options import affected_option, seen_from, sources_or_stated
from osc2tx.cli.reporting import Exit, count_of
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx_shared.text import put_document, say

MOST_SHOWN = 20  # declarations with many users
FORMATS = ("text", "json", "dot", "svg")


@click.command()
@click.argument("wanted", metavar="[NAME|FILE|MAP]", required=False)
@click.option("--reverse", is_flag=True, help="Show its users instead.")
@affected_option
@click.option(
    "--output-format",
    "form",
    type=click.Choice(FORMATS),
    default=FORMATS[0],
    help="Form of the graph; `dot` is for Graphviz.",
)
def graph(wanted: str | None, reverse: bool, affected: str | None, form: str) -> Exit:
    """Show the parts that a declaration, file or map uses, or its users, direct and indirect.

    Without a name, `text` summarizes the project and the pictures show its files; sources that no
    other file uses are one node for each folder. `--affected-since` lists the sources that a change
    can affect, with the files that changed.
    """
    configs = ConfigFiles()
    jobs = find_jobs(sources_or_stated((), "read"), GivenOptions(), configs)
    index = SourceIndex(jobs, configs)
    if affected is not None:
        if wanted is not None or form not in ("text", "json"):
            raise click.UsageError("--affected-since lists all sources, as text or json")
        found = {
            _shown(each.path): [_shown(cause) for cause in each.causes]
            for each in affected_since(affected, jobs, configs, index)
        }
        _print_affected(found, affected, form)
        return Exit.OK
    usage = UsageGraph(index)
    if wanted is None and form == "text":
        _sum_up(usage, len(index.files))
        return Exit.OK
    if wanted is None:
        _draw(_graph_of_files(usage, {index.files[path].name for path in index.sources}), form)
        return Exit.OK
    start = usage.find(_name_in_project(wanted, index))
    if not start:
        meant = did_you_mean(wanted, usage.names())
        remedy = meant or "`osc2tx graph` lists the declarations"
        raise click.UsageError(f"the project has no `{wanted}`; {remedy}")
    edges = usage.users if reverse else usage.uses
    if form == "text":
        put_document("".join(f"{line}\n" for line in render_tree(start, edges)))
        return Exit.OK
    nodes = set(reach(start, edges))
    kept = {node: [each for each in usage.uses[node] if each in nodes] for node in nodes}
    ordered = [node for node in usage.uses if node in nodes]
    _draw(Graph(ordered, {node: kept[node] for node in ordered}), form)
    return Exit.OK


def _name_in_project(wanted: str, index: SourceIndex) -> str:
    """Return the name in the project of a file that is named by its path, else the text."""
    file = index.files.get(Path(os.path.realpath(wanted)))
    return wanted if file is None else file.name


def _shown(path: Path) -> str:
    return str(seen_from(path, Path(os.path.realpath(Path.cwd()))))


def _print_affected(found: Mapping[str, Sequence[str]], revision: str, form: str) -> None:
    if form == "json":
        put_document(render_json(Graph((), {}), affected=found))
        return
    for path, causes in found.items():
        others = [cause for cause in causes if cause != path]
        say(path + (f"  ({', '.join(others)})" if others else ""))
    say(f"{count_of(len(found), 'source')} affected by changes since {revision}")


def _sum_up(usage: UsageGraph, files: int) -> None:
    counts = Counter(node.kind for node in usage.uses)
    parts = [count_of(count, kind) for kind, count in counts.items() if kind != "extend"]
    say(f"{count_of(files, 'file')}: {', '.join(parts)}")
    users = {node: len(reach([node], usage.users)) - 1 for node in usage.uses}
    ranked = sorted((n for n in users if users[n]), key=lambda node: -users[node])
    for node in ranked[:MOST_SHOWN]:
        say(f"{users[node]:6}  use {node}")
    for node in usage.uses:
        if not users[node] and node.kind not in ("scenario", "extend"):
            say(f"{'none':>6}  use {node}")


def _graph_of_files(usage: UsageGraph, sources: set[str]) -> Graph:
    """Return which files use which; sources that no file uses are one node for each folder."""
    by_file = usage.files()
    used = {each for others in by_file.values() for each in others}
    groups = Counter(os.path.dirname(file) for file in by_file if file in sources - used)

    def node_of(file: str) -> Node:
        folder = os.path.dirname(file)
        if file in used or file not in sources or groups[folder] == 1:
            kind = "map" if file in maps else "file"
            return Node(kind, file, "")
        return Node("folder", f"{folder or '.'} ({groups[folder]} files)", "")

    maps = {node.name for node in usage.uses if node.kind == "map"}
    edges: dict[Node, dict[Node, None]] = {}
    for file, others in by_file.items():
        edges.setdefault(node_of(file), {}).update(dict.fromkeys(map(node_of, others)))
    for node in [each for others in edges.values() for each in others]:
        edges.setdefault(node, {})
    return Graph(tuple(edges), {node: tuple(others) for node, others in edges.items()})


def _draw(drawn: Graph, form: str) -> None:
    render = {"json": render_json, "dot": render_dot, "svg": render_svg}[form]
    put_document(render(drawn))
