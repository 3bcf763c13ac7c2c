"""The one Jinja environment."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx.backends.py_trees import layout
from osc2tx.resources import resource_dir

if TYPE_CHECKING:
    from jinja2 import Environment


def template_folder() -> Path:
    """Return the folder of this backend's templates."""
    return Path(str(resource_dir("templates"))) / "py_trees"


@cache
def environment() -> Environment:
    """Return the environment: strict about undefined names, with filters that lay code out."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    made = Environment(
        loader=FileSystemLoader(template_folder()),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=False,
        keep_trailing_newline=True,
    )
    made.filters |= {"statement": layout.statement, "returned": layout.returned}
    return made
