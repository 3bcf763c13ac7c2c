"""Each recipe of the site checks without a warning, runs to its end, and is drawn."""

from __future__ import annotations

from pathlib import Path
from runpy import run_path
from typing import Any

import pytest
from lxml.etree import fromstring

from osc2tx import compile_file
from osc2tx.testing import run_scenario
from tests.end_to_end.harness import REPOSITORY

SITE: dict[str, Any] = run_path(str(REPOSITORY / "tools" / "site_recipes.py"))
RECIPES = SITE["recipes"]()
FILES = [recipe.path for recipe in RECIPES]
SECONDS = 60.0  # simulated, in which each of them ends


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_recipe_compiles_and_runs(file: Path) -> None:
    assert compile_file(file, target="py").diagnostics == ()
    run = run_scenario(file, max_time=SECONDS)
    assert run.status == "success", run.reason
    assert not run.collisions and not run.warnings


def test_there_are_recipes_for_what_engineers_write_most() -> None:
    assert len(RECIPES) >= 30
    assert len({recipe.title for recipe in RECIPES}) == len(RECIPES)
    names = {file.stem for file in FILES}
    assert {name for group in SITE["SHOWN"].values() for name in group} <= names


def test_the_page_has_them_all() -> None:
    page = SITE["page"](RECIPES)
    for recipe in RECIPES:
        assert f"## {recipe.title}\n" in page
        assert f"scenario {recipe.path.stem}:" in page
        assert f"({recipe.path.stem}.svg)" in page


def test_pictures_show_paths_on_their_lanes_and_who_stands() -> None:
    (recipe,) = (each for each in RECIPES if each.path.stem == "parked_car")
    drawn = fromstring(SITE["picture"](recipe))
    assert {"ego", "parked"} <= {node.text for node in drawn.iter("{*}text")}
    dots = [node.get("r") for node in drawn.iter("{*}circle")]
    assert len(set(dots)) == len(dots) == 2, "a path begins, and a car stands"
    assert len(list(drawn.iter("{*}polygon"))) >= 3


def test_a_stop_at_a_red_light_is_a_stop() -> None:
    (file,) = (each for each in FILES if each.stem == "red_light")
    run = run_scenario(file)
    assert run.state("ego", 13.5)["v"] == pytest.approx(0.0, abs=0.01)
    assert run.state("ego", 20.0)["v"] > 5.0
