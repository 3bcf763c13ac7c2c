"""`osc2tx run`: runs scenarios in the embedded world or a simulator."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.cli.module_loading import scenarios_of_file, scenarios_of_module
from osc2tx.cli.options import compile_options
from osc2tx.cli.reporting import Exit, Reporter, complain, report_options
from osc2tx.compilation.inputs import InputError, find_inputs
from osc2tx.config import Config, ConfigError, ConfigFiles, GivenOptions
from osc2tx_runtime import RunResult, RunSettings, Scenario, ScenarioError, run_scenario
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.running.main import choose_scenario as choose
from osc2tx_runtime.running.main import verdict
from osc2tx_runtime.running.options import OPTIONS, read_options

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Compilation


def run_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of the runtime's table."""
    for option in reversed(OPTIONS):
        default = "" if option.default is None else f"  [default: {option.default}]"
        command = click.option(
            f"--{option.name}",
            option.field,
            metavar=option.metavar,
            multiple=option.repeatable,
            help=option.help + default,
        )(command)
    return command


@click.command()
@click.argument("file", metavar="FILE", type=click.Path())
@click.option("--scenario", metavar="NAME", help="Which scenario of the file to run.")
@compile_options
@report_options
@run_options
def run(
    file: str,
    scenario: str | None,
    given: GivenOptions,
    reporter: Reporter,
    **run_texts: str | tuple[str, ...] | None,
) -> Exit:
    """Run a scenario file, or a module made from one, in the embedded world."""
    path = Path(file)
    if path.is_dir():
        raise InputError(f"{path}: is a folder; name one scenario file")
    find_inputs([path])  # refuses what is not there
    config = ConfigFiles().for_source(path)
    try:
        settings = merge_settings(config, path, run_texts)
    except SettingsError as error:
        raise click.UsageError(error.message) from None
    if path.suffix == ".py":
        reporter.report_nothing()
        return _run_written(path, scenario, settings, reporter)
    (compilation,) = compile_all([path], given)
    return _run_source(compilation, scenario, settings, reporter)


def _run_source(
    compilation: Compilation, wanted: str | None, settings: RunSettings, reporter: Reporter
) -> Exit:
    bugs = run_all([compilation], lambda item: item.module)
    code, _ = reporter.report([compilation], bugs)
    if code is not Exit.OK:
        return code
    module = compilation.module
    path = compilation.path
    if module is None:
        raise click.UsageError(f"{path} declares no scenario")
    with scenarios_of_module(module) as scenarios:
        return _run_one_of(scenarios, path, wanted, settings, reporter)


def _run_written(path: Path, wanted: str | None, settings: RunSettings, reporter: Reporter) -> Exit:
    """Run a module that somebody gives us: it may be anything."""
    imported = ExitStack()
    try:
        module = scenarios_of_file(path, f"osc2tx_run_{path.stem}")
        scenarios = imported.enter_context(module)
    except (ImportError, SyntaxError, ValueError, OSError) as error:
        raise InputError(f"{path}: cannot be imported: {error}") from error
    with imported:
        return _run_one_of(scenarios, path, wanted, settings, reporter)


def _run_one_of(
    scenarios: Mapping[str, type[Scenario]],
    path: Path,
    wanted: str | None,
    settings: RunSettings,
    reporter: Reporter,
) -> Exit:
    scenario = choose_scenario(scenarios, wanted, path)
    try:
        result = _run_with_progress(scenario, settings)
    except ScenarioError as error:
        complain(f"{error.source or scenario.source}: error: {error.message}")
        return Exit(error.exit_code)
    except KeyboardInterrupt:
        complain(f"{scenario.name}: interrupted")
        return Exit.INTERRUPTED
    reporter.say(verdict(scenario.name, result))
    return Exit.OK if result.status == "success" else Exit.FAILED


def choose_scenario(
    scenarios: Mapping[str, type[Scenario]], wanted: str | None, path: Path
) -> type[Scenario]:
    """Return the scenario that was asked for, as a generated module chooses it."""
    if not scenarios:
        raise click.UsageError(f"{path} has no scenario")
    try:
        return choose(tuple(scenarios.values()), wanted)
    except SettingsError as error:
        raise click.UsageError(f"{path}: {error.message}") from None


def merge_settings(
    config: Config, path: Path, given: Mapping[str, str | Sequence[str] | None]
) -> RunSettings:
    """Return the settings of a run: the command line beats the file, item by item.

    Maps are searched in the folders of the command line, those of the file, then beside the
    scenario.

    Raises:
        ConfigError: If a text in the file does not have the form of its option.
        SettingsError: If a text of the command line does not.
    """
    stated = config.run_settings(path)
    try:
        read_options(stated)
    except SettingsError as error:
        where = f"{config.path}: in [scenarios.{path.stem}.run]"
        raise ConfigError(f"{where}: {error.message}") from None
    texts: dict[str, tuple[str, ...]] = {}
    for option in OPTIONS:
        written = given.get(option.field)
        own = (written,) if isinstance(written, str) else tuple(written or ())
        texts[option.name] = (*stated.get(option.name, ()), *own)  # the last one of a key counts
    maps = tuple(given.get("map_path") or ())
    texts["map-path"] = (*maps, *stated.get("map-path", ()))
    settings = read_options(texts)
    return replace(settings, map_path=(*settings.map_path, path.resolve().parent))


def _run_with_progress(scenario: type[Scenario], settings: RunSettings) -> RunResult:
    if not sys.stderr.isatty():
        return run_scenario(scenario, settings, keep_trace=False)
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.completed:.0f} s of at most {task.total:.0f} s"),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(scenario.name, total=settings.max_time)

        def show(time: float, most: float) -> None:
            progress.update(task, completed=time, total=most)

        return run_scenario(scenario, settings, show, keep_trace=False)
