"""The command line of a generated module: `python hello_world.py --trace out.jsonl`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.running.options import OPTIONS, read_options
from osc2tx_runtime.running.runner import RunResult, run_scenario

if TYPE_CHECKING:
    from osc2tx_runtime.domain.scenario import Scenario

__all__ = ["choose_scenario", "main", "verdict"]

EXIT_SUCCESS = 0
EXIT_FAILED = 5
EXIT_INTERRUPTED = 130  # as shells have it: 128 + SIGINT


def main(*scenarios: type[Scenario], argv: Sequence[str] | None = None) -> int:
    """Run a scenario from the command line and print the verdict.

    Args:
        *scenarios: The classes of the module; `--scenario` chooses one of several.
        argv: Arguments; those of the process by default.

    Returns:
        0 success, 5 ran and failed or ran out of time, 4 unreadable input, 2 usage, 130 when the
        user interrupts it.
    """
    arguments = vars(make_parser(scenarios).parse_args(argv))
    progress = show_progress if sys.stderr.isatty() else None
    try:
        scenario = choose_scenario(scenarios, arguments.pop("scenario"))
    except SettingsError as error:
        print(f"error: {error.message}", file=sys.stderr)
        return error.exit_code
    try:
        settings = read_options(arguments)
        result = run_scenario(scenario, settings, progress, keep_trace=False)
    except ScenarioError as error:
        clear_progress(progress)
        print(f"{error.source or scenario.source}: error: {error.message}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        clear_progress(progress)
        print(f"{scenario.name}: interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED
    clear_progress(progress)
    print(verdict(scenario.name, result))
    return EXIT_SUCCESS if result.status == "success" else EXIT_FAILED


def choose_scenario(scenarios: Sequence[type[Scenario]], wanted: str | None) -> type[Scenario]:
    """Return the scenario that was asked for, else `top`, `main` or the only one.

    Raises:
        SettingsError: If there is no such scenario, or several to choose from.
    """
    by_name = {scenario.name: scenario for scenario in scenarios}
    names = ", ".join(by_name) or "none"
    if wanted is not None:
        if wanted not in by_name:
            raise SettingsError(f"there is no scenario `{wanted}`; there is: {names}")
        return by_name[wanted]
    for name in ("top", "main"):
        if name in by_name:
            return by_name[name]
    if len(by_name) != 1:
        raise SettingsError(f"choose one with --scenario: {names}")
    return scenarios[0]


def make_parser(scenarios: Sequence[type[Scenario]]) -> argparse.ArgumentParser:
    """Return the parser of a module with these scenarios, from the table of options."""
    names = ", ".join(scenario.name for scenario in scenarios)
    parser = argparse.ArgumentParser(
        description=f"Run a scenario of {scenarios[0].source}: {names}.", allow_abbrev=False
    )
    parser.add_argument("--scenario", metavar="NAME", help="which scenario to run")
    for option in OPTIONS:
        shown = "" if option.default is None else f" (default: {option.default})"
        parser.add_argument(
            f"--{option.name}",
            metavar=option.metavar,
            help=f"{option.help}{shown}",
            action="append" if option.repeatable else "store",
        )
    return parser


def verdict(name: str, result: RunResult) -> str:
    """Return the lines that say how a run ended."""
    head = f"{name}: {result.status} after {result.time:.2f} s"
    lines = [f"{head}: {result.reason}" if result.reason else head]
    lines += [f"  collision at {t:.2f} s: {one}, {other}" for t, one, other in result.collisions]
    return "\n".join(lines)


def show_progress(time: float, most: float) -> None:
    """Show the simulated time on one line of the terminal."""
    print(f"\r{time:7.1f} s of at most {most:g} s", end="", file=sys.stderr, flush=True)


def clear_progress(progress: Callable[[float, float], None] | None) -> None:
    """Wipe the line of the progress."""
    if progress is not None:
        print("\r\033[K", end="", file=sys.stderr, flush=True)
