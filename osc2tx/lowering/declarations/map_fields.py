"""Fields of roads, lanes and lights whose values come from the map.

Scenarios may bound some of them; the runtime then selects matching parts of the map.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.semantics import symbols as sym

# Types of values read from the map: their fields can be read when the scenario is on its map, ...
MAP_FIELDS = frozenset(
    {"compound_lane", "compound_route", "crossing", "crossing_type", "junction", "lane"}
    | {"lane_section", "map", "road", "route", "traffic_light", "traffic_light_group"}
    | {"traffic_light_stop_line"}
)
# ... except those that a scenario states itself.
SCENARIO_FIELDS = frozenset({"group", "map_id", "traffic_light_control", "traffic_light_group"})
# Numbers that a scenario may leave to the map within bounds.
SEARCH_CRITERIA = frozenset({"length", "max_lanes", "min_lanes", "width"})

NOT_SEARCHED_BY = "the map provides this value and is not searched by it"
SEARCHED_BY = (
    "bounds such as `keep(it.length >= 100m)` and `keep(it.width in [3m..4m])` select parts of the"
    " map; so do values, lists of members and modifiers of the map"
)


def is_search_criterion(field: sym.FieldSymbol) -> bool:
    """Whether a range for a field is for the map to fill in, and not for the run to draw from."""
    return is_given_by_map(field) and field.name in SEARCH_CRITERIA


def is_given_by_map(field: sym.FieldSymbol) -> bool:
    """Whether a field of an object is known only when there is a map."""
    is_part = field.owner is not None and field.owner.name in MAP_FIELDS
    return is_part and field.name not in SCENARIO_FIELDS


def reads_map(expression: ir.Expression) -> bool:
    """Whether an expression reads values of the map."""
    attributes = (part for part in ir.walk(expression) if isinstance(part, ir.Attribute))
    return any(part.is_variable and part.owner in MAP_FIELDS for part in attributes)
