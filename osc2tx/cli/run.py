"""`osc2tx run`: runs scenarios in the embedded world or a simulator."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import click

from osc2tx.building.jobs import compile_all, run_all
from osc2tx.building.run_diagnostics import diagnostic_of_run
from osc2tx.cli.options import compile_options, scenario_option
from osc2tx.cli.reporting import Exit, Reporter, report_options
from osc2tx.compilation.inputs import InputError, find_inputs
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import Config, ConfigError, ConfigFiles, GivenOptions
from osc2tx.diagnostics import CODES
from osc2tx.module_loading import scenarios_of_file, scenarios_of_module
from osc2tx.support.paths import real_path
from osc2tx_runtime import RunResult, RunSettings, Scenario, ScenarioError, run_scenario
from osc2tx_runtime.errors import OwnCode, SettingsError
from osc2tx_runtime.running.main import choose_scenario as choose
from osc2tx_runtime.running.main import chosen_world, failure, verdict
from osc2tx_runtime.running.options import OPTIONS, read_options
from osc2tx_runtime.worlds import EMBEDDED, Option
from osc2tx_shared.classes import replace
from osc2tx_shared.text import complain, is_watched, visible

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Compilation


def click_option(option: Option) -> click.Option:
    """Return an option of the runtime's tables as one of click."""
    default = "" if option.default is None else f"  [default: {option.default}]"
    if option.is_flag:
        return click.Option([f"--{option.name}", option.field], is_flag=True, help=option.help)
    return click.Option(
        [f"--{option.name}", option.field],
        metavar=option.metavar,
        multiple=option.repeatable,
        help=option.help + default,
    )


class RunCommand(click.Command):
    """A command with the options of a run, and those of its world.

    Attributes:
        without: Names of options that it does not have.
    """

    without: frozenset[str] = frozenset()

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Find out which world it is, before anything else is read."""
        try:
            ctx.meta[OWN_OPTIONS] = chosen_world(args, stated_world(args)).options
        except SettingsError as error:
            raise click.UsageError(error.message, ctx) from None
        return super().parse_args(ctx, args)

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Return all options."""
        every = (option for option in OPTIONS if option.name not in self.without)
        own = (*every, *ctx.meta.get(OWN_OPTIONS, ()))
        params = super().get_params(ctx)
        return [*params[:-1], *map(click_option, own), params[-1]]  # `--help` stays last


def stated_world(args: Sequence[str]) -> str:
    """Return the world that the settings state for the file of a command line."""
    for path in (Path(arg) for arg in args if arg.endswith((".osc", ".py"))):
        with suppress(ConfigError):  # reported when the settings are read
            stated = ConfigFiles().for_source(path).run_settings(path)
            return stated.get("world", (EMBEDDED.name,))[-1]
    return EMBEDDED.name


OWN_OPTIONS = f"{__name__}.own_options"

Finding: TypeAlias = tuple[str, str, str | None]
"""A finding of a run: code, message and position."""

Texts: TypeAlias = Mapping[str, Sequence[str]]
"""Options as they are written, by name."""


@click.command(cls=RunCommand)
@click.argument("file", metavar="FILE", type=click.Path())
@scenario_option("run")
@compile_options
@report_options
def run(
    file: str,
    scenario: str | None,
    given: GivenOptions,
    reporter: Reporter,
    **written: str | bool | tuple[str, ...] | None,
) -> Exit:
    """Run a scenario file, or a module made from one."""
    run_texts = {name: option_texts(value) for name, value in written.items()}
    path = Path(file)
    if path.is_dir():
        raise InputError(f"{path}: is a folder; name one scenario file")
    find_inputs([path])  # rejects missing files
    config = ConfigFiles().for_source(path)
    try:
        settings = merge_settings(config, path, run_texts)
    except SettingsError as error:
        raise click.UsageError(error.message) from None
    if path.suffix == ".py":
        reporter.report_failed_start()
        return _run_written(path, scenario, settings, reporter)
    (compilation,) = compile_all([path], with_maps_of(given, settings))
    return _run_source(compilation, scenario, settings, reporter)


def _run_source(
    compilation: Compilation, wanted: str | None, settings: RunSettings, reporter: Reporter
) -> Exit:
    bugs = run_all([compilation], lambda item: item.module)
    exit_code, _ = reporter.judge([compilation], bugs)
    is_text = reporter.form == "text"
    if is_text or exit_code is not Exit.OK:  # one document, with the findings of the run
        reporter.report([compilation], bugs)
    if exit_code is not Exit.OK:
        return exit_code
    module = compilation.module
    path = compilation.path
    if module is None:
        raise click.UsageError(f"{path} declares no scenario")
    findings: list[Finding] = []
    try:
        with scenarios_of_module(module, sibling_modules(compilation)) as scenarios:
            exit_code = _run_one_of(scenarios, path, wanted, settings, reporter, findings)
    except ScenarioError as error:
        complain(error.report(str(path)))
        findings.append((error.code, error.message, error.source))
        exit_code = Exit(error.exit_code)
    if not is_text:
        compilation.sink.add(
            diagnostic_of_run(compilation, code, CODES[code].severity, message, place)
            for code, message, place in findings
        )
        reporter.report([compilation])
    return exit_code


def _run_written(path: Path, wanted: str | None, settings: RunSettings, reporter: Reporter) -> Exit:
    """Run a module of unknown origin: it may contain anything."""
    imported = ExitStack()
    module = scenarios_of_file(path, f"osc2tx_run_{path.stem}")
    try:
        with OwnCode("cannot be imported:"):
            scenarios = imported.enter_context(module)
    except ScenarioError as error:
        raise InputError(f"{path}: {error.message}") from error
    with imported:
        return _run_one_of(scenarios, path, wanted, settings, reporter, [])


def _run_one_of(
    scenarios: Mapping[str, type[Scenario]],
    path: Path,
    wanted: str | None,
    settings: RunSettings,
    reporter: Reporter,
    findings: list[Finding],
) -> Exit:
    """Run a scenario, print its outcome, and collect its diagnostics."""
    scenario = choose_scenario(scenarios, wanted, path)
    given = str(path) if path.suffix == ".osc" else None
    try:
        result = _run_with_progress(scenario, settings)
    except ScenarioError as error:
        complain(error.report(scenario.source, given))
        findings.append((error.code, error.message, error.source))
        return Exit(error.exit_code)
    except KeyboardInterrupt:
        complain(f"{scenario.name}: interrupted")
        return Exit.INTERRUPTED
    succeeded = result.status == "success"
    if not succeeded:
        findings.append((*failure(scenario.name, result), result.place))
    warnings = (each for each in result.violations if each.severity == "warning")
    findings += [(each.code, str(each), each.source) for each in warnings]
    for line in verdict(scenario.name, result, scenario.source, given):
        (reporter.say if succeeded else reporter.say_anyway)(line)
    return Exit.OK if succeeded else Exit.FAILED


def choose_scenario(
    scenarios: Mapping[str, type[Scenario]], wanted: str | None, path: Path
) -> type[Scenario]:
    """Return the requested scenario, as a generated module selects it."""
    if not scenarios:
        raise click.UsageError(f"{path} declares no scenario")
    try:
        return choose(tuple(scenarios.values()), wanted)
    except SettingsError as error:
        raise click.UsageError(f"{path}: {error.message}") from None


def option_texts(written: str | bool | tuple[str, ...] | None) -> tuple[str, ...]:
    """Return the text of an option; a flag is `true`."""
    if isinstance(written, bool):
        return ("true",) if written else ()
    return (written,) if isinstance(written, str) else written or ()


def merge_settings(config: Config, path: Path, given: Texts) -> RunSettings:
    """Return the settings of a run: the command line beats the file, item by item.

    Maps are searched in the folders of the command line, those of the file, then beside the
    scenario.

    Raises:
        ConfigError: If a text in the file does not have the form of its option.
        SettingsError: If a text of the command line does not.
    """
    return settings_from(merge_texts(config, path, given), path)


def settings_from(texts: Texts, path: Path) -> RunSettings:
    """Return the settings of options, as texts, for a scenario file."""
    settings = read_options(texts)
    return replace(settings, map_path=(*settings.map_path, real_path(path).parent))


def with_maps_of(given: GivenOptions, settings: RunSettings) -> GivenOptions:
    """Return compile options that search maps in the folders of a run."""
    *folders, _beside_the_file = settings.map_path
    return replace(given, map_path=tuple(map(str, folders)))


def merge_texts(config: Config, path: Path, given: Texts) -> dict[str, tuple[str, ...]]:
    """Return the options of a run as they are written, on the command line or in the file.

    Raises:
        ConfigError: If a text in the file does not have the form of its option.
    """
    stated = config.run_settings(path)
    try:
        read_options(stated, is_trusted=False)
    except SettingsError as error:
        tables = " or ".join(f"[{name}.run]" for name, _ in config.tables_for(path))
        where = f"{config.path}: in {tables}"
        raise ConfigError(f"{where}: {error.message}") from None
    own = {name.replace("_", "-"): tuple(texts) for name, texts in given.items()}
    texts = {
        name: (*stated.get(name, ()), *own.get(name, ()))  # the last one of a key counts
        for name in dict.fromkeys((*stated, *own))
    }
    texts["map-path"] = (*own.get("map-path", ()), *stated.get("map-path", ()))
    return texts


def _run_with_progress(scenario: type[Scenario], settings: RunSettings) -> RunResult:
    if not is_watched():
        return run_scenario(scenario, settings, keep_trace=False)
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.completed:.0f} s of at most {task.total:.0f} s"),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(visible(scenario.name), total=settings.max_time)

        def show(time: float, most: float) -> None:
            progress.update(task, completed=time, total=most)

        return run_scenario(scenario, settings, show, keep_trace=False)
