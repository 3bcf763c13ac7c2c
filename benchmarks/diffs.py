"""How many committed lines single edits of scenarios change, by kind of output.

python benchmarks/diffs.py
"""

from __future__ import annotations

import sys
import tempfile
from collections import Counter
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parent.parent))

from tests.end_to_end.single_edits import EDITS, Cost, costs


def main() -> None:
    wanted = sys.argv[1:]
    edits = tuple(e for e in EDITS if not wanted or any(word in str(e) for word in wanted))
    with tempfile.TemporaryDirectory() as folder:
        found = costs(edits, Path(folder))
    suffixes = sorted({suffix for cost in found.values() for suffix in cost.outputs})
    print(" ratio source " + " ".join(f"{suffix[-13:]:>13}" for suffix in suffixes))
    for edit, cost in sorted(found.items(), key=lambda item: item[1].ratio):
        counts = " ".join(f"{cost.outputs[suffix]:13d}" for suffix in suffixes)
        print(f"{cost.ratio:6.1f} {cost.source:6d} {counts}  {edit}")
    _sum_up("all", list(found.values()))
    for kind in dict.fromkeys(edit.kind for edit in found):
        _sum_up(kind, [cost for edit, cost in found.items() if edit.kind == kind])


def _sum_up(name: str, group: list[Cost]) -> None:
    total = sum((cost.outputs for cost in group), Counter[str]())
    source = sum(cost.source for cost in group)
    ratios = [cost.ratio for cost in group]
    told = ", ".join(f"{suffix} {total[suffix] / source:.1f}" for suffix in sorted(total))
    print(
        f"{name}: {len(group)} edits, median {median(ratios):.1f}, worst {max(ratios):.1f}; {told}"
    )


if __name__ == "__main__":
    main()
