"""Options shared by several commands."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import Any

import click

from osc2tx.config import Config, ConfigError, ConfigFiles, GivenOptions
from osc2tx.options import DIALECTS, ONE_OF_POLICIES, STANDARDS, TARGETS, XML_PROFILES, XML_VERSIONS
from osc2tx.support.paths import real_path


def sources_or_stated(paths: tuple[str, ...], what: str) -> tuple[str, ...]:
    """Return the paths of a command line, or those of the settings of this folder.

    Args:
        paths: The paths as written.
        what: The verb of the command, as in `check`.

    Raises:
        click.UsageError: If there are neither.
    """
    return paths or stated_sources(ConfigFiles().for_folder(Path.cwd()), what)


def stated_sources(project: Config, what: str) -> tuple[str, ...]:
    """Return the `sources` of a settings file, relative to this folder.

    Raises:
        click.UsageError: If it states none.
        ConfigError: If one of them does not exist.
    """
    if not project.sources:
        raise click.UsageError(f"nothing to {what}: name a file or folder, or set `sources`")
    for path in project.sources:
        if not Path(path).exists():
            raise ConfigError(f"{project.path}: `sources`: there is no file or folder {path}")
    return tuple(str(seen_from(path, Path.cwd())) for path in project.sources)


def seen_from(path: Path, folder: Path) -> Path:
    """Return a path relative to a folder, for a reader who works there."""
    path = Path(os.path.normpath(path))
    return path.relative_to(folder) if path.is_relative_to(folder) else path


workers_option = click.option(
    "-j",
    "--jobs",
    "workers",
    type=click.IntRange(min=1),
    metavar="N",
    help="Number of processes.  [default: one per processor]",
)
cache_option = click.option(
    "--cache-dir",
    "cache",
    type=click.Path(file_okay=False, path_type=Path),
    envvar="OSC2TX_CACHE_DIR",
    help="Folder of earlier results, for CI.  [default: in the user's cache]",
)


affected_option = click.option(
    "--affected-since",
    "affected",
    metavar="GIT_REV",
    help="Only sources that changes since a revision can affect.",
)


def affected_sources(
    paths: Sequence[str], revision: str | None, given: GivenOptions
) -> tuple[str, ...]:
    """Return the sources among some paths that a change can affect; all without a revision.

    Raises:
        InputError: The paths are in no repository, or it has no such revision.
    """
    if revision is None:
        return tuple(paths)
    from osc2tx.building.affected import affected_since
    from osc2tx.building.jobs import find_jobs

    configs = ConfigFiles()
    jobs = find_jobs(paths, given, configs)
    chosen = {each.path for each in affected_since(revision, jobs, configs)}
    return tuple(str(job.path) for job in jobs if real_path(job.path) in chosen)


_NAMES = {
    ".osc": re.compile(r"^scenario\s+([\w.]+)", re.MULTILINE),
    ".py": re.compile(r'^    name = "([\w.]+)"$', re.MULTILINE),
}


def scenario_option(verb: str) -> Callable[..., Any]:
    """Return the option that selects the scenario of a FILE."""
    help_ = f"Scenario of the file to {verb}."
    return click.option("--scenario", metavar="NAME", shell_complete=_complete_scenario, help=help_)


def _complete_scenario(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> list[str]:
    """Offer the scenarios of the file, as one sees them without compiling it."""
    words = [context.params.get("file"), *context.args]  # there as long as the line is incomplete
    paths = [Path(str(word)) for word in words if word is not None]
    path = next((path for path in paths if path.suffix in _NAMES), None)
    if path is None:
        return []
    try:
        names = dict.fromkeys(_NAMES[path.suffix].findall(path.read_text(encoding="utf-8")))
    except (OSError, ValueError):
        return []
    return [name for name in names if name.startswith(incomplete)]


def gathered(
    name: str, make: Callable[..., object], *options: Callable[[Any], Any]
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds options to a command, which gets their values as one argument.

    Args:
        name: The argument of the command.
        make: Takes the values by name, and returns the argument.
        options: The options, in the order of the help page.
    """

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        names: list[str] = []

        @wraps(command)
        def with_argument(*args: Any, **values: Any) -> Any:
            own = {each: values.pop(each) for each in names}
            return command(*args, **values, **{name: make(**own)})

        decorated: Any = with_argument
        for option in reversed(options):
            decorated = option(decorated)
            names.append(decorated.__click_params__[-1].name)
        return with_argument

    return decorate


def _given(*, no_verify: bool = False, **stated: Any) -> GivenOptions:
    verify = False if no_verify else None
    return GivenOptions(**{name: value or None for name, value in stated.items()}, verify=verify)


_COMPILE = (
    click.option("--std", type=click.Choice(STANDARDS), help="Version of the standard."),
    click.option("--dialect", type=click.Choice(DIALECTS), help="Dialect of the sources."),
    click.option("--one-of", type=click.Choice(ONE_OF_POLICIES), help="Meaning of `one_of`."),
    click.option(
        "-I",
        "import_paths",
        metavar="DIR",
        type=click.Path(exists=True, file_okay=False, resolve_path=True),
        multiple=True,
        help="Folder where `import a.b` finds `a/b.osc`, if it is not in the project.",
    ),
)
compile_options = gathered("given", _given, *_COMPILE)
"""Adds the options of compilation; the command gets them as `given`."""

target_options = gathered(
    "given",
    _given,
    *_COMPILE,
    click.option(
        "--target",
        type=click.Choice(TARGETS),
        help="Outputs: `xosc` reports constructs that OpenSCENARIO XML cannot express as"
        " errors, `all` omits such XML.  [default: all]",
    ),
    click.option(
        "--xml-version",
        type=click.Choice(XML_VERSIONS),
        help="Version of OpenSCENARIO XML.  [default: 1.3]",
    ),
    click.option(
        "--xml-profile",
        type=click.Choice(XML_PROFILES),
        help="Tool that is to read the XML.  [default: generic]",
    ),
    click.option("--allow-approx", is_flag=True, help="Write approximated XML as well."),
    click.option(
        "--signal",
        metavar="NAME@SECONDS",
        multiple=True,
        help="For XML: time of an external event.",
    ),
    click.option(
        "--spawn",
        metavar="ACTOR=ROAD,LANE,S",
        multiple=True,
        help="For XML: start position of an actor that the scenario does not place.",
    ),
    click.option(
        "--map-path",
        type=click.Path(exists=True),
        multiple=True,
        help="For XML: folder with maps, or the map itself.",
    ),
    click.option(
        "--no-verify",
        is_flag=True,
        help="Do not play the XML: its grades are computed, not measured.",
    ),
)
"""Adds the options of compilation and of outputs; the command gets them as `given`."""
