"""Writes `docs/coverage.md` from registries, scenarios and tests; `--check` only compares."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from tests.coverage.page import PAGE, render


def main() -> int:
    """Write the page; with `--check`, return 1 if it is out of date."""
    text = render()
    if "--check" in sys.argv[1:]:
        return int(PAGE.read_text(encoding="utf-8") != text)
    PAGE.write_text(text, encoding="utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
