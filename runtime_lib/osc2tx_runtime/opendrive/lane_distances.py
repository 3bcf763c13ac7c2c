"""Route search: distances over the lane graph.

Adjacent lanes of the same direction form a group; moving within a group costs no length
(OpenSCENARIO DSL 8.7.6.1). A distance is measured along the lane of the rear position, with lane
changes only where that lane does not lead on; so the distance after a motion of 30 m in a lane is
30 m, even if an inner lane is shorter.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterable

from .lane_line import lane_length, lane_line
from .model import DRIVING, Lane, LanePosition, LaneSection, Road
from .network import lane_order

_NARROW = 0.5  # m: a narrower lane does not separate others


def passable(lane: Lane, s: float) -> bool:
    """Whether vehicles change lanes across this lane although they do not drive on it."""
    return lane.type == "biking" or lane.width is None or lane.width.value(s) < _NARROW


def _sides(section: LaneSection) -> tuple[tuple[Lane, ...], ...]:
    """Lanes in the order of lane changes; over the middle if there is no lane."""
    inner = (*section.right[:1], *section.left[:1])
    if section.road.reversed and len({lane.direction for lane in inner}) < len(inner):
        return ((*reversed(section.left), *section.right),)
    return section.right, section.left


class RouteField:
    """Remaining distance from the end of each group to the start of a goal group.

    Attributes:
        goal: The goal group.
        gap: Metres from the end of a group to the start of the goal, for the connected groups
            searched so far.
        following: Next group on the route, for the same groups.
        open: Queue of the search: distance (m), group, and the group after it.
    """

    __slots__ = ("following", "gap", "goal", "open")

    def __init__(self, goal: int) -> None:
        self.goal = goal
        self.gap: dict[int, float] = {}
        self.following: dict[int, int] = {}
        self.open: list[tuple[float, int, int]] = []


class LaneGroups:
    """Groups of all lanes of a map, with cached distance fields."""

    def __init__(self, roads: Iterable[Road]) -> None:
        self.groups: list[tuple[Lane, ...]] = []
        for road in roads:
            for section in road.sections:
                self._add_section(section)
        self._leading: list[tuple[int, ...] | None] = [None] * len(self.groups)
        self._lengths: list[float] = [-1.0] * len(self.groups)
        self._fields: dict[int, RouteField] = {}
        self._gaps: dict[tuple[Lane, Lane], tuple[float, Lane] | None] = {}

    def _add_section(self, section: LaneSection) -> None:
        middle = 0.5 * (section.begin + section.end)
        for side in _sides(section):
            group: list[Lane] = []
            for lane in side:
                if group and group[0].direction != lane.direction:
                    self._close(group)
                    group = []
                if lane.type in DRIVING:
                    group.append(lane)
                    continue
                self._close([lane])
                if group and not passable(lane, middle):
                    self._close(group)
                    group = []
            if group:
                self._close(group)

    def _close(self, group: list[Lane]) -> None:
        for lane in group:
            lane.group = len(self.groups)
        self.groups.append(tuple(group))

    def leading(self, group: int) -> tuple[int, ...]:
        """Groups that lead to a group, sorted."""
        found = self._leading[group]
        if found is None:
            lanes = self.groups[group]
            unordered = {before.group for lane in lanes for before in lane.predecessors}
            found = self._leading[group] = tuple(sorted(unordered))
        return found

    def field(self, goal: int) -> RouteField:
        """The field of a goal group, cached; `gap_from` searches it as far as required."""
        field = self._fields.get(goal)
        if field is None:
            field = self._fields[goal] = RouteField(goal)
            field.open = [(0.0, before, goal) for before in self.leading(goal)]
        return field

    def gap_from(self, group: int, field: RouteField) -> float:
        """Metres from the end of a group to the start of the goal; infinite if not connected.

        Backward Dijkstra from the goal, over all groups up to this distance.
        """
        gap, following, heap = field.gap, field.following, field.open
        while heap and heap[0][0] <= gap.get(group, math.inf):
            distance, nearest, target = heapq.heappop(heap)
            if nearest in gap:  # distances leave the heap in order
                continue
            gap[nearest], following[nearest] = distance, target
            onward = distance + self.length(nearest)
            for before in self.leading(nearest):
                if before not in gap:
                    heapq.heappush(heap, (onward, before, nearest))
        return gap.get(group, math.inf)

    def length(self, group: int) -> float:
        """Length (m) of the middle lane of a group, to compare routes."""
        length = self._lengths[group]
        if length < 0.0:
            lanes = self.groups[group]
            length = self._lengths[group] = lane_length(lanes[len(lanes) // 2])
        return length

    def gap(self, lane: Lane, goal: Lane) -> tuple[float, Lane] | None:
        """Metres from the end of a lane to the group of another, and the lane of arrival."""
        key = (lane, goal)
        if key not in self._gaps:
            self._gaps[key] = self._walk(lane, goal)
        return self._gaps[key]

    def _walk(self, lane: Lane, goal: Lane) -> tuple[float, Lane] | None:
        field = self.field(goal.group)
        following = field.following
        if self.gap_from(lane.group, field) == math.inf:
            return None
        total = 0.0
        while True:
            target = following[lane.group]
            lane = self._step(lane, target, goal, following)
            if lane.group == goal.group:
                return total, lane
            group = self.groups[lane.group]
            is_middle = group[len(group) // 2] is lane  # its length is known from the search
            total += self.length(lane.group) if is_middle else lane_length(lane)

    def _step(self, lane: Lane, target: int, goal: Lane, following: dict[int, int]) -> Lane:
        """Next lane of the path: that with the fewest lane changes.

        In a junction each lane often has a separate connecting road. Those that end in the same
        group count as parallel: a car in the outer lane of a bend remains there.
        """
        lanes = self.groups[lane.group]
        if len(lanes) == 1 and len(lane.successors) == 1:
            return lane.successors[0]
        then = following[target] if target != goal.group else -1
        here = lanes.index(lane)
        candidates = [
            (
                abs(i - here) + self._changes(onward, goal),
                abs(i - here),
                onward.group != target,
                lane_order(onward),
                onward,
            )
            for i, beside in enumerate(lanes)
            for onward in beside.successors
            if onward.group == target or (then >= 0 and following.get(onward.group) == then)
        ]
        return min(candidates, key=lambda candidate: candidate[:4])[4]

    def _changes(self, lane: Lane, goal: Lane) -> int:
        """Remaining lane changes from a lane in, or directly before, the group of the goal."""
        group = self.groups[goal.group]
        arrivals = [lane] if lane.group == goal.group else lane.successors
        found = [o for o in arrivals if o.group == goal.group]
        return min((abs(group.index(o) - group.index(goal)) for o in found), default=0)

    def forward(self, a: Lane, s_a: float, b: Lane, s_b: float) -> float | None:
        """Metres from a to b in direction of travel; None if b is not reached."""
        line = lane_line(a)
        if a.group == b.group and (s_b - s_a) * a.direction >= 0.0:
            return abs(line.length_at(s_b) - line.length_at(s_a))
        key = (a, b)
        found = self._gaps[key] if key in self._gaps else self.gap(a, b)
        if found is None:
            return None
        gap, entry = found
        here = line.length_at(s_a)
        there = lane_line(entry).length_at(s_b)
        if a.direction > 0:
            here = line.length - here
        if b.direction < 0:
            there = lane_line(entry).length - there
        return here + gap + there

    def signed(self, a: Lane, s_a: float, b: Lane, s_b: float) -> float | None:
        """Distance from a to b, negative if b is behind; the shorter of both directions."""
        if a.group == b.group and a.direction == b.direction:  # the usual case, and no ring
            on = (s_b - s_a) * a.direction
            if on > 0.0 and self.gap(b, a) is None:
                line = lane_line(a)
                return abs(line.length_at(s_b) - line.length_at(s_a))
            if on < 0.0 and self.gap(a, b) is None:
                line = lane_line(b)
                return -abs(line.length_at(s_a) - line.length_at(s_b))
        ahead, behind = self.forward(a, s_a, b, s_b), self.forward(b, s_b, a, s_a)
        if behind is None:
            return ahead
        if ahead is None or behind < ahead:
            return -behind
        if behind == ahead and (lane_order(b), s_b) < (lane_order(a), s_a):
            return -behind  # opposite on a ring: one fixed sign keeps it antisymmetric
        return ahead


class Route:
    """Field of remaining distances to a goal; decides at forks.

    Attributes:
        goal: The end of the route.
    """

    __slots__ = ("_field", "_find", "_groups", "_lane", "goal")

    def __init__(
        self,
        goal: LanePosition,
        lane: Lane,
        groups: LaneGroups,
        find: Callable[[str, int, float], tuple[Lane, float]],
    ) -> None:
        self.goal = goal
        self._lane = lane
        self._groups = groups
        self._find = find
        self._field = groups.field(lane.group)

    def distance(self, p: LanePosition) -> float | None:
        """Remaining distance (m) from a position; None if the goal is not reached from there.

        From a position just past the goal it is a full loop.
        """
        lane, s = self._find(p.road, p.lane, p.s)
        return self._groups.forward(lane, s, self._lane, self.goal.s)

    def cost(self, lane: Lane) -> float:
        """Remaining distance (m) from the start of a lane to the goal, to compare branches."""
        if lane.group == self._field.goal:
            return 0.0
        return self._groups.length(lane.group) + self._groups.gap_from(lane.group, self._field)
