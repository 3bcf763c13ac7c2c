"""Hook of mkdocs: the page of recipes, from the scenarios in `docs/recipes`.

The first comment line of a scenario is the title, the others are the explanation. The picture comes
from a run: speeds over time, ways across the lanes, or the paths from above.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parent.parent
sys.path[:0] = [str(REPOSITORY), str(Path(__file__).parent)]

from site_pictures import chart_of_run  # noqa: E402

FOLDER = REPOSITORY / "docs" / "recipes"
PAGE = "recipes/index.md"
# What the picture of a recipe shows: `above`, `lanes` or `speeds`; from above where it is not here.
SHOWN = {
    "speeds": (
        *("constant_speed", "speed_up", "brake_to_standstill", "red_light", "follow_time_gap"),
        *("close_up", "range_of_values", "wait_time", "time_to_collision", "time_out"),
        *("rain_and_fog", "fail_on_condition", "record_a_value"),
    ),
    "lanes": (
        *("lane_change", "cut_in_at_gap", "cut_out", "wait_for_event", "overtake"),
        *("reuse_a_maneuver", "follow_then_free"),
    ),
}


@dataclass(frozen=True)
class Recipe:
    """A scenario that shows one thing.

    Attributes:
        path: Its file.
        title: What it does, as an imperative sentence.
        text: How.
        code: The scenario without these comments.
    """

    path: Path
    title: str
    text: str
    code: str


def recipes() -> list[Recipe]:
    """Return the recipes in the order of their titles."""
    return sorted(map(_read, FOLDER.glob("*.osc")), key=lambda recipe: recipe.title)


def _read(path: Path) -> Recipe:
    lines = path.read_text(encoding="utf-8").splitlines()
    count = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    title, *more = (line.removeprefix("#").strip() for line in lines[:count])
    return Recipe(path, title, " ".join(more), "\n".join(lines[count:]).strip())


def picture(recipe: Recipe) -> str:
    """Return the picture of a run of a recipe as SVG."""
    name = recipe.path.stem
    kind = next((kind for kind, names in SHOWN.items() if name in names), "above")
    return chart_of_run(recipe.path, kind)


def page(found: Sequence[Recipe]) -> str:
    """Return the page."""
    parts = ["# How do I …"]
    parts.append(
        "Each recipe is a complete scenario: copy it, check it with `osc2tx check`, and start it"
        " with `osc2tx run`. The pictures show these runs."
    )
    for recipe in found:
        name = recipe.path.name
        parts += [
            f"## {recipe.title}",
            *([recipe.text] if recipe.text else []),
            f"![{recipe.title}]({recipe.path.stem}.svg)",
            f"```\n{recipe.code}\n```",
            f"[{name}]({name})",
        ]
    return "\n\n".join(parts) + "\n"


def on_files(files: Any, config: Any, **_: Any) -> Any:
    """Make the page and its pictures; called by mkdocs."""
    from mkdocs.structure.files import File

    found = recipes()
    made = {PAGE: page(found)}
    made |= {f"recipes/{each.path.stem}.svg": picture(each) for each in found}
    for place, text in made.items():
        files.append(File.generated(config, place, content=text))
    return files
