"""Writes `osc2tx/reference/shown.json`: examples, and what CARLA and XML make of the library."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from tests.coverage.reference import TABLE, render

if __name__ == "__main__":
    TABLE.write_text(render(), encoding="utf-8", newline="\n")
