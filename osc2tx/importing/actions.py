"""Actions as invocations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from osc2tx.importing.cast import Actor
from osc2tx.importing.controllers import gives_control, note_controllers
from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document
from osc2tx.importing.effects import Effect, Readings
from osc2tx.importing.offsets import Offsets
from osc2tx.importing.places import Places
from osc2tx.importing.routes import Routes
from osc2tx.importing.speeds import Speeds
from osc2tx.importing.statements import Statement, call
from osc2tx.importing.surroundings import Surroundings
from osc2tx.importing.synchrony import Synchrony
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Unresolved


class Actions:
    """Reads the actions of a document.

    Attributes:
        readings: What their readers share.
    """

    def __init__(
        self,
        document: Document,
        values: Values,
        places: Places,
        actors: Mapping[str, Actor],
        surroundings: Surroundings,
    ) -> None:
        self.readings = readings = Readings(values, places, actors)
        self._document, self._actors = document, actors
        self._speeds, self._offsets = Speeds(readings), Offsets(readings)
        self._routes, self._synchrony = Routes(readings), Synchrony(readings)
        self._surroundings = surroundings

    def effects(self, action: Node, said: Sequence[str], *, at_start: bool = False) -> list[Effect]:
        """Return what an action does; with a finding what of it the language cannot say.

        Args:
            action: `PrivateAction` or `GlobalAction`.
            said: The entities that carry out a private action.
            at_start: Whether it belongs to `Init`.
        """
        found: list[Effect] = []
        try:
            if action.tag == "GlobalAction":
                found += self._surroundings.effects(action.inner)
            elif action.tag == "PrivateAction":
                if not said:
                    action.leave_out("no actor carries it out")
                for name in said:
                    actor = self._actors.get(name)
                    if actor is None:
                        raise Unresolved(f"there is no entity {name}", action.place)
                    found += self._private(action.inner, name, actor, at_start)
            else:
                action.leave_out("actions of a user are for one tool")
        except Unresolved as error:
            action.leave_out(error.reason)
        return found

    def along_route(self, node: Node, said: str, actor: Actor) -> Statement | None:
        """Return what takes an actor along the route that it is given in `Init`."""
        return self._routes.assigned(node, said, actor)

    def _private(self, node: Node, said: str, actor: Actor, at_start: bool) -> Iterator[Effect]:
        match node.tag:
            case "LongitudinalAction":
                yield from self._speeds.effects(node.inner, said, actor, at_start)
            case "LateralAction":
                yield from self._offsets.effects(node.inner, said, actor)
            case "TeleportAction":
                yield from self._routes.teleport(node, said, actor)
            case "RoutingAction":
                yield from self._routes.effects(node.inner, said, actor, at_start=at_start)
            case "ControllerAction" | "ActivateControllerAction":
                actor.is_under_test = actor.is_under_test or gives_control(node)
                note_controllers(node, self._document)
            case "TrailerAction":
                yield self._coupling(node.inner, actor)
            case "SynchronizeAction":
                yield from self._synchrony.effects(node, said, actor)
            case _:
                node.leave_out("the language has no such action")

    def _coupling(self, node: Node, actor: Actor) -> Effect:
        """Return what couples a trailer, or lets it go."""
        coupling = call(actor.name, "disconnect_trailer")
        if node.tag == "ConnectTrailerAction":
            said = node.said("trailerRef")
            trailer = self._actors.get(said)
            if trailer is None:
                raise Unresolved(f"there is no entity {said}", node.place)
            coupling = call(actor.name, "connect_trailer", trailer=trailer.name)
        return Effect(Statement(coupling, length=0.0), actor.name)
