"""`osc2tx world check`: the properties of a simulator against the requirements of runs."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.cli.options import compile_options, scenario_option
from osc2tx.cli.reporting import Exit, Reporter, report_options
from osc2tx.cli.run import Texts, choose_scenario, click_option, merge_settings, option_texts
from osc2tx.compilation.inputs import InputError
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.module_loading import scenarios_of_module
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.running.options import read_options
from osc2tx_runtime.running.world_choice import check_world
from osc2tx_runtime.worlds import EMBEDDED, CheckResult, find_world
from osc2tx_shared.text import complain, put_document, say

MARKS = {"ok": "ok", "differs": "DIFFERS", "unknown": "unknown"}


class CheckCommand(click.Command):
    """A command with the options of the world that it names."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Find out which world it is, before its options are read."""
        ctx.meta[OWN_OPTIONS] = ()
        for name in args:
            if name != EMBEDDED.name and not name.startswith("-") and "." not in name:
                try:
                    ctx.meta[OWN_OPTIONS] = find_world(name).options
                except ScenarioError as error:
                    raise click.UsageError(error.message, ctx) from None
                break
        return super().parse_args(ctx, args)

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Return all options."""
        params = super().get_params(ctx)
        own = map(click_option, ctx.meta.get(OWN_OPTIONS, ()))
        return [*params[:-1], *own, params[-1]]  # `--help` stays last


OWN_OPTIONS = f"{__name__}.own_options"


@click.group()
def world() -> None:
    """Look at the simulators that scenarios can run in."""


@world.command(cls=CheckCommand)
@click.argument("name", metavar="WORLD")
@click.argument("file", metavar="[FILE]", required=False, type=click.Path(dir_okay=False))
@scenario_option("check for")
@click.option("--map-path", metavar="DIR", multiple=True, help="Folder with maps.")
@click.option("--dt", metavar="SECONDS", help="Length of a step.")
@click.option("--drive", is_flag=True, help="Spawn and move actors for further checks.")
@click.option("--fix", is_flag=True, help="Remove the remains of other clients.")
@compile_options
@report_options
def check(
    name: str,
    file: str | None,
    scenario: str | None,
    drive: bool,
    fix: bool,
    given: GivenOptions,
    reporter: Reporter,
    **written: str | bool | tuple[str, ...] | None,
) -> Exit:
    """Check a simulator against the requirements of runs, line by line.

    With a scenario FILE, lines state the consequence for it. Exit code 5: it could not run.
    """
    if reporter.form not in ("text", "json"):
        raise click.UsageError("a check is printed as text or json")
    texts: dict[str, tuple[str, ...]] = {
        key: option_texts(value) for key, value in written.items() if option_texts(value)
    }
    texts["world"] = (name,)
    try:
        results = list(_checked(name, file, scenario, texts, given, drive=drive, fix=fix))
    except ScenarioError as error:
        complain(error.report(file or name))
        return Exit(error.exit_code)
    if reporter.form == "json":
        put_document(json.dumps([asdict(each) for each in results], indent=2) + "\n")
    else:
        before = ""
        for each in results:
            say(f"{each.number:2} {MARKS[each.status]:8} {each.name}: {each.found}")
            if each.meaning and each.meaning != before:
                say(f"            {each.meaning}")
            before = each.meaning
    return Exit.FAILED if any(each.blocks for each in results) else Exit.OK


def _checked(
    name: str,
    file: str | None,
    wanted: str | None,
    texts: Texts,
    given: GivenOptions,
    *,
    drive: bool,
    fix: bool,
) -> Iterator[CheckResult]:
    """Yield the lines for a scenario, or for none."""
    if file is None:
        named = {key.replace("_", "-"): tuple(value) for key, value in texts.items()}
        yield from check_world(None, read_options(named), drives=drive, fixes=fix)
        return
    path = Path(file)
    (compilation,) = compile_all([path], given)
    run_all([compilation], lambda item: item.module)
    if compilation.module is None:
        raise InputError(f"{file} has errors, or declares no scenario: see `osc2tx check`")
    settings = merge_settings(ConfigFiles().for_source(path), path, texts)
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        chosen = choose_scenario(scenarios, wanted, path)
        yield from check_world(chosen, settings, drives=drive, fixes=fix)
