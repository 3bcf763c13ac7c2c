"""Warnings of a run about its map: errors of the file, and lanes that do not fit together."""

from __future__ import annotations

from osc2tx_runtime.opendrive import RoadMap

_NAMED = 3  # remarks; `osc2tx map` lists all


def map_warnings(road_map: RoadMap) -> tuple[str, ...]:
    """Return a sentence for each of the first remarks, and one for all seams."""
    name, remarks, seams = road_map.name, road_map.remarks, road_map.seams()
    found = [f"map {name}: {remark}" for remark in remarks[:_NAMED]]
    if len(remarks) > _NAMED:
        found.append(f"map {name}: {len(remarks) - _NAMED} more remarks; `osc2tx map` lists them")
    if seams:
        worst = max(seams, key=lambda seam: (seam.gap, seam.turn))
        found.append(
            f"map {name}: lanes do not fit together at {len(seams)} places, worst {worst};"
            " `osc2tx map` lists them"
        )
    return tuple(found)
