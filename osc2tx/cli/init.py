"""`osc2tx init`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import click

from osc2tx.cli.reporting import Exit
from osc2tx.options import STANDARDS
from osc2tx.resources import resource_dir
from osc2tx_shared.text import complain, put, say

SETTINGS = "settings.toml"

# Path in the new project -> its text, from templates/project.
FILES: Mapping[str, str] = {
    "osc2tx.toml": SETTINGS,
    "scenarios/slow_down.osc": "scenario.osc",
    "tests/test_scenarios.py": "test_scenarios.py",
    ".gitignore": "gitignore",
    ".gitattributes": "gitattributes",
    ".pre-commit-config.yaml": "pre-commit-config.yaml",
    ".github/workflows/scenarios.yml": "workflow.yml",
}
NEXT_STEPS = """\
  osc2tx build                            # writes generated/
  osc2tx run scenarios/slow_down.osc --report slow_down.html
  pytest                                  # generated files are fresh, the scenario runs
Commit generated/ with the scenarios: reviewers read both."""


@click.command()
@click.argument("folder", default=".", type=click.Path(path_type=Path, file_okay=False))
@click.option(
    "--std",
    type=click.Choice(STANDARDS),
    default=STANDARDS[0],
    show_default=True,
    help="Version of the standard.",
)
@click.option(
    "--from-xml",
    "library",
    metavar="FOLDER",
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    help="Import the OpenSCENARIO XML documents of a folder into scenarios/.",
)
def init(folder: Path, std: str, library: Path | None) -> Exit:
    """Start a project: a scenario, settings, a test, a pre-commit hook and a CI workflow.

    Files that exist already are left as they are.
    """
    imported = None
    if library is not None:
        from osc2tx.cli.import_ import import_folder  # with the reader of maps

        imported = import_folder(library, folder / "scenarios")
    templates = resource_dir("templates") / "project"
    for name, template in FILES.items():
        place = folder / name
        own = f'std = "{std}"\n' if template == SETTINGS else ""
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            with place.open("x", encoding="utf-8", newline="\n") as file:
                file.write((templates / template).read_text(encoding="utf-8") + own)
        except FileExistsError:
            complain(f"{place}: exists, unchanged")
        except OSError as error:
            complain(f"{place}: cannot be written: {error.strerror}")
            return Exit.UNREADABLE
        else:
            say(f"{place}: written")
    put("\nNext:")
    if folder != Path():
        say(f"  cd {folder}")
    put(NEXT_STEPS)
    return Exit.OK if imported is None else imported
