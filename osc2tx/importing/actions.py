"""Actions as invocations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from osc2tx.importing.cast import Actor, gives_control, note_controllers
from osc2tx.importing.cursor import Node
from osc2tx.importing.effects import Effect, Reader, Readings
from osc2tx.importing.offsets import Offsets
from osc2tx.importing.routes import Routes
from osc2tx.importing.speeds import Speeds
from osc2tx.importing.statements import Statement, call
from osc2tx.importing.surroundings import Surroundings
from osc2tx.importing.synchrony import Synchrony
from osc2tx.xosc.element import Unresolved


class Actions(Reader):
    """Reads the actions of a document.

    Attributes:
        readings: What their readers share.
        routes: Reads those of routes.
        surroundings: Reads those without an actor.
    """

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
        self.readings, self.routes = readings, Routes(readings)
        self.surroundings = Surroundings(readings)
        self._of_speeds, self._of_offsets = Speeds(readings), Offsets(readings)
        self._synchrony = Synchrony(readings)

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
                found += self.surroundings.effects(action.inner)
            elif action.tag == "PrivateAction":
                if not said:
                    action.leave_out("no actor carries it out")
                for name in said:
                    if name not in self._actors:
                        raise Unresolved(f"there is no entity {name}", action.place)
                    found += self._private(action.inner, self._actors[name], at_start)
            else:
                action.leave_out("actions of a user are for one tool")
        except Unresolved as error:
            action.leave_out(error.reason)
        return found

    def _private(self, node: Node, actor: Actor, at_start: bool) -> Iterator[Effect]:
        match node.tag:
            case "LongitudinalAction":
                yield from self._of_speeds.effects(node.inner, actor, at_start)
            case "LateralAction":
                yield from self._of_offsets.effects(node.inner, actor)
            case "TeleportAction":
                yield from self.routes.teleport(node, actor)
            case "RoutingAction":
                yield from self.routes.effects(node.inner, actor, at_start=at_start)
            case "ControllerAction" | "ActivateControllerAction":
                actor.is_under_test = actor.is_under_test or gives_control(node)
                note_controllers(node, self._document)
            case "TrailerAction":
                coupling = call(actor.name, "disconnect_trailer")
                if node.inner.tag == "ConnectTrailerAction":
                    trailer = self._actor(node.inner, "trailerRef").name
                    coupling = call(actor.name, "connect_trailer", trailer=trailer)
                yield Effect(Statement(coupling, length=0.0), actor.name)
            case "SynchronizeAction":
                yield from self._synchrony.effects(node, actor)
            case _:
                node.leave_out("the language has no such action")
