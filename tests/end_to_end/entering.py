"""Runs of scenarios in which actors enter, and what tests ask of them."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

from tests.unit.cli.shell import Shell

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "{map}.xodr")
{cast}
    event go
    event done
"""
CAST = {"lead": "vehicle", "npc": "vehicle", "third": "vehicle", "ped": "person"}
LEAD = """lead.drive({how}) with:
                position({at}, at: start)
                lane({lane})
                speed({speed})"""


class Run:
    """A run, with its trace."""

    def __init__(self, shell: Shell, body: str, *options: str, map_file: str = "highway") -> None:
        cast = "\n".join(f"    {who}: {kind}" for who, kind in CAST.items() if f"{who}." in body)
        path = shell.write("top.osc", HEAD.format(map=map_file, cast=cast) + body)
        self.ended = shell("run", "--trace", "trace.jsonl", *options, path)
        self.lines: list[dict[str, Any]] = []
        if self.ended.code in (0, 5) and Path("trace.jsonl").exists():
            text = Path("trace.jsonl").read_text(encoding="utf-8")
            self.lines = [json.loads(line) for line in text.splitlines()]

    def states(self, actor: str) -> list[dict[str, Any]]:
        return [x for x in self.lines if x["kind"] == "state" and x["actor"] == actor]

    def at(self, actor: str, time: float) -> dict[str, Any]:
        return next(x for x in self.states(actor) if abs(x["t"] - time) < 1e-6)

    def entering(self) -> dict[str, tuple[float, float]]:
        """Return from when to when actors are on their way in."""
        times: dict[str, list[float]] = {}
        for line in self.lines:
            if line["kind"] == "action" and line["name"].endswith(" enter"):
                times.setdefault(line["actor"], []).append(line["t"])
        return {actor: (begin, end) for actor, (begin, end) in times.items()}

    def moves_steadily(self, actor: str, most: float = 8.0) -> bool:
        """Return whether an actor never jumps: each step fits its speeds."""
        states = self.states(actor)
        for one, two in itertools.pairwise(states):
            way = math.dist((one["x"], one["y"]), (two["x"], two["y"]))
            mean = 0.5 * abs(one["v"] + two["v"]) * 0.05
            if abs(way - mean) > 0.02 or abs(two["v"] - one["v"]) > most * 0.05 + 1e-6:
                return False
        return True

    def collides(self) -> bool:
        return any(line["kind"] == "collision" for line in self.lines)


FIRST = LEAD.format(how="duration: 5s", at="50m", lane="2", speed="15mps")
