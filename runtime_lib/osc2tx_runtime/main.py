"""The command line of a generated module: `python hello_world.py --trace out.jsonl`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.runner import RunResult, run_scenario
from osc2tx_runtime.settings import OPTIONS, RunSettings

if TYPE_CHECKING:
    from osc2tx_runtime.scenario import Scenario

__all__ = ["main", "verdict"]

EXIT_SUCCESS = 0
EXIT_FAILED = 5


def main(scenario: type[Scenario], argv: Sequence[str] | None = None) -> int:
    """Run a scenario from the command line and print the verdict.

    Args:
        scenario: The class.
        argv: Arguments; those of the process by default.

    Returns:
        0 success, 5 ran and failed or ran out of time, 4 unreadable input, 2 usage.
    """
    arguments = vars(make_parser(scenario).parse_args(argv))
    progress = show_progress if sys.stderr.isatty() else None
    try:
        settings = RunSettings.from_options(arguments)
        result = run_scenario(scenario, settings, progress, keep_trace=False)
    except ScenarioError as error:
        clear_progress(progress)
        print(f"{error.source or scenario.source}: error: {error.message}", file=sys.stderr)
        return error.exit_code
    clear_progress(progress)
    print(verdict(scenario.name, result))
    return EXIT_SUCCESS if result.status == "success" else EXIT_FAILED


def make_parser(scenario: type[Scenario]) -> argparse.ArgumentParser:
    """Return the parser of a scenario, from the table of options."""
    parser = argparse.ArgumentParser(
        description=f"Run the scenario {scenario.name} ({scenario.source}).", allow_abbrev=False
    )
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
