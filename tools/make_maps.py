"""Writes the OpenDRIVE maps that ship with the runtime library.

Run `python tools/make_maps.py` to write `runtime_lib/osc2tx_runtime/maps/*.xodr`, or give another
folder. The bytes depend on nothing but `own_maps`: a test writes them again and compares.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "runtime_lib")]

from own_maps.motorways import curve, highway, merge  # noqa: E402 (needs the path above)
from own_maps.specs import MapSpec  # noqa: E402
from own_maps.streets import crossing, left_hand, urban_crossing  # noqa: E402
from own_maps.xodr import render  # noqa: E402

FOLDER = ROOT / "runtime_lib" / "osc2tx_runtime" / "maps"

MAPS: dict[str, Callable[[], MapSpec]] = {
    "crossing": crossing,
    "curve": curve,
    "highway": highway,
    "left_hand": left_hand,
    "merge": merge,
    "urban_crossing": urban_crossing,
}


def main(arguments: Sequence[str]) -> int:
    """Writes all maps into the folder given, or into the runtime library."""
    folder = Path(arguments[0]) if arguments else FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    for name, build in MAPS.items():
        (folder / f"{name}.xodr").write_bytes(render(build()))
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
