"""The answers of the playground, called by its page."""

import json
from collections.abc import Iterator
from contextlib import contextmanager

from osc2tx import apply_fixes, check_text
from osc2tx.building.jobs import job_of_text
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import GivenOptions
from osc2tx.module_loading import scenarios_of_module

NAME = "scenario.osc"
LONGEST = 60.0  # simulated seconds


def check(text: str) -> str:
    """Return the diagnostics of a text as JSON."""
    return json.dumps(
        [
            {
                "place": str(found.primary),
                "severity": found.severity.value,
                "code": found.code,
                "message": found.message,
                "help": found.help,
            }
            for found in check_text(text, name=NAME).diagnostics
        ]
    )


def fixed(text: str, unsafe: bool) -> str:
    """Return a text after its fixes."""
    return apply_fixes(text, unsafe=unsafe, name=NAME)


def formatted(text: str) -> str:
    """Return a text in the style of the standard; itself if it has syntax errors."""
    compilation = job_of_text(NAME, ".", GivenOptions()).compilation(text=text)
    return compilation.formatted or text


def tree(text: str) -> str:
    """Return the behavior tree of the last scenario as SVG; nothing if there is none."""
    from osc2tx_runtime.report.tree_pictures import tree_svg

    with _last_scenario(text) as scenario:
        return "" if scenario is None else tree_svg(scenario().create_tree())


def run(text: str) -> str:
    """Run the last scenario; return how it ended, and the times of its actions and events."""
    from osc2tx_runtime import RunSettings, ScenarioError, run_scenario

    with _last_scenario(text) as scenario:
        if scenario is None:
            return "there is no scenario to run: see the list below"
        try:
            result = run_scenario(scenario, RunSettings(max_time=LONGEST))
        except ScenarioError as error:
            return error.report(NAME)
    lines = [f"{result.status} after {result.time:.2f} s {result.reason}".rstrip()]
    for line in map(json.loads, result.trace_lines):
        if line["kind"] in ("action", "event"):
            lines.append(f"{line['t']:7.2f} s  {line['name']} {line.get('status', '')}".rstrip())
        if line["kind"] == "collision":
            lines.append(f"{line['t']:7.2f} s  collision")
    return "\n".join(lines)


@contextmanager
def _last_scenario(text: str) -> Iterator[type | None]:
    compilation = job_of_text(NAME, ".", GivenOptions()).compilation(text=text)
    if compilation.draft is None:
        yield None
        return
    with scenarios_of_module(compilation.draft, sibling_modules(compilation)) as found:
        yield list(found.values())[-1]
