"""Writes what the runtime library carries out into the compiler's table.

The compiler refuses what the table does not list. Run it after a change of the runtime's actions,
modifiers, methods or actors; a test compares.
"""

import json
import sys
from pathlib import Path

from osc2tx_runtime.domain.capabilities import capabilities

TABLE = Path(__file__).parent.parent / "osc2tx/backends/py_trees/runtime_api.json"
USED = (
    *("actions", "modifiers", "placement", "exclusive"),
    *("conflicts", "no_start", "rules", "sorts", "contradictions", "shapes"),
    *("on_lanes", "lane_bound"),
    *("methods", "fields", "objects", "needed", "asked", "unknown", "reserved", "enums"),
)


def render() -> str:
    """Return the table as text."""
    table = capabilities()
    return json.dumps({name: table[name] for name in USED}, indent=1) + "\n"


if __name__ == "__main__":
    TABLE.write_text(render(), encoding="utf-8")
    sys.exit(0)
