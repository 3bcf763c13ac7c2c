"""`osc2tx tree`: prints the behavior tree of a scenario."""

from __future__ import annotations

from pathlib import Path

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.cli.options import compile_options, scenario_option
from osc2tx.cli.reporting import Exit, Reporter, columns, report_options, wants_color
from osc2tx.cli.run import choose_scenario
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import GivenOptions
from osc2tx.module_loading import scenarios_of_module
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.report.tree_pictures import tree_svg, tree_text
from osc2tx_shared.text import complain, put

_FORMS = ("text", "svg")


@click.command()
@click.argument("file", metavar="FILE", type=click.Path(path_type=Path, dir_okay=False))
@scenario_option("draw")
@click.option("--form", type=click.Choice(_FORMS), default="text", help="What to print.")
@compile_options
@report_options
def tree(
    file: Path, scenario: str | None, form: str, given: GivenOptions, reporter: Reporter
) -> Exit:
    """Print the behavior tree of a scenario, as text or as an SVG picture."""
    if reporter.form != "text":
        raise click.UsageError("the tree and --output-format both print to standard output")
    (compilation,) = compile_all([file], given)
    bugs = run_all([compilation], lambda item: item.module)
    code, _ = reporter.report([compilation], bugs)
    if code >= Exit.USAGE:
        return code
    if compilation.module is None:
        raise click.UsageError(f"{file} declares no scenario")
    place, color = str(file), form == "text" and wants_color()
    try:
        with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
            chosen = choose_scenario(scenarios, scenario, file)
            place = chosen.source
            root = chosen().create_tree()
            if form == "svg":
                drawn = tree_svg(root)
            else:
                drawn = tree_text(root, columns=columns(), color=color)
    except ScenarioError as error:
        complain(error.report(place, str(file)))
        return Exit(error.exit_code)
    put(drawn, colored=color)
    return code
