"""Made-up traces and roads for the report."""

import json
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import pytest

Json = dict[str, object]
Motion = Callable[[float], tuple[float, float, float, float, float]]
"""Time (s) to x, y, heading, speed, acceleration."""
Point = tuple[float, float]


@dataclass(frozen=True)
class Outline:
    """Stands for opendrive.LaneOutline."""

    road: str
    lane: int
    type: str
    left: list[Point]
    right: list[Point]
    junction: str | None = None


@dataclass(frozen=True)
class Post:
    """Stands for opendrive.Signal."""

    id: str
    road: str
    s: float
    t: float


@dataclass(frozen=True)
class Place:
    """Stands for opendrive.Pose."""

    x: float
    y: float


@dataclass(frozen=True)
class Zebra:
    """Stands for opendrive.Crosswalk."""

    x: float
    y: float
    heading: float = 0.0
    length: float = 7.0
    width: float = 3.0


@dataclass
class FakeMap:
    """One road along a centre line: lanes by id with type and width, ordered from the middle."""

    centre: Callable[[float], tuple[float, float, float]]
    length: float
    lanes: dict[int, tuple[str, float]]
    posts: tuple[Post, ...] = ()
    zebras: tuple[Zebra, ...] = ()

    def crosswalks(self) -> tuple[Zebra, ...]:
        return self.zebras

    def travel_direction(self, road: str, lane: int) -> int:
        return -1 if lane > 0 else 1

    def lane_outlines(
        self, bounds: tuple[float, float, float, float] | None = None, step: float = 4.0
    ) -> Iterator[Outline]:
        edges = {1: 0.0, -1: 0.0}
        for lane, (kind, width) in self.lanes.items():
            side = 1 if lane > 0 else -1
            inner, outer = edges[side], edges[side] + side * width
            edges[side] = outer
            left, right = (outer, inner) if side > 0 else (inner, outer)
            yield Outline("16", lane, kind, self._edge(left, step), self._edge(right, step))

    def signals(self) -> tuple[Post, ...]:
        return self.posts

    def road_pose(self, road: str, s: float, t: float) -> Place:
        x, y, h = self.centre(s)
        return Place(x - t * math.sin(h), y + t * math.cos(h))

    def _edge(self, t: float, step: float) -> list[Point]:
        count = math.ceil(self.length / step)
        stations = [self.centre(self.length * i / count) for i in range(count + 1)]
        return [(x - t * math.sin(h), y + t * math.cos(h)) for x, y, h in stations]


@dataclass
class TraceMaker:
    """Collects the lines of a trace."""

    scenario: str = "overtake"
    dt: float = 0.05
    actors: dict[str, Json] = field(default_factory=dict)
    motions: dict[str, Motion] = field(default_factory=dict)
    lines: list[tuple[float, Json]] = field(default_factory=list)
    nodes: list[Json] = field(default_factory=list)

    def node(
        self,
        depth: int,
        kind: str,
        text: str,
        *runs: tuple[float, float | None, str],
        **more: str,
    ) -> None:
        source = f"{self.scenario}.osc:1"
        words = {"depth": depth, "kind": kind, "text": text, "source": source}
        self.nodes.append({**words, **more, "runs": list(runs)})

    def car(self, name: str, motion: Motion, length: float = 4.7, width: float = 1.9) -> None:
        self.actors[name] = {
            "kind": "vehicle",
            "length": length,
            "width": width,
            "height": 1.5,
            "rear": 0.2 * length,
        }
        self.motions[name] = motion

    def obstacle(self, name: str, x: float, y: float, h: float = 0.0) -> None:
        self.actors[name] = {
            "kind": "stationary_object",
            "length": 1.2,
            "width": 2.2,
            "height": 1.5,
            "rear": 0.6,
        }
        self.motions[name] = lambda _t: (x, y, h, 0.0, 0.0)

    def note(self, t: float, kind: str, **values: object) -> None:
        self.lines.append((t, {"t": t, "kind": kind, **values}))

    def action(
        self,
        actor: str,
        method: str,
        start: float,
        end: float | None,
        line: int = 1,
        status: str = "end",
        **more: object,
    ) -> None:
        values: Json = {
            "name": f"{actor} {method}",
            "actor": actor,
            "source": f"{self.scenario}.osc:{line}",
        }
        self.note(start, "action", status="start", **values)
        if end is not None:
            self.note(end, "action", status=status, **values, **more)

    def text(self, steps: int, status: str | None = "success", reason: str = "") -> list[str]:
        header: Json = {
            "kind": "header",
            "version": 1,
            "scenario": self.scenario,
            "source": f"{self.scenario}.osc",
            "map": "Town06",
            "dt": self.dt,
            "seed": 0,
            "parameters": {"v_hero": 9.722222},
            "actors": self.actors,
        }
        lines = self.lines + [
            (round(k * self.dt, 6), self._state(round(k * self.dt, 6), name))
            for k in range(steps + 1)
            for name in self.motions
        ]
        ordered = [line for _, line in sorted(lines, key=lambda entry: entry[0])]
        tree = {"kind": "tree", "nodes": self.nodes}
        result = {"kind": "result", "status": status, "reason": reason, "steps": steps}
        return [
            json.dumps(line) for line in [header, *ordered, tree, *([result] if status else [])]
        ]

    def _state(self, t: float, name: str) -> Json:
        x, y, h, v, a = (round(value, 6) for value in self.motions[name](t))
        place: Json = {"road": "16", "lane": -3 if y < -7 else -2, "s": x, "offset": 0.0}
        return {
            "t": t,
            "kind": "state",
            "actor": name,
            "x": x,
            "y": y,
            "z": 0.0,
            "h": h,
            "v": v,
            "a": a,
            **place,
        }


def ease(u: float) -> float:
    """Smooth step from 0 to 1."""
    u = min(max(u, 0.0), 1.0)
    return u * u * u * (10 - 15 * u + 6 * u * u)


def wandering(number: int) -> Motion:
    """A car that moves neither steadily nor straight."""

    def motion(t: float) -> tuple[float, float, float, float, float]:
        v = 20 + 5 * math.sin(t / 7 + number) + math.sin(3.1 * t + number)
        x = 20 * t - 35 * math.cos(t / 7 + number) - math.cos(3.1 * t + number) / 3.1
        a = 5 / 7 * math.cos(t / 7 + number) + 3.1 * math.cos(3.1 * t + number)
        return x, 0.2 * math.sin(t / 3 + number), 0.01 * math.sin(t + number), v, a

    return motion


def highway() -> FakeMap:
    lanes = {
        1: ("driving", 3.5),
        2: ("driving", 3.5),
        3: ("shoulder", 2.5),
        -1: ("driving", 3.5),
        -2: ("driving", 3.5),
        -3: ("driving", 3.5),
        -4: ("driving", 3.5),
        -5: ("shoulder", 2.5),
    }
    return FakeMap(lambda s: (s, 0.0, 0.0), 4000.0, lanes)


def make_overtaking() -> TraceMaker:
    """Two cars on a highway, an obstacle, a lane change, events, lights, a failing action."""
    maker = TraceMaker()

    def hero(t: float) -> tuple[float, float, float, float, float]:
        x = 20 + (1.5 * t * t if t < 8 else 96 + 24 * (t - 8))
        v, a = (3 * t, 3.0) if t < 8 else (24.0, 0.0)
        y = -8.75 + 3.5 * ease((t - 9) / 4) - 3.5 * ease((t - 17) / 4)
        return x, y, 0.0, v, a

    def npc(t: float) -> tuple[float, float, float, float, float]:
        slow = max(0.0, t - 20)
        v = max(18 - 3 * slow, 0.0)
        stop = min(slow, 6.0)
        return (
            60 + 18 * min(t, 20) + 18 * stop - 1.5 * stop * stop,
            -8.75,
            0.0,
            v,
            -3.0 * (0 < slow < 6),
        )

    maker.car("hero", hero)
    maker.car("npc", npc, 12.0, 2.5)
    maker.obstacle("obstacle", 500.0, -12.25)
    maker.action("hero", "drive", 0.0, 9.0, 57)
    maker.action("hero", "change_lane", 9.0, 13.0, 61)
    maker.action("hero", "set_lights", 9.0, 9.0, 64)
    maker.action("hero", "set_lights", 9.5, 9.5, 66)
    maker.action("hero", "change_lane", 17.0, 21.0, 70)
    maker.action("hero", "change_speed", 21.0, None, 71)
    maker.action("npc", "drive", 0.0, 20.0, 80)
    maker.action("npc", "change_speed", 20.0, 26.0, 82)
    maker.action("npc", "keep_space_gap", 26.0, 27.5, 83, "fail", reason="leader lost")
    maker.node(0, "serial", "overtake", (0.0, 27.5, "failure"))
    maker.node(1, "wait", "rise(hero.speed > 20)", (9.5, 13.0, "success"))
    maker.note(0.0, "environment", azimuth=4.71, elevation=0.2)
    maker.note(0.05, "event", name="go_signal")
    maker.note(9.0, "lights", actor="hero", mode="high_beam")
    maker.note(9.5, "lights", actor="hero", mode="auto")
    maker.note(12.9, "event", name="OBSTACLE_DETECTED")
    maker.note(13.0, "event", name="CRASH_AVOIDED")
    maker.note(13.0, "event", name="hero_passed_the_lorry")
    return maker


@pytest.fixture
def overtaking() -> list[str]:
    return make_overtaking().text(
        550, "failure", "npc keep_space_gap: leader lost (overtake.osc:83)"
    )


@pytest.fixture
def highway_map() -> FakeMap:
    return highway()


HOSTILE = "</script><img src=x onerror=\"document.documentElement.dataset.error='broken'\">\u2028&'"


@pytest.fixture
def hostile() -> Sequence[str]:
    maker = TraceMaker(HOSTILE)
    maker.car(HOSTILE, lambda t: (10 * t, -8.75, 0.0, 10.0, 0.0))
    maker.car("__proto__", lambda t: (10 * t + 20, -5.25, 0.0, 10.0, 0.0))
    maker.action(HOSTILE, "drive", 0.0, 3.0)
    maker.note(1.0, "event", name=HOSTILE)
    maker.note(2.0, "lights", actor=HOSTILE, mode=HOSTILE)
    maker.note(3.0, "collision", actors=[HOSTILE, "__proto__"])
    return maker.text(100, HOSTILE, HOSTILE)
