"""Initial placement: the statements about the start of the run, taken out of the tree.

Only invocations that begin with the scenario can place an actor. Their `at: start` modifiers become
its placement, modifiers of the whole phase apply to the start as well, and an `assign_position`
without further content disappears. A later `at: start` stays in the tree: it applies to the start
of its phase.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import field

from osc2tx import ir
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Label, Span
from osc2tx.lowering.behavior.invoked_times import ScenarioOf
from osc2tx.lowering.behavior.time_expressions import is_range
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.placement.carla_paths import START
from osc2tx.lowering.placement.implied_starts import FirstAction, implied_starts
from osc2tx.lowering.placement.later_starts import drawn_starts
from osc2tx.lowering.values.shape_arguments import first_value, states_start
from osc2tx_shared.classes import dataclass, replace

# Of these an actor has one at the start, of any origin.
_PLACES = frozenset({"lane", "position"})

# Types of routes of a map, on which an actor can start.
ROUTES = frozenset(
    {"compound_lane", "compound_route", "crossing", "lane", "lane_section", "road", "route"}
)


@dataclass(slots=True)
class _Found:
    """The placement of one actor, being collected."""

    span: Span
    comments: list[str] = field(default_factory=list)
    modifiers: dict[str, ir.ModifierCall] = field(default_factory=dict)
    is_throughout: bool = True


class PlacementLowering:
    """Splits a tree into initial placement and the rest of the tree.

    Attributes:
        later_ranges: Drawn values that actors in motion have to meet at the start of an action.
    """

    def __init__(self, ctx: LoweringContext, scenario_of: ScenarioOf) -> None:
        """Take the place for complaints, and what gives the scenarios that are invoked."""
        self._ctx, self._scenario_of = ctx, scenario_of
        self._found: dict[str, _Found] = {}
        self._first: dict[str, FirstAction] = {}
        self._in_one_of: bool = False
        self.later_ranges: set[str] = set()

    def split(self, body: ir.Behavior) -> tuple[tuple[ir.Placement, ...], ir.Behavior | None]:
        """Return the placements in source order, and the tree without them."""
        rest = self._rewrite(body, None, is_start=True)
        placements = tuple(
            ir.Placement(
                actor=actor,
                modifiers=tuple(found.modifiers.values()),
                span=found.span,
                comments=tuple(found.comments),
                is_throughout=found.is_throughout,
            )
            for actor, found in self._found.items()
            if found.modifiers
        )
        return (*placements, *implied_starts(self._first)), rest

    def _rewrite(
        self, node: ir.Behavior, time: ir.Expression | None, *, is_start: bool
    ) -> ir.Behavior | None:
        """Rewrite a node with a time limit, its own or that of its composition."""
        match node:
            case ir.Serial():
                return self._composition(node, self._serial_members(node, time, is_start=is_start))
            case ir.Parallel() | ir.OneOf():
                time = node.duration or time
                before = self._in_one_of
                self._in_one_of = before or (is_start and isinstance(node, ir.OneOf))
                members = [self._rewrite(each, time, is_start=is_start) for each in node.members]
                self._in_one_of = before
                return self._composition(node, members)
            case ir.Invoke():
                time = node.duration or time
                return self._lift(node, time) if is_start else self._later(node, time)
            case ir.InvokeScenario() | ir.Wait() | ir.Emit() | ir.Finish() | ir.Call() | ir.On():
                return node

    def _serial_members(
        self, node: ir.Serial, time: ir.Expression | None, *, is_start: bool
    ) -> Iterator[ir.Behavior | None]:
        last = [member for member in node.members if not self._is_instant(member)]
        time = (node.duration or time) if len(last) == 1 else None
        for member in node.members:
            yield self._rewrite(member, time, is_start=is_start)
            is_start = is_start and self._is_instant(member)

    def _is_instant(self, node: ir.Behavior) -> bool:
        """Whether the successor of a member still begins at the start."""
        match node:
            case ir.Serial() | ir.Parallel():
                return all(map(self._is_instant, node.members))
            case ir.OneOf():
                return any(map(self._is_instant, node.members))
            case ir.Invoke(qualified_name=name):
                entry = catalogue().actions.get(name)
                return name in catalogue().lowered or (entry is not None and entry.is_momentary)
            case ir.InvokeScenario(duration=None, until=()):
                keys = (node.key, *(each.key for each in node.specials))
                return all(
                    isinstance(each, ir.Scenario)
                    and not each.placements
                    and self._is_instant(each.body)
                    for each in map(self._scenario_of, keys)
                )
            case ir.Emit() | ir.Finish() | ir.Call():
                return True
            case ir.InvokeScenario() | ir.Wait() | ir.On():
                return False

    def _composition(
        self, node: ir.Composition, members: Iterable[ir.Behavior | None]
    ) -> ir.Composition | None:
        left = tuple(member for member in members if member is not None)
        return replace(node, members=left) if left else None

    def _lift(self, node: ir.Invoke, time: ir.Expression | None) -> ir.Invoke | None:
        if not isinstance(node.actor, ir.FieldRef):
            return node
        actor = node.actor.name
        node = self._begin_on_path(node, actor)
        placing = [first_value(m) for m in node.modifiers if _places(m) and m.at != "end"]
        if actor not in self._found:
            placing += [*_followed_lane(node), *_followed_line(node)]
        self._imply(node, actor, time, is_later=False)
        if not placing:
            return node
        found = self._found.setdefault(actor, _Found(node.span))
        for first, second in _pairs_alike([m for m in placing if m.at == "start"]):
            report_twice(self._ctx, first, second)
        for modifier in placing:
            found.is_throughout &= modifier.at != "start"
            what = _subject(modifier)
            self._check_alternatives(found.modifiers.get(what), modifier, actor)
            if modifier.at == "start" or what not in found.modifiers:
                # A modifier of the whole phase stays in the tree as well, with its comments.
                comments = modifier.comments if modifier.at == "start" else ()
                found.modifiers[what] = replace(modifier, at="start", comments=comments)
        rest = tuple(m for m in node.modifiers if m.at != "start")
        if node.action == "assign_position" and not rest and not node.arguments:
            found.comments.extend(node.comments)
            return None
        return replace(node, modifiers=rest)

    def _imply(
        self, node: ir.Invoke, actor: str, time: ir.Expression | None, *, is_later: bool
    ) -> None:
        """Note the start that suits the first action of an actor, where nothing states one."""
        if self._is_instant(node):
            return
        limited = None if is_range(time) else time
        found = FirstAction(node, limited, is_later=is_later)
        first = self._first.setdefault(actor, found)
        if self._in_one_of and first is not found:
            self._first[actor] = replace(first, is_drawn=True)

    def _check_alternatives(
        self, first: ir.ModifierCall | None, second: ir.ModifierCall, actor: str
    ) -> None:
        """Refuse a start that differs from that of another alternative: which runs is drawn."""
        if first is None or not self._in_one_of or second.at != "start":
            return
        if not ir.means_same(first.arguments, second.arguments):
            self._ctx.unsupported(
                "OSC508",
                second.span,
                f"`{actor}` has another start in another alternative of `one_of`",
                help="let an action before the `one_of` place it",
            )

    def _later(self, node: ir.Invoke, time: ir.Expression | None) -> ir.Invoke:
        """Keep an action in the tree; only its path places its actor."""
        if isinstance(node.actor, ir.FieldRef):
            actor = node.actor.name
            node = self._begin_on_path(node, actor)
            if actor in self._first:
                self.later_ranges.update(drawn_starts(self._ctx, node))
            self._imply(node, actor, time, is_later=True)
        return node

    def _begin_on_path(self, node: ir.Invoke, actor: str) -> ir.Invoke:
        """Place an actor on the first path that it drives along; it cannot change to another."""
        for modifier in node.modifiers:
            if modifier.name != START:
                continue
            found = self._found.setdefault(actor, _Found(node.span))
            first = found.modifiers.setdefault(START, modifier)
            if _path_of(first) != _path_of(modifier):
                self._ctx.unsupported(
                    "OSC508",
                    modifier.span,
                    f"`{actor}` already follows another path",
                    help="assign one path",
                )
        return replace(node, modifiers=tuple(m for m in node.modifiers if m.name != START))


def can_place(modifier: ir.ModifierCall) -> bool:
    """Whether a modifier states a single instant, and so can place an actor."""
    entry = catalogue().modifiers.get(modifier.name)
    return entry is not None and entry.combining.starts


def owner_of(modifier: ir.ModifierCall) -> str:
    """Return the actor of which a modifier is a member; empty for modifiers of actions.

    Members constrain the whole of a scenario; members of `map` constrain its roads.
    """
    entry = catalogue().modifiers.get(modifier.name)
    return "" if entry is None else entry.owner


def _path_of(modifier: ir.ModifierCall) -> str:
    return " ".join(argument.value.span.text for argument in modifier.arguments)


def _places(modifier: ir.ModifierCall) -> bool:
    """Whether a modifier states the position or motion of an actor at an instant."""
    if modifier.name == "along":
        return any(argument.value.type.name in ROUTES for argument in modifier.arguments)
    return can_place(modifier) and states_start(modifier)


def _subject(modifier: ir.ModifierCall) -> str:
    """Return the quantity of a modifier: lateral and longitudinal speed are different ones."""
    values = (a.value for a in modifier.arguments if a.parameter == "direction")
    across = any(isinstance(v, ir.EnumValue) and v.member == "lateral" for v in values)
    return f"{modifier.name} across" if across else modifier.name


def _pairs_alike(
    modifiers: Sequence[ir.ModifierCall],
) -> Iterator[tuple[ir.ModifierCall, ir.ModifierCall]]:
    """Yield the first modifier of each topic, with each further one."""
    seen: dict[str, ir.ModifierCall] = {}
    for modifier in modifiers:
        first = seen.setdefault(_subject(modifier), modifier)
        if first is not modifier:
            yield first, modifier


def report_twice(ctx: LoweringContext, first: ir.ModifierCall, second: ir.ModifierCall) -> None:
    """Report a modifier that states the start of an actor a second time."""
    ctx.sink.report(
        "OSC508",
        second.span,
        f"`{second.name}` states the start of the actor a second time",
        labels=[Label(first.span, "stated here already")],
        help="leave one of them out",
    )


def merged(ctx: LoweringContext, placements: Sequence[ir.Placement]) -> tuple[ir.Placement, ...]:
    """Return one placement for each actor, at its first position; those of maps stay apart."""
    by_actor: dict[str, ir.Placement] = {}
    implied: list[ir.Placement] = []
    same = {field.name: each.other.name for field, each in ctx.same_actors.items()}
    for number, placement in enumerate(placements):
        while placement.actor in same:  # another name of an actor that has its own place here
            placement = replace(placement, actor=same[placement.actor])
        if placement.of_map:
            by_actor[f"{placement.actor} {number}"] = placement
            continue
        if placement.is_implied:
            implied.append(placement)
            continue
        first = by_actor.get(placement.actor)
        if first is not None:
            places = [m for m in (*first.modifiers, *placement.modifiers) if m.name in _PLACES]
            for pair in _pairs_alike(places):
                report_twice(ctx, *pair)
            placement = replace(
                first,
                modifiers=(*first.modifiers, *placement.modifiers),
                comments=(*first.comments, *placement.comments),
                is_throughout=first.is_throughout and placement.is_throughout,
            )
        by_actor[placement.actor] = placement
    left = (_beyond(each, by_actor.get(each.actor)) for each in implied)
    return (*by_actor.values(), *(each for each in left if each.modifiers))


def _beyond(implied: ir.Placement, stated: ir.Placement | None) -> ir.Placement:
    """Return the implied modifiers of a start that no stated modifier covers."""
    known = {_subject(modifier) for modifier in stated.modifiers} if stated is not None else set()
    left = (modifier for modifier in implied.modifiers if _subject(modifier) not in known)
    return replace(implied, modifiers=tuple(left))


# Arguments of `follow_lane` -> the equivalent modifier of the start, and its parameter.
_FOLLOWED = {
    "target": ("along", "route"),
    "offset": ("lateral", "distance"),
    "offset_range": ("lateral", "distance_range"),
}


def _followed_lane(node: ir.Invoke) -> Iterator[ir.ModifierCall]:
    """Yield where an actor starts that follows a lane: in it, at its offset (§8.8.3.2).

    With a profile it gets to the offset later.
    """
    if node.qualified_name != "vehicle.follow_lane":
        return
    given = {argument.parameter: argument for argument in node.arguments}
    placed = {modifier.name for modifier in node.modifiers if modifier.at != "end"}
    shaped = "rate_profile" in given or "rate_peak" in given
    for parameter, (name, same) in _FOLLOWED.items():
        argument = given.get(parameter)
        late = shaped and name == "lateral"
        if argument is None or late or name in placed or _is_zero(argument):
            continue
        said = replace(argument, parameter=same, is_positional=False)
        yield ir.ModifierCall(span=argument.span, name=name, arguments=(said,), at="start")


# Actions along a line -> the equivalent modifier, and its parameter.
_LINES = {
    "follow_path": ("along", "route"),
    "replay_path": ("along", "route"),
    "follow_trajectory": ("along_trajectory", "trajectory"),
    "replay_trajectory": ("along_trajectory", "trajectory"),
}


def _followed_line(node: ir.Invoke) -> Iterator[ir.ModifierCall]:
    """Yield the line on which an actor starts that follows it, if nothing else states its start.

    A relative one has its position only when the action starts.
    """
    if any(each.name in _PLACES and each.at != "end" for each in node.modifiers):
        return
    action = node.qualified_name.rpartition(".")[2]
    if action in _LINES:
        name, same = _LINES[action]
        given = {argument.parameter: argument for argument in node.arguments}
        if "absolute" in given:
            said = [replace(given["absolute"], parameter=same, is_positional=False)]
            said += [given["start_offset"]] if "start_offset" in given else []
            yield ir.ModifierCall(span=node.span, name=name, arguments=tuple(said), at="start")
    for each in node.modifiers:
        of_path = any(argument.value.type.name == "path" for argument in each.arguments)
        if each.name == "along_trajectory" or (each.name == "along" and of_path):
            said = [a for a in each.arguments if a.parameter != "end_offset"]
            yield replace(each, arguments=tuple(said), at="start", comments=())


def _is_zero(argument: ir.Argument) -> bool:
    return ir.constant(argument.value) == 0.0
