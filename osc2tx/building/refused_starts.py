"""What a run refuses before its first step: `check` prepares runs as `run` does.

Only scenarios that name a map that is found are prepared, and none that would call code of the
user's own: a check reads files, it does not execute them. Where packages with actions are
installed, only they tell whether they have an action, so scenarios that may invoke one are left
out; without such packages no run can begin.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from osc2tx.building.run_diagnostics import diagnostic_of_run
from osc2tx.compilation.imports import look_up
from osc2tx.compilation.map_files import named_control_files, named_maps
from osc2tx.compilation.needed_modules import sibling_drafts, siblings_of
from osc2tx.diagnostics import CODES, Severity
from osc2tx.ir.behaviors import Invoke, InvokeScenario
from osc2tx.ir.verify import walk_behaviors
from osc2tx.support.paths import real_path
from osc2tx.support.records import digest
from osc2tx_shared.classes import replace
from osc2tx_shared.map_files import SHIPPED, map_places, places_in_project

if TYPE_CHECKING:
    from osc2tx import ir
    from osc2tx.building.jobs import RunTexts
    from osc2tx.compilation.driver import Compilation
    from osc2tx_runtime import RunSettings, Scenario, ScenarioError
    from osc2tx_runtime.opendrive import RoadMap


def report_refused_starts(compilation: Compilation, texts: RunTexts) -> None:
    """Report why runs of the scenarios of a file would not begin, with the message of `run`.

    Args:
        compilation: A file without errors.
        texts: The options of runs that are stated for it.
    """
    module = compilation.ir
    if module is None or not compilation.has_module:
        return
    folders = [
        *(Path(folder) for name, given in texts if name == "map-path" for folder in given),
        *map(Path, compilation.options.xml.map_path),
        real_path(compilation.path).parent,
    ]
    files = (compilation, *siblings_of(compilation))
    if any(map(_calls_own_methods, files)):
        return
    has_own_actions = any(each.ir is not None and each.ir.actions for each in files)
    scenarios = []
    for each in module.scenarios:
        asks_packages = has_own_actions and _may_invoke_own_action(each)
        if not _can_start(compilation, each, folders, on_any_map=asks_packages):
            continue
        compilation.depends_on_packages |= asks_packages
        if not asks_packages or not _packages_have_actions():
            scenarios.append(each)
    if scenarios:
        _report(compilation, scenarios, dict(texts), folders)


def _calls_own_methods(compilation: Compilation) -> bool:
    module = compilation.ir
    if module is None:
        return False
    scenarios = (*module.bases, *module.scenarios)
    methods = [method for scenario in scenarios for method in scenario.methods]
    methods += [method for each in module.types for method in each.methods]
    return any(method.external is not None for method in methods)


def _may_invoke_own_action(scenario: ir.Scenario) -> bool:
    """Whether a scenario invokes an action of a package, or another scenario that may do so."""
    return any(
        isinstance(each, InvokeScenario) or (isinstance(each, Invoke) and each.is_own)
        for each in walk_behaviors(scenario.body)
    )


def _packages_have_actions() -> bool:
    from osc2tx_runtime.language.actions.registry import methods

    return methods.is_extensible()


def _can_start(
    compilation: Compilation,
    scenario: ir.Scenario,
    folders: Sequence[Path],
    *,
    on_any_map: bool,
) -> bool:
    """Whether a scenario is one to run, whose maps are found; notes what it reads.

    Args:
        compilation: Takes the notes.
        scenario: The scenario.
        folders: Where maps may be.
        on_any_map: Runs may be refused whatever the map is.
    """
    if not scenario.is_runnable:
        return False
    names = {each.name for each in named_maps(scenario)}
    is_found = bool(names) or on_any_map
    for name in names:
        places = tuple(map_places(name, folders))
        for place in places:
            if not place.is_relative_to(SHIPPED):
                compilation.lookups[place] = look_up(place)
        is_found = is_found and any(place.is_file() for place in places)
    beside = [folder.parent if folder.is_file() else folder for folder in folders]
    for name in named_control_files(scenario):
        for place in places_in_project(name, beside):
            compilation.lookups[place] = look_up(place)
    return is_found


def _report(
    compilation: Compilation,
    scenarios: Sequence[ir.Scenario],
    texts: Mapping[str, Sequence[str]],
    folders: Sequence[Path],
) -> None:
    from osc2tx.module_loading import scenarios_of_module
    from osc2tx_runtime import ScenarioError
    from osc2tx_runtime.running.options import read_options

    module = compilation.draft
    assert module is not None, "it has a module"
    found: list[_Refusal | None] = []
    try:
        settings = replace(read_options(texts, is_trusted=False), map_path=tuple(folders))
        if settings.world != "embedded" or settings.control:
            return  # what that world can do, only it knows
        with scenarios_of_module(module, sibling_drafts(compilation)) as classes:
            for scenario in (each for each in scenarios if each.name in classes):
                leaves_map_open = not any(named_maps(scenario))
                scenario_class = classes[scenario.name]
                found.append(_refusal(scenario_class, settings, leaves_map_open=leaves_map_open))
    except ScenarioError as error:
        found.append(_told(error))
    compilation.sink.add(
        diagnostic_of_run(compilation, *each) for each in found if each is not None
    )


_Refusal: TypeAlias = tuple[str, Severity, str, str | None]
"""Code, severity, message and place."""


def _told(error: ScenarioError) -> _Refusal:
    from osc2tx_runtime.errors import NoActionError, SettingsError

    is_mended_outside = isinstance(error, SettingsError | NoActionError)
    assert not is_mended_outside or CODES[error.code].warns_in_check, error.code
    severity = Severity.WARNING if is_mended_outside else Severity.ERROR
    return error.code, severity, error.message, error.source


def _refusal(
    scenario: type[Scenario], settings: RunSettings, *, leaves_map_open: bool
) -> _Refusal | None:
    """Return why a run would not get to its first step, on any map if that is open; else None."""
    from osc2tx_runtime import ScenarioError
    from osc2tx_runtime.errors import NoActionError
    from osc2tx_runtime.running.main import failure
    from osc2tx_runtime.running.runner import check_start

    try:
        result = check_start(scenario, settings, _read)
    except NoActionError as error:
        return _told(error)
    except ScenarioError as error:
        return None if leaves_map_open else _told(error)
    if result.status != "failure" or leaves_map_open:
        return None
    code, message = failure(scenario.name, result)
    return code, Severity.ERROR, message, result.place


def _read(path: Path) -> RoadMap:
    """Read a map; one of the same contents is read once by this process."""
    return _read_contents(path, digest(path.read_bytes()))


@lru_cache(maxsize=8)
def _read_contents(path: Path, contents: str) -> RoadMap:
    from osc2tx_runtime.opendrive import read_map

    return read_map(path)
