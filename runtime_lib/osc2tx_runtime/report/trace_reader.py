"""Reads a trace (JSON Lines) into the object that is embedded in the page."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import field

from osc2tx_shared.classes import dataclass

from .json_values import Json, is_flat, number, plain, short, text
from .marks import mark_name
from .surroundings import Surroundings
from .tracks import Track

_Key = tuple[str, str, str]


@dataclass
class _Action:
    """One action from its start to its end (s); `end` is None while it runs."""

    actor: str
    name: str
    source: str
    start: float
    end: float | None = None
    status: str = "running"
    reason: str = ""

    def as_json(self) -> Json:
        """The data for the page."""
        return {
            "actor": self.actor,
            "name": self.name,
            "source": self.source,
            "start": short(self.start, 4),
            "end": None if self.end is None else short(self.end, 4),
            "status": self.status,
            "reason": self.reason,
        }


@dataclass
class ActionLog:
    """Collects action lines; equal actions are paired first in, first out."""

    _actions: list[_Action] = field(default_factory=list)
    _running: dict[_Key, list[_Action]] = field(default_factory=dict)

    def add(self, time: float, line: Json) -> None:
        """Take one line of kind "action" at `time` (s)."""
        actor, name, source = (
            text(line.get("actor")),
            text(line.get("name")),
            text(line.get("source")),
        )
        status = text(line.get("status"))
        waiting = self._running.setdefault((actor, name, source), [])
        if status == "start":
            waiting.append(self._begin(actor, name, source, time))
            return
        # An end without a start, in a truncated trace, is shown as an instant.
        action = waiting.pop(0) if waiting else self._begin(actor, name, source, time)
        action.end, action.status = time, status or "end"
        action.reason = text(line.get("reason"))

    def _begin(self, actor: str, name: str, source: str, time: float) -> _Action:
        action = _Action(actor, name, source, time)
        self._actions.append(action)
        return action

    def as_json(self) -> list[Json]:
        """All actions in order of their starts."""
        ordered = sorted(self._actions, key=lambda action: action.start)
        return [action.as_json() for action in ordered]


def node_list(value: object) -> list[Json]:
    """Return the nodes with their drawable data; other values are omitted."""
    nodes = value if isinstance(value, list) else []
    return [_node(each) for each in nodes if isinstance(each, dict)]


def _node(value: Json) -> Json:
    words = {key: text(value.get(key)) for key in ("kind", "text", "label", "source")}
    runs = value.get("runs")
    spans = [_span(run) for run in runs if _is_span(run)] if isinstance(runs, list) else []
    return {"depth": int(number(value.get("depth")) or 0), **words, "runs": spans}


def _is_span(run: object) -> bool:
    return isinstance(run, list) and len(run) == 3 and number(run[0]) is not None


def _span(run: list[object]) -> list[object]:
    """Start (s), end (s, None while it runs), and status at the end."""
    start, end = number(run[0]), number(run[1])
    return [short(start or 0.0, 4), None if end is None else short(end, 4), text(run[2])]


def _violation(time: float, line: Json) -> Json:
    """A condition that does not hold, as a bar; `time` replaces a missing one."""
    words = {key: text(line.get(key)) for key in ("severity", "actor", "source", "code")}
    column = number(line.get("column"))
    first, last, worst = (number(line.get(key)) for key in ("first", "last", "worst"))
    return {
        **words,
        "name": f"{text(line.get('actor'))} {text(line.get('modifier'))}",
        "place": words["source"] + ("" if column is None else f":{int(column)}"),
        "what": text(line.get("what")),
        "start": short(time if first is None else first, 4),
        "end": short(time if last is None else last, 4),
        "worst": short(time if worst is None else worst, 4),
    }


_FIXED_KINDS = ("stationary", "environment", "map", "traffic_light", "trafficlight")
_SIZES = {"length": 1.0, "width": 1.0}
_BRACKETS = 50  # brackets in a line from which its depth is checked
_HEADER_KEYS = (
    "version",
    "scenario",
    "source",
    "map",
    "dt",
    "seed",
    "parameters",
    "units",
    "one_of",
    "conduct",
    "physics",
    "fail_on",
    "world",
    "control",
)


@dataclass
class Run:
    """The content of a trace, in the order of its lines.

    Attributes:
        header: The header line, empty if there is none.
        result: The result line, None if the run did not reach it.
        tracks: Movement by actor id.
        surroundings: Lights and weather.
        nodes: The behavior tree, each node with the times at which it ran.
        violations: Conditions that do not hold, with the time from the first to the last state.
        end: Latest time in the trace (s).
        skipped: Number of lines that could not be shown.
    """

    header: Json = field(default_factory=dict)
    result: Json | None = None
    tracks: dict[str, Track] = field(default_factory=dict)
    actions: ActionLog = field(default_factory=ActionLog)
    marks: list[Json] = field(default_factory=list)
    surroundings: Surroundings = field(default_factory=Surroundings)
    nodes: list[Json] = field(default_factory=list)
    violations: list[Json] = field(default_factory=list)
    end: float = 0.0
    skipped: int = 0

    def take(self, lines: Iterable[str]) -> None:
        """Add lines of the trace; broken lines and those of unknown kind are counted."""
        for line in lines:
            if not line.strip():
                continue
            try:
                value = json.loads(line)
            except (ValueError, RecursionError):
                value = None
            is_deep = line.count("[") + line.count("{") > _BRACKETS
            if isinstance(value, dict) and (not is_deep or is_flat(value)):
                self._add(value)
            else:
                self.skipped += 1

    def _add(self, line: Json) -> None:
        kind = line.get("kind")
        if kind == "header":
            self.header = line
        elif kind == "result":
            self.result = line
        elif kind == "tree":
            self.nodes = node_list(line.get("nodes"))
        else:
            time = number(line.get("t"))
            if time is None or not self._add_timed(text(kind), time, line):
                self.skipped += 1
            else:
                self.end = max(self.end, time)

    def _add_timed(self, kind: str, time: float, line: Json) -> bool:
        if kind == "state":
            actor = text(line.get("actor"))
            track = self.tracks.get(actor, Track())
            if track.add(time, line):
                self.tracks[actor] = track
                return True
            return False
        if kind == "action":
            self.actions.add(time, line)
            return True
        if kind == "violation":
            self.violations.append(_violation(time, line))
        self.surroundings.add(kind, time, line)
        name = mark_name(kind, line)
        if name is None:
            return False
        mark: Json = {"t": short(time, 4), "kind": kind, "actor": text(line.get("actor"))}
        mark |= {"name": name, "source": text(line.get("source"))}
        if kind == "criterion":
            mark["about"] = text(line.get("name"))
        if kind == "collision":
            actors = line.get("actors")
            mark["actors"] = [text(actor) for actor in actors] if isinstance(actors, list) else []
        self.marks.append(mark)
        return True

    def as_json(self) -> Json:
        """The data for the page."""
        return {
            "header": {key: plain(self.header.get(key)) for key in _HEADER_KEYS},
            "result": plain(self.result),
            "duration": short(self.end, 4),
            "skipped": self.skipped,
            "actors": [self._actor(name, sizes) for name, sizes in self._cast().items()],
            "actions": self.actions.as_json(),
            "marks": self.marks,
            "nodes": self.nodes,
            "violations": self.violations,
        }

    def _cast(self) -> dict[str, Json]:
        """Sizes by actor id: from the header, then of other actors with states."""
        cast: dict[str, Json] = {}
        declared = self.header.get("actors")
        if isinstance(declared, dict):
            for name, sizes in declared.items():
                cast[text(name)] = sizes if isinstance(sizes, dict) else {}
        for name in self.tracks:
            cast.setdefault(name, {})
        return cast

    def _actor(self, name: str, sizes: Json) -> Json:
        kind = text(sizes.get("kind"))
        length, width = (number(sizes.get(key)) or value for key, value in _SIZES.items())
        rear = number(sizes.get("rear"))
        track = self.tracks.get(name)
        return {
            "id": name,
            "kind": kind,
            "length": short(length, 3),
            "width": short(width, 3),
            "rear": short(length / 2 if rear is None else rear, 3),
            "movable": not any(word in kind.lower() for word in _FIXED_KINDS),
            "track": track.as_json() if track is not None else None,
        }


def read_run(trace_lines: Iterable[str]) -> Run:
    """Read a trace; see `Run.take`."""
    run = Run()
    run.take(trace_lines)
    return run
