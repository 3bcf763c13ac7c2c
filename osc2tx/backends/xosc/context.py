"""Context of one scenario, shared by all modules of the back end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from math import inf
from typing import NamedTuple

from osc2tx import ir
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.map_search import MapSegment
from osc2tx.backends.xosc.facts.maps import MapFolders, Pose, Roads
from osc2tx.backends.xosc.logical.sampling import NOTHING_OPEN, Choosing
from osc2tx.backends.xosc.scopes import Scope, open_scopes
from osc2tx.backends.xosc.state import ActorState, Demand, merged
from osc2tx.backends.xosc.values.folding import Values
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import GENERIC, Inexpressible, Remedy
from osc2tx.losses.report import LossReport
from osc2tx.options import XmlOptions, XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Unwritable
from osc2tx.xosc.literals import ParameterType, Rule
from osc2tx.xosc.names import Names
from osc2tx.xosc.profiles import PROFILES, ToolProfile
from osc2tx_shared.classes import dataclass

_NUMBERS = {"false": "0", "true": "1"}


@dataclass(frozen=True, slots=True)
class Outlook:
    """What the whole of a scenario asks for, parts of which stand before the others.

    Attributes:
        demands: Of the motion of actors, by name.
        speeds_read: The actors at whose speed a condition looks.
        moves: As `Context.moves`.
    """

    demands: Mapping[str, Demand]
    speeds_read: frozenset[str]
    moves: Mapping[str, Mapping[int, Move]]


class Move(NamedTuple):
    """What is known of an actor during an invocation, and when that has reached its goal."""

    during: ActorState
    after: ActorState


class Context:
    """One scenario on its way to the XML.

    Attributes:
        scenario: What is written down.
        module: Where it stands.
        options: What was chosen.
        version: Of the XML.
        profile: The tool that reads it.
        report: The grades of the constructs.
        names: Of elements.
        choosing: Open parameters, and which of them are parameters of the document.
        root: The scenario, with its actors and values.
        scope: The same, or of the scenario it invokes that is being written down.
        entities: All physical actors.
        roads: The map, if it was found.
        map_places: Where it was looked for, outside of the runtime library.
        map_file: What the scenario calls its map.
        states: What is known about the actors at the present place of the tree.
        at_start: The states after the initial placement.
        present: Actors that are placed, or have acted before the present place of the tree; a run
            plans how the others enter if their first action says where it begins.
        start_poses: Where actors start and how they look, as far as that is known, by name.
        init_gaps: Metres by which an actor starts behind another one.
        automatic_lights: What shines of vehicles whose lights follow the weather, by name.
        segments: Where declared roads and lanes are on the map, once they have been looked for.
        init_globals: Actions of `Init` that concern no entity.
        init_privates: What `Init` says about actors, by name, references first.
        demands: What the scenario asks of the motion of an actor, by name.
        moves: What invocations make of actors, by name and by the id of the invocation.
        outlook: What the whole scenario asks for; `None` while it is written down first.
        asks_outlook: Something that is written down depends on that.
        followed: Whose motion an actor has to be able to take over, by name.
        weather: What the scenario has said about it up to the present place of the tree.
        monitors: Value at the start of monitors, by name.
        variables: Type and value at the start of variables, by name.
        lamps: States of the lamps of traffic lights at the present place of the tree; `None` if
            not known, off if not there.
        controllers: Of traffic lights, for the road network.
        origins: Where the members stand that the events belong to, by event.
    """

    def __init__(
        self,
        scenario: ir.Scenario,
        module: ir.Module,
        options: XmlOptions,
        maps: MapFolders,
        choosing: Choosing = NOTHING_OPEN,
        outlook: Outlook | None = None,
    ) -> None:
        """Take the scenario, where its map may be, and what is known from writing it before."""
        self.scenario = scenario
        self.module = module
        self.options = options
        self.version: XmlVersion = options.version
        self.profile: ToolProfile = PROFILES[options.profile]
        self.report = LossReport(options, scenario, module)
        self.names = Names()
        self.choosing = choosing
        self.root = open_scopes(scenario, module, choosing.given(self.version))
        self.scope = self.root
        self.entities: list[CastMember] = self.scope.members()
        self.map_file = self._map_file()
        self.roads: Roads | None = None
        try:
            self.roads = maps.roads(self.map_file)
        except Inexpressible as error:
            self.report.cannot("map", scenario.span, error.reason)
        self.map_places = maps.places(self.map_file)
        self.states: dict[str, ActorState] = {}
        self.at_start: dict[str, ActorState] = {}
        self.present: set[str] = set()
        self.start_poses: dict[str, Pose] = {}
        self.demands: dict[str, Demand] = {}
        self.moves: dict[str, dict[int, Move]] = {}
        self.outlook = outlook
        self.asks_outlook = False
        self.followed: dict[str, set[str]] = {}
        self.monitors: dict[str, bool] = {}
        self.weather: dict[str, float] = {}
        self.init_globals: list[xml.ActionsPart] = []
        self.init_privates: dict[str, xml.Private] = {}
        self.init_gaps: dict[tuple[str, str], float] = {}
        self.segments: dict[str, MapSegment] | None = None
        self.automatic_lights: dict[str, str] = {}
        self.variables: dict[str, tuple[ParameterType, str]] = {}
        self.lamps: dict[str, tuple[str, ...] | None] = {}
        self.controllers: list[xml.TrafficSignalController] = []
        self.origins: dict[str, Span] = {}
        self._variable_names: dict[str, str] = {}
        for parameter in choosing.parameters:  # whether they are kept or not
            self.names.new(parameter.name)
        for member in self.entities:
            self.names.new(member.name)

    @property
    def values(self) -> Values:
        """Constants of the scenario that is being written down."""
        return self.scope.values

    @property
    def cast(self) -> dict[str, CastMember]:
        """Its physical actors, by their names in it."""
        return self.scope.cast

    @contextmanager
    def within(self, scope: Scope) -> Iterator[None]:
        """Look at names as an invoked scenario does."""
        outer, self.scope = self.scope, scope
        try:
            yield
        finally:
            self.scope = outer

    def actors_like(self, kind: str) -> list[ir.Actor]:
        """Return the actors of a type, as map and environment are."""
        actors = (each for each in self.scenario.declarations if isinstance(each, ir.Actor))
        return [actor for actor in actors if kind in actor.lineage]

    def _map_file(self) -> str | None:
        for actor in self.actors_like("map"):
            value = self.values.field(actor.name, "map_file")
            if isinstance(value, str):
                return value
        for placement in self.scenario.placements:
            for call in placement.modifiers:
                if call.name == "set_map_file":
                    (argument,) = call.arguments
                    value = self.values.of(argument.value)
                    return value if isinstance(value, str) else None
        return None

    @contextmanager
    def report_as(self, construct: str, span: Span) -> Iterator[None]:
        """Report a construct: exact, unless it turns out to be inexpressible inside."""
        try:
            yield
        except Unwritable as error:
            self.report.refuse(construct, span, error)
        else:
            self.report.exact(construct, span)

    def require(
        self, what: str, since: XmlVersion, span: Span | None = None, instead: str = ""
    ) -> None:
        """Refuse what the version does not have yet; `instead` is what any of them has."""
        if self.version < since:
            newer = Remedy(version=since, instead=instead)
            raise Inexpressible(f"{what} is not in OpenSCENARIO XML {self.version}", span, newer)

    def required_roads(
        self, what: str = "roads are looked for on", span: Span | None = None, otherwise: str = ""
    ) -> Roads:
        """Return the map.

        Raises:
            Inexpressible: It is not at hand, though something needs it.
        """
        if self.roads is None:
            raise Inexpressible(
                f"{what} the map {self.map_file}, which is not at hand: give its folder with"
                f" --map-path{otherwise}",
                span,
            )
        return self.roads

    def require_support(self, feature: str, span: Span | None = None) -> None:
        """Refuse what the tool does not carry out; `feature` as in `ToolProfile.unsupported`."""
        instead = self.profile.unsupported.get(feature)
        if instead is not None:
            raise Inexpressible(
                f"{self.profile.name} does not carry out {feature}: {instead}", span, GENERIC
            )

    def can(self, feature: str, since: XmlVersion) -> bool:
        """Whether version and tool have a feature."""
        return self.version >= since and feature not in self.profile.unsupported

    # --- motion ---------------------------------------------------------------------------------

    def demand(self, actor: str, demand: Demand) -> None:
        """Note what an actor has to be able to."""
        self.demands[actor] = self.demands.get(actor, Demand()).over(demand)

    def demand_on(self, actor: str) -> Demand:
        """Return what the whole scenario asks of an actor; the most while that is not known."""
        self.asks_outlook = True
        if self.outlook is None:
            return Demand(inf, inf, inf, True)
        return self.outlook.demands.get(actor, Demand())

    def note_move(self, actor: str, node: ir.Invoke, during: ActorState, after: ActorState) -> None:
        """Note what an invocation makes of an actor."""
        moves, own = self.moves.setdefault(actor, {}), merged(during, after)
        known = moves.get(id(node))
        moves[id(node)] = Move(own if known is None else merged(known.during, own), after)

    def moves_of(self, actor: str) -> Mapping[int, Move] | None:
        """Return what the whole scenario makes of an actor; `None` while that is not known."""
        self.asks_outlook = True
        return None if self.outlook is None else self.outlook.moves.get(actor, {})

    def is_speed_read(self, actor: str) -> bool:
        """Whether a condition looks at the speed of an actor."""
        self.asks_outlook = True
        return self.outlook is not None and actor in self.outlook.speeds_read

    def whole_demand(self, actor: str) -> Demand:
        """Return what is asked of an actor, and of all those whose motion it takes over."""
        found, seen = Demand(), [actor]
        for name in seen:
            found = found.over(self.demands.get(name, Demand()))
            seen += sorted(self.followed.get(name, set()).difference(seen))
        return found

    # --- variables ------------------------------------------------------------------------------

    def declare(self, name: str, type_: ParameterType, value: str) -> None:
        """Declare a variable (a parameter before 1.2) if it is not there yet."""
        if type_ == "boolean" and not self.profile.has_booleans:
            type_ = "integer"
        self.variables.setdefault(name, (type_, self._known_value(value)))

    def variable_name(self, name: str) -> str:
        """Return the name of the variable for a name of the source; others have others."""
        if name not in self._variable_names:
            self._variable_names[name] = self.names.new(name)
        return self._variable_names[name]

    def set_variable(self, name: str, value: str) -> xml.GlobalAction:
        """Return the action that sets a variable."""
        value = self._known_value(value)
        if self.version >= "1.2":
            return xml.GlobalAction(
                xml.VariableAction(xml.SetAction(value=value), variableRef=name)
            )
        return xml.GlobalAction(xml.ParameterAction(xml.SetAction(value=value), parameterRef=name))

    def variable_is(self, name: str, rule: Rule, value: str) -> xml.ByValueCondition:
        """Return the condition on a variable."""
        value = self._known_value(value)
        condition = (
            xml.VariableCondition(variableRef=name, rule=rule, value=value)
            if self.version >= "1.2"
            else xml.ParameterCondition(parameterRef=name, rule=rule, value=value)
        )
        return xml.ByValueCondition(condition)

    def _known_value(self, value: str) -> str:
        """Return a value as the tool reads it."""
        return value if self.profile.has_booleans else _NUMBERS.get(value, value)

    def mark(self, name: str) -> xml.GlobalAction:
        """Return the action of an event that only keeps that something has become true.

        It sets a variable of its own. Tools see that one step earlier than the state of the event.
        """
        self.declare(name, "boolean", "false")
        return self.set_variable(name, "true")
