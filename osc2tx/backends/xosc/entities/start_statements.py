"""Statements of a scenario about the start of each actor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.registry import WITHOUT_FORM
from osc2tx.backends.xosc.actions.trailers import towing
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import check_declared, check_map, is_map
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.facts.start_places import read_spawn
from osc2tx.backends.xosc.scopes import Scope
from osc2tx.backends.xosc.state import ActorState
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class Start:
    """The start of one actor.

    Attributes:
        member: Who.
        scope: Where it is said.
        placement: What is said; `None`: nothing.
        modifiers: The same, by name.
        references: Whom it refers to.
        is_beside: It refers to the position of another actor.
        tow: Who tows it; empty: nobody.
        spawn: Where an option says that it is.
    """

    member: CastMember
    scope: Scope
    placement: ir.Placement | None
    modifiers: Mapping[str, Arguments]
    references: tuple[str, ...]
    is_beside: bool = False
    tow: str = ""
    spawn: LanePosition | None = None

    @property
    def id(self) -> str:
        """Who."""
        return self.member.name

    @property
    def rank(self) -> int:
        """Points come before what is relative, open places last."""
        if "location" in self.modifiers or is_at_point(self.modifiers.get("position")):
            return 0
        return 1 if self.references or self.spawn is not None else 2

    @property
    def is_open(self) -> bool:
        """Whether it is left open how far along the road it starts, or in which lane."""
        told = "lane" if "along" in self.modifiers else "position"
        return self.rank == 2 and told not in self.modifiers

    @property
    def span(self) -> Span:
        """Where its start is said, or the actor declared."""
        return self.member.actor.span if self.placement is None else self.placement.span


StartPlace: TypeAlias = tuple[xml.PositionPart, ActorState]
"""Where an actor starts: the element, and what is known about the actor there."""

RELATIVE = ("same_as", "side_of", "ahead_of", "behind", "relative_to")
FASTER = {"faster_than": 1.0, "slower_than": -1.0}
"""Parameters that name whose speed another one is relative to, with the sign of the difference."""

BESIDE = frozenset({"lane", "position"})
"""Modifiers that say a place beside the actors that they name."""


def is_at_point(position: Arguments | None) -> bool:
    """Whether a position is a point in the world."""
    return position is not None and ("at_point" in position or "x" in position)


def starts_of(ctx: Context) -> list[Start]:
    """Return the start of each actor; what is wrong with one is in the report."""
    check_declared(ctx)
    found: dict[str, Start] = {}
    spawns = dict(map(read_spawn, ctx.options.spawns))
    for scope in ctx.scope.all():
        for placement in scope.scenario.placements:
            member = scope.cast.get(placement.actor)
            acts = placement.is_later or not scope.is_first  # it acts already, or enters
            if placement.is_implied and (acts or (member is not None and member.name in spawns)):
                continue
            if is_map(ctx, placement.actor):
                check_map(ctx, placement)
                continue
            with ctx.within(scope), ctx.report_as("placement", placement.span):
                if member is None:
                    raise Inexpressible(f"`{placement.actor}` is no entity of the XML")
                if not scope.is_first:
                    raise Inexpressible("the scenario that places it does not begin with the run")
                known = found.get(member.name)
                if known is not None and not placement.is_implied:
                    raise Inexpressible(f"{member.name} is placed twice")
                start = known or Start(member, scope, placement, {}, ())
                found[member.name] = _with(ctx, start, placement)
    ctx.present |= {*found, *spawns}
    tows = towing(ctx)
    starts = []
    for member in ctx.entities:
        start = found.get(member.name) or Start(member, ctx.scope, None, {}, ())
        tow = tows.get(member.name, "")
        references = (*tow.split(), *start.references)
        spawn = spawns.get(member.name)
        starts.append(replace(start, references=references, tow=tow, spawn=spawn))
    return starts


def _with(ctx: Context, start: Start, placement: ir.Placement) -> Start:
    """Return a start with what a placement states where it is silent so far."""
    added = {
        c.name: Arguments(ctx, c) for c in placement.modifiers if c.name not in start.modifiers
    }
    references, is_beside = dict.fromkeys(start.references), start.is_beside
    for modifier, arguments in added.items():
        if modifier in WITHOUT_FORM["modifier"]:
            raise Inexpressible(WITHOUT_FORM["modifier"][modifier], arguments.span)
        for name in (*RELATIVE, *FASTER):
            other = arguments.entity(name)
            if other is not None:
                references[other.name] = None
                is_beside = is_beside or modifier in BESIDE
    modifiers = {**start.modifiers, **added}
    return replace(start, modifiers=modifiers, references=tuple(references), is_beside=is_beside)


def in_order(starts: list[Start]) -> list[Start]:
    """Sort so that references come first: tools put actors somewhere one after the other."""
    placed: set[str] = set()
    ordered: list[Start] = []
    waiting = list(starts)
    while waiting:
        ready = next((s for s in waiting if placed.issuperset(s.references)), waiting[0])
        waiting.remove(ready)
        placed.add(ready.id)
        ordered.append(ready)
    return ordered


def speed_at_start(ctx: Context, start: Start) -> float:
    """Return the speed (m/s) with which an actor starts.

    Raises:
        Inexpressible: It follows from a speed that is not known.
    """
    arguments = start.modifiers.get("speed")
    if arguments is None:
        return 0.0
    speed = arguments.number("speed") or 0.0
    for name, sign in (("same_as", 1.0), *FASTER.items()):
        other = arguments.entity(name)
        if other is not None:
            theirs = ctx.states[other.name].known_speed
            if theirs is None:
                raise Inexpressible(f"the speed of {other.name} is not known", start.span)
            factor = arguments.number("factor")
            return theirs * (1.0 if factor is None else factor) + sign * speed
    return speed
