"""What a run, CARLA and OpenSCENARIO XML make of actions and modifiers, from `shown.json`.

`tools/make_reference.py` makes the table from scenarios of the repository, so that the reference
shows nothing that no test runs.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

from osc2tx_classes import dataclass

__all__ = ["NOTHING", "TABLE", "Shown", "shown"]

TABLE = Path(__file__).with_name("shown.json")


@dataclass(frozen=True, slots=True)
class Shown:
    """What there is to show of an action or modifier; empty where there is nothing.

    Attributes:
        carla: How it does in CARLA.
        xml: Since which version OpenSCENARIO XML says it, or why not.
        file: A scenario that uses it.
        example: Lines of that.
        xml_example: What they become in the newest OpenSCENARIO XML.
    """

    carla: str = ""
    xml: str = ""
    file: str = ""
    example: str = ""
    xml_example: str = ""


NOTHING = Shown()


def shown(key: str) -> Shown:
    """Return what there is of an entry: `action vehicle.drive`."""
    return _table().get(key, NOTHING)


@cache
def _table() -> dict[str, Shown]:
    rows = json.loads(TABLE.read_text(encoding="utf-8"))
    return {key: Shown(**row) for key, row in rows.items()}
