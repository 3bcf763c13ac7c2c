"""OpenDRIVE road maps: read an .xodr file, then query lanes, positions and distances.

Input is a file; output is an immutable `RoadMap` with all queries. Start reading at `road_map`. In
order of control flow:

* `xml_reader`, `reader`, `lane_reader`, `signal_reader`, `crosswalks`: text to roads, checked, or a
    `MapError`; `unread`: unread elements; `seams`: lanes with a gap or kink to their successor;
    `map_snapshots`, `packed_map`: large maps are parsed once.
  * `polynomials`, `geometry`, `model`: the parts of a road.
* `lane_table`: lanes by id; `network`: their connections; `lane_line`: `arc_length` along one.
* `lane_advance`: moving along lanes, `lane_cursor`: the same step by step; `lane_distances`:
  distances over the lane graph.
* `poses`: from a lane to (x, y, z); `road_index`, `projection`: back to a lane.
* `geodesy`: from the globe to the map; `outlines`: drawing and default start positions;
  `signal_places`: positions of signals; `signals`, `errors`: value types.

Invariants: SI units, right-handed coordinates, headings in (-pi, pi]. Results do not depend on
set order, platform hash seeds or the order of queries. Distances are measured on the xy plane.
"""

from __future__ import annotations

from .crosswalks import Crosswalk
from .errors import MapError
from .geodesy import GeoReference, GeoReferenceError, TransverseMercator
from .lane_cursor import LaneCursor, Stretch
from .lane_distances import Route
from .model import (
    DRIVING,
    Advance,
    Junction,
    JunctionConnection,
    Lane,
    LaneKey,
    LaneOutline,
    LanePosition,
    LaneSection,
    Pose,
    Road,
)
from .road_map import RoadMap, read_map, read_map_text
from .seams import Seam
from .signal_places import SignalPlace, signal_places
from .signals import Controller, Signal, SignalReference
from .unread import unread_elements

__all__ = [
    "DRIVING",
    "Advance",
    "Controller",
    "Crosswalk",
    "GeoReference",
    "GeoReferenceError",
    "Junction",
    "JunctionConnection",
    "Lane",
    "LaneCursor",
    "LaneKey",
    "LaneOutline",
    "LanePosition",
    "LaneSection",
    "MapError",
    "Pose",
    "Road",
    "RoadMap",
    "Route",
    "Seam",
    "Signal",
    "SignalPlace",
    "SignalReference",
    "Stretch",
    "TransverseMercator",
    "read_map",
    "read_map_text",
    "signal_places",
    "unread_elements",
]
