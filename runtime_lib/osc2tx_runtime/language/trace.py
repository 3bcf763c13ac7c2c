"""The trace: one JSON object per line, the same bytes for the same run. See docs/trace.md."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from json.encoder import encode_basestring_ascii as quoted
from math import isfinite
from typing import TYPE_CHECKING, Any, Protocol

from osc2tx_runtime.language.node_runs import NodeRuns

if TYPE_CHECKING:
    from osc2tx_runtime.world.measuring.deviation import Deviation
    from osc2tx_runtime.world.state import ActorState

TRACE_VERSION = 1
DECIMALS = 6
"""Decimals of the numbers of states, times and deviations."""

ACTION_ORDER = {"start": 0, "end": 1, "fail": 2}


def number(value: float | None) -> str:
    """Return a number in the format of the trace: with few decimals, without minus zero."""
    if value is None:
        return "null"
    text = repr(round(value, DECIMALS) + 0.0)
    return "null" if "n" in text else text  # JSON has no nan and inf


def to_json(value: Any, *, exact: bool = False) -> str:
    """Return compact JSON; actors as their ids, values of structs by member.

    Floats have nine significant digits: unlike states, parameters, arguments and the environment
    have values of any size (2 mm/h of rain are 5.6e-7 m/s). `exact` gives all digits.
    """
    if isinstance(value, float):
        text = repr((value if exact else float(f"{value:.9g}")) + 0.0)
        return "null" if "n" in text else text
    if isinstance(value, Mapping):
        members = (f"{json.dumps(str(k))}:{to_json(v, exact=exact)}" for k, v in value.items())
        return "{" + ",".join(members) + "}"
    if isinstance(value, list | tuple):
        return "[" + ",".join(to_json(each, exact=exact) for each in value) + "]"
    if value is None or isinstance(value, str | int):
        return json.dumps(value)
    if hasattr(value, "__float__"):  # numbers of other libraries
        return to_json(float(value), exact=exact)
    if is_dataclass(value) and not hasattr(value, "id"):
        shown = (each.name for each in fields(value) if each.repr)
        return to_json({name: getattr(value, name) for name in shown}, exact=exact)
    return json.dumps(str(getattr(value, "id", value)))


OnSample = Callable[[str, Mapping[str, Any]], None]
"""Takes `cover` or `record`, and the fields of the value in the trace."""

TakeLines = Callable[[Sequence[str]], object]
"""Takes the next lines of a trace, without line ends."""

OnStates = Callable[[float, Iterable[tuple[str, "ActorState"]]], object]
"""Takes the time (s) of an instant, and the states of the placed actors."""


class TracedAction(Protocol):
    """The fields of an action in the trace."""

    action_name: str
    source: str
    position: int

    @property
    def actor_id(self) -> str | None:
        """The actor, if there is one."""
        ...


class TraceWriter:
    """Makes the lines of a run.

    The lines of one instant are kept until `end_instant` and written in a fixed order, independent
    of the order in which the tree visits parallel members.

    Args:
        *takers: Called with the lines of each instant; the writer does not keep them.
        on_sample: Called with the value of each coverage item, also without takers.
        on_states: Called with the states of each instant, instead of lines.

    Attributes:
        enabled: Whether the lines are taken.
    """

    def __init__(
        self,
        *takers: TakeLines,
        on_sample: OnSample | None = None,
        on_states: OnStates | None = None,
    ) -> None:
        self.enabled = bool(takers)
        self._takers = takers
        self._on_sample = on_sample
        self._on_states = on_states
        self._events: set[tuple[str, str]] = set()
        self._actions: list[tuple[tuple[int, str], int, str]] = []
        self._others: dict[tuple[int, str, str], str] = {}
        self._environment: dict[str, Any] = {}
        self._values: dict[str, Any] = {}  # of sampled variables
        self._written: dict[str, tuple[ActorState, str]] = {}
        self._runs = NodeRuns()

    # --- lines of the present instant ---

    def event(self, name: str, arguments: Mapping[str, Any] | None = None) -> None:
        """Note an occurrence; equal ones of one instant count once."""
        if self.enabled:
            values = {key: arguments[key] for key in sorted(arguments)} if arguments else {}
            self._events.add((name, f',"arguments":{to_json(values)}' if values else ""))

    def action(
        self,
        status: str,
        action: TracedAction,
        reason: str | None = None,
        deviation: Deviation | None = None,
    ) -> None:
        """Note that an action starts, ends or fails.

        Args:
            status: `start`, `end` or `fail`.
            action: The action.
            reason: The reason, unless obvious.
            deviation: Deviation of a driven actor from its command.
        """
        if not self.enabled:
            return
        text = f'"kind":"action","status":"{status}","name":{json.dumps(action.action_name)}'
        if action.actor_id is not None:
            text += f',"actor":{json.dumps(action.actor_id)}'
        text += f',"source":{json.dumps(action.source)}'
        if reason is not None:
            text += f',"reason":{json.dumps(reason)}'
        if deviation is not None:
            numbers = (f'"{name}":{number(value)}' for name, value in deviation._asdict().items())
            text += f',"deviation":{{{",".join(numbers)}}}'
        key = action.position, action.action_name
        self._actions.append((key, ACTION_ORDER[status], text))

    def lights(self, actor_id: str, mode: str) -> None:
        """Note the new light mode of a vehicle."""
        self.other(0, "lights", actor=actor_id, mode=mode)

    def environment(self, **values: Any) -> None:
        """Note new values of the environment, SI units; values of one instant share a line."""
        self._environment.update(values)

    def signal(
        self, signal_id: str, state: str, bulbs: Iterable[str], ignored: str | None = None
    ) -> None:
        """Note the meaning and lamps of a traffic light, and requested meanings it cannot show."""
        more = {} if ignored is None else {"ignored": ignored}
        self.other(2, "signal", signal=signal_id, state=state, bulbs=list(bulbs), **more)

    def collision(self, actor_ids: Iterable[str]) -> None:
        """Note a new contact of two actors."""
        self.other(3, "collision", actors=sorted(actor_ids))

    def choice(self, name: str, policy: str, chosen: str, source: str) -> None:
        """Note which member of a `one_of` was chosen, or won the race."""
        if self.enabled:
            self._listed(4, "choice", {"name": name, "policy": policy, "chosen": chosen}, source)

    def override(self, name: str, what: str, by: str, source: str) -> None:
        """Note that a behavior was ended or skipped because of another."""
        if self.enabled:
            self._listed(5, "override", {"name": name, "what": what, "by": by}, source)

    def variable(self, name: str, value: Any) -> None:
        """Note the first value of a sampled variable, and each new one.

        The last value of an instant counts.
        """
        if name not in self._values or self._values[name] != value:
            self._values[name] = value
            self.other(6, "variable", name=name, value=value)

    def sampled(self, kind: str, values: Mapping[str, Any]) -> None:
        """Note the value of a coverage item, kind `cover` or `record`."""
        if self._on_sample is not None:
            self._on_sample(kind, values)
        if self.enabled:
            self._listed(7, kind, values)

    def criterion(self, name: str, what: str) -> None:
        """Note a violation of a criterion of `--fail-on`."""
        if self.enabled:
            self._listed(9, "criterion", {"name": name, "what": what})

    def violation(self, values: Mapping[str, Any], source: str) -> None:
        """Note a condition of a phase that does not hold; the phase ends at this instant."""
        if self.enabled:
            self._listed(10, "violation", values, source)

    def _listed(
        self, rank: int, kind: str, values: Mapping[str, Any], source: str | None = None
    ) -> None:
        """Keep a line of a kind that may occur several times per instant."""
        text = to_json(values)[1:-1]
        place = "" if source is None else f',"source":{json.dumps(source)}'
        self._others[rank, kind, text] = f'"kind":{json.dumps(kind)},{text}{place}'

    def other(self, rank: int, kind: str, **values: Any) -> None:
        """Note a line of another kind, with its first value as the key.

        The last line of a key counts. Call it in a fixed order: from effects, or after a step.

        Args:
            rank: Order of the kinds within an instant.
            kind: Kind of the line.
            **values: Its fields.
        """
        if self.enabled:
            subject = to_json(next(iter(values.values()), None))
            text = f'"kind":{json.dumps(kind)},{to_json(values)[1:-1]}'
            self._others[rank, kind, subject] = text

    def node_starts(self, node: object, time: float) -> None:
        """Note that a node of the tree starts, at `time` (s)."""
        if self.enabled:
            self._runs.starts(node, time)

    def node_ends(self, node: object, time: float, status: str) -> None:
        """Note that a node is left at `time` (s), with a status of py_trees."""
        if self.enabled:
            self._runs.ends(node, time, status)

    # --- the file ---

    def header(self, values: Mapping[str, Any]) -> None:
        """Write the first line; parameters with all digits, so that they can be reproduced."""
        if self.enabled:
            head = {"kind": "header", "version": TRACE_VERSION, **values}
            members = (
                f"{json.dumps(name)}:{to_json(value, exact=name == 'parameters')}"
                for name, value in head.items()
            )
            self._hand_over(["{" + ",".join(members) + "}"])

    def end_instant(self, time: float, states: Iterable[tuple[str, ActorState]] = ()) -> None:
        """Write the lines of one instant: states, events, actions, then the other kinds."""
        if not self.enabled:
            return
        if self._on_states is not None:
            self._on_states(time, states)
            states = ()
            if not (self._events or self._actions or self._environment or self._others):
                return
        t = f'{{"t":{number(time)},'
        lines: list[str] = []
        written = self._written
        for actor_id, state in states:
            before = written.get(actor_id)
            if before is None or before[0] != state:  # an actor at standstill is written once
                text = f'"kind":"state","actor":{quoted(actor_id)},{state_json(state)}}}'
                before = written[actor_id] = (state, text)
            lines.append(t + before[1])
        for name, arguments in sorted(self._events):
            lines.append(f'{t}"kind":"event","name":{json.dumps(name)}{arguments}}}')
        lines.extend(f"{t}{text}}}" for _, _, text in sorted(self._actions))
        if self._environment:
            values = {key: self._environment[key] for key in sorted(self._environment)}
            self._others[1, "environment", ""] = f'"kind":"environment",{to_json(values)[1:-1]}'
        lines.extend(f"{t}{text}}}" for _, text in sorted(self._others.items()))
        self._environment.clear()
        self._events.clear()
        self._actions.clear()
        self._others.clear()
        self._hand_over(lines)

    def tree(self, nodes: Iterable[tuple[object, Mapping[str, int | str]]]) -> None:
        """Write when each node of the tree ran, see `NodeRuns`; after the last instant."""
        if self.enabled:
            self._hand_over([f'{{"kind":"tree","nodes":{self._runs.to_json(nodes)}}}'])

    def result(self, status: str, reason: str, steps: int, warnings: Sequence[str] = ()) -> None:
        """Write the last line."""
        if self.enabled:
            values = {"kind": "result", "status": status, "reason": reason, "steps": steps}
            said = {"warnings": list(warnings)} if warnings else {}
            self._hand_over([to_json({**values, **said})])

    def _hand_over(self, lines: Sequence[str]) -> None:
        for take in self._takers:
            take(lines)


def state_json(state: ActorState) -> str:
    """Return the state of an actor as the members of a JSON object.

    Most lines of a trace are states, so for speed the numbers are not formatted by `number`, and
    `DECIMALS` is repeated as a literal.
    """
    x, y, z, h, v, a, place = state[:7]
    if place is None:
        road, lane, s, offset = "null", "null", None, None
    else:
        road, lane, s, offset = quoted(place.road), str(place.lane), place.s, place.offset
    if s is None or offset is None or not isfinite(x + y + z + h + v + a + s + offset):
        return (
            f'"x":{number(x)},"y":{number(y)},"z":{number(z)},"h":{number(h)},"v":{number(v)},'
            f'"a":{number(a)},"road":{road},"lane":{lane},"s":{number(s)},"offset":{number(offset)}'
            + _tilt_json(state)
        )
    return (
        f'"x":{round(x, 6) + 0.0!r},"y":{round(y, 6) + 0.0!r},"z":{round(z, 6) + 0.0!r},'
        f'"h":{round(h, 6) + 0.0!r},"v":{round(v, 6) + 0.0!r},"a":{round(a, 6) + 0.0!r},'
        f'"road":{road},"lane":{lane},"s":{round(s, 6) + 0.0!r},"offset":{round(offset, 6) + 0.0!r}'
        + _tilt_json(state)
    )


def _tilt_json(state: ActorState) -> str:
    """Return pitch and roll, of actors that are not level."""
    if not (state.pitch or state.roll):
        return ""
    return f',"pitch":{number(state.pitch)},"roll":{number(state.roll)}'
