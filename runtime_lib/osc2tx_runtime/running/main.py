"""The command line of a generated module: `python hello_world.py --trace out.jsonl`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from osc2tx_runtime.errors import NOT_MET, RUN_FAILED, OwnCode, ScenarioError, SettingsError, coded
from osc2tx_runtime.interrupts import INTERRUPTED, as_usual
from osc2tx_runtime.running.options import OPTIONS, read_options
from osc2tx_runtime.running.runner import RunResult, run_scenario
from osc2tx_runtime.worlds import EMBEDDED, Option, WorldType, find_world
from osc2tx_shared.text import (
    OutputError,
    clear_status,
    complain,
    explain,
    is_watched,
    put,
    say,
    show_status,
    visible,
)

if TYPE_CHECKING:
    from osc2tx_runtime.domain.scenario import Scenario

EXIT_SUCCESS = 0
EXIT_UNREADABLE = 4
EXIT_FAILED = 5
EXIT_BUG = 70

MADE_BY = "Made by osc2tx from "
"""Marker in the docstring of a generated module."""


def main(*scenarios: type[Scenario], argv: Sequence[str] | None = None) -> int:
    """Run a scenario from the command line and print the verdict.

    Args:
        *scenarios: The classes of the module; `--scenario` chooses one of several.
        argv: Arguments; default: those of the process.

    Returns:
        0 success, 5 failure or timeout, 4 unreadable input, no simulator or failing user code, 2
        usage, 130 interrupted by the user, 70 internal error.
    """
    try:
        as_usual()
        return run(scenarios, sys.argv[1:] if argv is None else argv)
    except KeyboardInterrupt:  # before the run, after it, or a second one
        return INTERRUPTED
    except OutputError as error:
        return explain(error)
    except OSError as error:  # the current folder does not exist any more
        complain(f"error: {error}")
        return EXIT_UNREADABLE
    except Exception as error:  # the edge of the process
        from traceback import format_exc

        put(format_exc(), err=True)
        place = place_in_own_code(error, scenarios)
        if place is not None:
            complain(f"error: {place}: {type(error).__name__}: {error}")
            return EXIT_UNREADABLE
        complain("this is a bug of osc2tx; please report it with the lines above")
        return EXIT_BUG


def place_in_own_code(error: Exception, scenarios: Sequence[type[Scenario]]) -> str | None:
    """Return the position at which user code fails, `FILE:LINE`; None if none does.

    User code are the modules of the classes and their bases that the compiler did not write.
    """
    from traceback import extract_tb  # not for a run that ends well

    bases = {base.__module__ for scenario in scenarios for base in scenario.__mro__}
    modules = [sys.modules[name] for name in bases if name in sys.modules]
    files = {
        module.__file__: MADE_BY not in (module.__doc__ or "")
        for module in modules
        if module.__name__.partition(".")[0] not in ("builtins", "osc2tx_runtime")
    }
    frames = [frame for frame in extract_tb(error.__traceback__) if frame.filename in files]
    if not frames or not files[frames[-1].filename]:
        return None
    return f"{frames[-1].filename}:{frames[-1].lineno}"


def run(scenarios: Sequence[type[Scenario]], argv: Sequence[str]) -> int:
    """Run a scenario from a command line; return the exit code.

    Raises:
        OutputError: Its output cannot be written.
    """
    progress = show_progress if is_watched() else None
    try:
        world = chosen_world(argv)
        arguments = vars(make_parser(scenarios, world).parse_args(argv))
        scenario = choose_scenario(scenarios, arguments.pop("scenario"))
    except SettingsError as error:
        complain(f"error: {error.message}")
        return error.exit_code
    try:
        settings = read_options(arguments)
        result = run_scenario(scenario, settings, progress, keep_trace=False)
    except ScenarioError as error:
        clear_progress(progress)
        has_line = (error.source or "").rpartition(":")[2].isdecimal()
        if isinstance(error.__cause__, Exception) and not has_line:
            error.source = place_in_own_code(error.__cause__, (scenario,)) or error.source
        complain(error.report(scenario.source))
        return error.exit_code
    except KeyboardInterrupt:
        clear_progress(progress)
        complain(f"{scenario.name}: interrupted")
        return INTERRUPTED
    clear_progress(progress)
    for line in verdict(scenario.name, result, scenario.source):
        say(line)
    return EXIT_SUCCESS if result.status == "success" else EXIT_FAILED


def choose_scenario(scenarios: Sequence[type[Scenario]], wanted: str | None) -> type[Scenario]:
    """Return the requested scenario, else `top`, `main`, `is_main` or the only one.

    Raises:
        SettingsError: There is no such scenario, or no unique choice.
    """
    by_name = {scenario.name: scenario for scenario in scenarios}
    names = ", ".join(by_name) or "none"
    if wanted is not None:
        if wanted not in by_name:
            raise SettingsError(f"there is no scenario `{wanted}`; available: {names}")
        return by_name[wanted]
    for name in ("top", "main"):
        if name in by_name:
            return by_name[name]
    mains = [scenario for scenario in scenarios if vars(scenario).get("is_main")]
    if len(mains) == 1:
        return mains[0]
    if len(by_name) != 1:
        raise SettingsError(f"choose one with --scenario: {names}")
    return scenarios[0]


def chosen_world(argv: Sequence[str], default: str = EMBEDDED.name) -> WorldType:
    """Return the world of a command line, which has further options.

    Args:
        argv: The command line.
        default: The world if it states none.

    Raises:
        SettingsError: There is no such world.
    """
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False, exit_on_error=False)
    parser.add_argument("--world", default=default)
    try:
        found, _ = parser.parse_known_args(argv)
    except argparse.ArgumentError:
        return EMBEDDED  # the whole parser reports the error
    return find_world(found.world)


class Parser(argparse.ArgumentParser):
    """A parser with the output of the runtime."""

    def _print_message(self, message: str, file: Any = None) -> None:
        put(message, err=file is not sys.stdout)

    def error(self, message: str) -> NoReturn:
        """Report the error of the command line, and end the process."""
        super().error(visible(message))


def make_parser(
    scenarios: Sequence[type[Scenario]], world: WorldType = EMBEDDED
) -> argparse.ArgumentParser:
    """Return the parser of a module with these scenarios, from the tables of options."""
    names = ", ".join(scenario.name for scenario in scenarios)
    what = _plain(f"runs a scenario of {scenarios[0].source}: {names}.")
    parser = Parser(description=f"%(prog)s {what}", allow_abbrev=False)
    parser.add_argument("--scenario", metavar="NAME", help="which scenario to run")
    own = parser.add_argument_group(f"options of the world {world.name}")
    for group, options in ((parser, OPTIONS), (own, world.options)):
        for option in options:
            try:
                add_option(group, option)
            except argparse.ArgumentError:
                told = f"the world {world.name} has an option --{option.name} of its own"
                raise SettingsError(f"{told}, which every run has") from None
    return parser


def _plain(text: str) -> str:
    """Return a text without formats of argparse."""
    return visible(text).replace("%", "%%")


def add_option(group: argparse._ActionsContainer, option: Option) -> None:
    """Add an option of the tables to a parser."""
    with OwnCode(f"--{option.name}: the default raised", error=SettingsError):
        shown = "" if option.default is None else f" (default: {option.default})"
    text = _plain(f"{option.help}{shown}")
    if option.is_flag:
        group.add_argument(f"--{option.name}", help=text, action="store_const", const="true")
        return
    action = "append" if option.repeatable else "store"
    group.add_argument(f"--{option.name}", metavar=option.metavar, help=text, action=action)


def verdict(
    name: str, result: RunResult, file: str = "", given: str | None = None
) -> Iterator[str]:
    """Yield the lines of the verdict of a run.

    Args:
        name: Of the scenario.
        result: Its result.
        file: The scenario file, as the module knows it.
        given: The same file, as the user has written it.
    """
    if result.status == "success":
        count = len(result.collisions)
        collisions = f", with {count} collision{'s' if count > 1 else ''}" if count else ""
        yield f"{_head(name, result)}{collisions}"
    else:
        yield coded(*failure(name, result), result.place or file, file, given)
    for violation in result.violations:
        if violation.severity == "warning":
            yield "  " + coded(violation.code, str(violation), violation.source, file, given)
    for warning in result.warnings:
        yield f"  warning: {warning}"
    for time, one, other in result.collisions:
        yield f"  collision at {time:.2f} s: {one}, {other}"


def failure(name: str, result: RunResult) -> tuple[str, str]:
    """Return the code and the message of an unsuccessful run."""
    place = result.place
    reason = result.reason.replace(f" ({place})", "", 1) if place else result.reason
    code = NOT_MET if any(each.fails(place) for each in result.violations) else RUN_FAILED
    return code, f"{_head(name, result)}: {reason}"


def _head(name: str, result: RunResult) -> str:
    return f"{name}: {result.status} after {result.time:.2f} s"


def show_progress(time: float, most: float) -> None:
    """Show the simulated time on one line of the terminal."""
    show_status(f"{time:7.1f} s of at most {most:g} s")


def clear_progress(progress: Callable[[float, float], None] | None) -> None:
    """Clear the line of the progress."""
    if progress is not None:
        clear_status()
