"""Pictures of the how-to: runs as another client of the server sees them, drawn by the report.

`python -m tests.carla.pictures`: poses and speeds are those of the server's snapshots; of our trace
there are the header and the verdict alone. With Chromium in the path the pages become pictures.
"""

from __future__ import annotations

import json
import math
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import carla

from osc2tx_runtime.opendrive import read_map
from osc2tx_runtime.report.page import render_report
from osc2tx_runtime.simulators.carla.frames import measurement_from
from osc2tx_shared.text import say

from .conftest import OWN_MAPS
from .runs import REPOSITORY
from .stand_in.process import StandInProcess

SCENARIO = REPOSITORY / "scenarios" / "cut_in.osc"
PAGE = REPOSITORY / "docs" / "how-to" / "carla.md"
PORT = "2000"
WIDTH = 1400
Seen = dict[float, dict[str, list[float]]]


class Picture(NamedTuple):
    """A picture.

    Attributes:
        name: Of its file.
        options: Of the run.
        shown: Time (s) of the run.
        height: Of the picture: what is below the view from above is left out.
        has_stack: The stack of the page controls the ego.
    """

    name: str
    options: tuple[str, ...]
    shown: float
    height: int
    has_stack: bool = False


UNDER_TEST = ("--control", "ego=external", "--wait-control", "30s", "--expect")
PICTURES = (
    Picture("carla_cut_in", (), 14.5, 698),
    Picture("carla_under_test", UNDER_TEST, 14.5, 742, has_stack=True),
)


def main() -> int:
    """Make the pictures."""
    for picture in PICTURES:
        page = draw(picture)
        say(str(page))
        browser = shutil.which("chromium")
        if browser is not None:
            file = REPOSITORY / "docs" / "images" / f"{picture.name}.png"
            shot = [browser, "--headless", "--no-sandbox", "--hide-scrollbars"]
            shot += [f"--window-size={WIDTH},{picture.height}", f"--screenshot={file}"]
            command = [*shot, f"{page.as_uri()}#t={picture.shown}"]
            subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
            say(str(file))
    return 0


def draw(picture: Picture) -> Path:
    """Play the scenario, watch it, and write the page of what was seen."""
    out = REPOSITORY / "out"
    out.mkdir(exist_ok=True)
    page, trace = out / f"{picture.name}.html", out / f"{picture.name}.jsonl"
    with StandInProcess([OWN_MAPS], "highway") as server, stack(server, picture.has_stack):
        run = [sys.executable, "-m", "osc2tx", "run", str(SCENARIO), "--world", "carla"]
        run += ["--carla", f"127.0.0.1:{server.port}", "--trace", str(trace), "--realtime", "8"]
        watched = carla.Client("127.0.0.1", server.port)
        watched.set_timeout(20.0)
        process = subprocess.Popen([*run, *picture.options], cwd=REPOSITORY)
        seen = watch(watched.get_world(), process)
    header, *_, verdict = trace.read_text(encoding="utf-8").splitlines()
    states = lines_of(json.loads(header), seen, json.loads(verdict)["steps"])
    text = render_report([header, *states, verdict], read_map(OWN_MAPS / "highway.xodr"))
    page.write_text(text, encoding="utf-8", newline="\n")
    return page


@contextmanager
def stack(server: StandInProcess, wanted: bool) -> Iterator[None]:
    """Run the stack of the page."""
    if not wanted:
        yield
        return
    process = subprocess.Popen([sys.executable, "-c", stack_for(server.port)])
    yield
    process.kill()
    process.wait()


def stack_for(port: int) -> str:
    """Return the text of the page's stack, for a port."""
    text = PAGE.read_text(encoding="utf-8").partition("```python\n")[2].partition("```")[0]
    return text.replace(PORT, str(port))


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


def lines_of(header: dict[str, Any], seen: Seen, steps: int) -> list[str]:
    """Return lines of a trace for the last steps in which all actors are there."""
    actors, dt = header["actors"], header["dt"]
    complete = [at for at in seen.values() if len(at) == len(actors)]
    places: dict[str, tuple[float, float]] = {}
    lines = []
    for step, states in enumerate(complete[-steps - 1 :]):
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
