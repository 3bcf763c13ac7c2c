"""Pictures of the how-to: a run as another client of the server sees it, drawn by the report.

`python -m tests.carla.pictures`: poses and speeds are those of the server's snapshots; of our trace
there is the header alone. With Chromium in the path the page becomes a picture of the docs.
"""

from __future__ import annotations

import json
import math
import shutil
import subprocess
import sys
import time
from typing import Any

import carla

from osc2tx_runtime.opendrive import read_map
from osc2tx_runtime.report.page import write_report
from osc2tx_runtime.simulators.carla.frames import measurement_from
from osc2tx_shared.text import say

from .conftest import OWN_MAPS
from .runs import REPOSITORY
from .stand_in.process import StandInProcess

SCENARIO = REPOSITORY / "scenarios" / "cut_in.osc"
PICTURE = REPOSITORY / "docs" / "images" / "carla_cut_in.png"
SHOWN = 16.5
"""Seconds of the run that the picture shows: the other car cuts in."""

SIZE = (1400, 860)
Seen = dict[float, dict[str, list[float]]]


def main() -> int:
    """Play the scenario, watch it, and draw what was seen."""
    out = REPOSITORY / "out"
    out.mkdir(exist_ok=True)
    page, trace = out / "carla_cut_in.html", out / "carla_cut_in.jsonl"
    with StandInProcess([OWN_MAPS], "highway") as server:
        run = [sys.executable, "-m", "osc2tx", "run", str(SCENARIO), "--world", "carla"]
        run += ["--carla", f"127.0.0.1:{server.port}", "--trace", str(trace), "--realtime", "8"]
        watched = carla.Client("127.0.0.1", server.port)
        watched.set_timeout(20.0)
        process = subprocess.Popen(run, cwd=REPOSITORY)
        seen = watch(watched.get_world(), process)
    header, *_ = trace.read_text(encoding="utf-8").splitlines()
    steps = lines_of(json.loads(header), seen)
    write_report(page, [header, *steps], read_map(OWN_MAPS / "highway.xodr"))
    say(f"{page}: {len(seen)} steps")
    browser = shutil.which("chromium")
    if browser is not None:
        size = ",".join(map(str, SIZE))
        shot = [browser, "--headless", "--no-sandbox", f"--window-size={size}"]
        shot += [f"--screenshot={PICTURE}", f"{page.as_uri()}#t={SHOWN}"]
        subprocess.run(shot, check=True, stderr=subprocess.DEVNULL)
        say(str(PICTURE))
    return 0


def watch(world: Any, process: subprocess.Popen[bytes]) -> Seen:
    """Return the states of the vehicles by role name, by the time of the server (s)."""
    snapshots: list[Any] = []
    names: dict[int, str] = {}
    number = world.on_tick(snapshots.append)
    while process.poll() is None:
        for actor in world.get_actors().filter("vehicle.*"):
            names.setdefault(actor.id, actor.attributes["role_name"])
        time.sleep(0.01)
    world.remove_on_tick(number)
    return {
        each.timestamp.elapsed_seconds: {
            name: state_of(each.find(actor)) for actor, name in names.items() if each.find(actor)
        }
        for each in snapshots
    }


def state_of(found: Any) -> list[float]:
    """Return an actor of a snapshot as `measurement_from` takes it."""
    pose, velocity = found.get_transform(), found.get_velocity()
    at, turn = pose.location, pose.rotation
    moving = [velocity.x, velocity.y, velocity.z]
    return [at.x, at.y, at.z, turn.pitch, turn.yaw, turn.roll, *moving, *[0.0] * 6]


def lines_of(header: dict[str, Any], seen: Seen) -> list[str]:
    """Return lines of a trace; it begins when all are on the road, and ends when they are gone."""
    actors, dt = header["actors"], header["dt"]
    complete = [at for at in seen.values() if len(at) == len(actors)]
    on_road = [at for at in complete if all(state[2] < 1.0 for state in at.values())]
    places: dict[str, tuple[float, float]] = {}
    lines = []
    for step, states in enumerate(on_road):
        for name, state in states.items():
            ahead = actors[name]["rear"] - 0.5 * actors[name]["length"]
            pose = measurement_from(state, ahead).pose
            x, y = places.get(name, (pose.x, pose.y))
            places[name] = (pose.x, pose.y)
            moved = math.hypot(pose.x - x, pose.y - y) / dt  # no velocity without physics
            line = {"t": round(step * dt, 3), "kind": "state", "actor": name}
            line |= {"x": pose.x, "y": pose.y, "z": pose.z, "h": pose.h, "v": moved, "a": 0.0}
            lines.append(json.dumps(line))
    return lines


if __name__ == "__main__":
    sys.exit(main())
