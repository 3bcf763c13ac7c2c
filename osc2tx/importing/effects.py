"""What actions do to actors, and what their readers share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    ACCELERATION,
    LENGTH,
    PRODUCT,
    SPEED,
    TIME,
    Dimension,
    Quantity,
    literal,
)
from osc2tx.importing.document import Document
from osc2tx.importing.ground import OnRoad
from osc2tx.importing.libraries import Shared
from osc2tx.importing.marks import Marks
from osc2tx.importing.places import Places
from osc2tx.importing.signals import TrafficLights
from osc2tx.importing.statements import Statement
from osc2tx.importing.values import Values
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player.bodies import Body
from osc2tx.xosc.player.courses import PEAK_RATES
from osc2tx_shared.classes import dataclass

LONGITUDINAL, LATERAL = "longitudinal", "lateral"
BOTH = frozenset((LONGITUDINAL, LATERAL))
CUBIC = 0.0101
"""So large a part of a change a cubic course is at most from half a cosine that takes as long."""
PROFILES = {"linear": "constant", "sinusoidal": "smooth", "cubic": "smooth"}


@dataclass(frozen=True, slots=True)
class Effect:
    """What an action does to an actor.

    Attributes:
        statement: The invocation.
        actor: The actor; `""`: none.
        slots: What of its motion the action controls.
    """

    statement: Statement
    actor: str = ""
    slots: frozenset[str] = frozenset()


@dataclass
class Readings:
    """What readers of actions and conditions share.

    Attributes:
        document: The document.
        values: Its values.
        places: Its places.
        actors: The actors, by their names in the document.
        lights: The traffic lights.
        marks: The events that stand for variables.
        shared: What the library has.
        lanes: The lanes in which actors are by now; `None`: not known.
        offsets: The offsets (m) last commanded, to the left.
        speeds: The speeds last commanded; `None`: not known.
        begin: Time (s) at which the event at hand starts, as far as times say it.
    """

    document: Document
    values: Values
    places: Places
    actors: Mapping[str, Actor]
    lights: TrafficLights
    marks: Marks
    shared: Shared
    lanes: dict[str, int | None] = field(default_factory=dict)
    offsets: dict[str, float] = field(default_factory=dict)
    speeds: dict[str, Quantity | None] = field(default_factory=dict)
    begin: float = 0.0


class Reader:
    """Reads some actions or conditions of a document."""

    def __init__(self, readings: Readings) -> None:
        self._document, self._values = readings.document, readings.values
        self._places, self._actors = readings.places, readings.actors
        self._lights, self._marks, self._shared = readings.lights, readings.marks, readings.shared
        self._lanes, self._speeds = readings.lanes, readings.speeds
        self._offsets, self._readings = readings.offsets, readings

    def _actor(self, node: Node, name: str = "entityRef") -> Actor:
        """Return the actor that an attribute names.

        Raises:
            Unresolved: There is none.
        """
        said = self._values.text(node, name)
        if said not in self._actors:
            raise Unresolved(f"there is no entity {said}", node.place)
        return self._actors[said]

    def _body(self, actor: Actor) -> Body | None:
        """Return an actor where it is at the start."""
        return self._places.bodies.get(actor.said)

    def _on_road(self, actor: Actor) -> OnRoad | None:
        """Return an actor with its lane at the start; `None`: it is in none, or without a map."""
        return self._places.on_road(actor.said)


def of_dynamics(node: Node) -> Dimension:
    """Return the dimension of the value of dynamics."""
    dimension = node.text("dynamicsDimension") or "time"
    rate = ACCELERATION if node.tag == "SpeedActionDynamics" else SPEED
    return {"time": TIME, "distance": LENGTH, "rate": rate}.get(dimension, TIME)


def smooth_peak(cubic: Quantity, dimension: Dimension) -> str:
    """Return the peak rate of a smooth change that takes as long as a cubic one with its peak."""
    ratio = PEAK_RATES["sinusoidal"] / PEAK_RATES["cubic"]
    if cubic.is_open:
        return f"{ratio:.6f} * {cubic.within(PRODUCT)}"
    return literal(round(ratio * cubic.value, 6), dimension)
