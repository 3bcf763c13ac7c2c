"""`python -m tests.carla.stand_in FOLDER... --town Town06`: serves until its input ends."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .faults import FAULTS
from .server import VERSION, StandIn, Traits

parser = argparse.ArgumentParser(prog="python -m tests.carla.stand_in")
parser.add_argument("folders", metavar="FOLDER", type=Path, nargs="+", help="with maps (.xodr)")
parser.add_argument("--town", required=True, help="the map to begin with, without .xodr")
parser.add_argument("--port", type=int, default=0, help="0, the default, takes a free one")
parser.add_argument("--version", default=VERSION, help="what it says it is")
parser.add_argument("--loading", type=float, default=0.0, help="seconds that a level takes")
parser.add_argument("--no-streams", action="store_true", help="the port of the streams is closed")
parser.add_argument("--fault", choices=sorted(FAULTS), default="", help="how it misbehaves")
options = parser.parse_args()
traits = Traits(options.version, options.loading, not options.no_streams, options.fault)
with StandIn(options.folders, options.town, traits, options.port) as server:
    print(server.port, flush=True)
    sys.stdin.read()
