"""Signals, their references and controllers (OpenDRIVE chapter "Signals")."""

from __future__ import annotations

from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class SignalReference:
    """A further position at which a signal is valid.

    Attributes:
        road: Road id.
        s: Road coordinate (m).
        t: Lateral coordinate (m, left positive).
        orientation: "+" valid in direction of s, "-" against, "none" both.
        validity: Lane ranges (from, to); empty means all lanes of the orientation.
    """

    road: str
    s: float
    t: float
    orientation: str
    validity: tuple[tuple[int, int], ...] = ()


@dataclass(frozen=True, slots=True)
class Signal:
    """A traffic sign or a traffic light.

    Attributes:
        id: Signal id, unique in the map.
        name: Name, may be empty.
        road: Road id.
        s: Road coordinate (m).
        t: Lateral coordinate (m, left positive).
        orientation: "+" valid in direction of s, "-" against, "none" both.
        dynamic: True for signals that change their state (lights).
        country: Country code of the type catalogue.
        type: Type code.
        subtype: Subtype code.
        value: Value such as a speed limit, in `unit`; None if not given.
        unit: Unit of the value as written in the file.
        text: Additional text.
        z_offset: Height of the lower edge above the road (m).
        h_offset: Heading relative to the orientation (rad).
        height: Height (m).
        width: Width (m).
        validity: Lane ranges (from, to); empty means all lanes of the orientation.
        references: Further positions at which the signal is valid.
    """

    id: str
    name: str
    road: str
    s: float
    t: float
    orientation: str
    dynamic: bool
    country: str = ""
    type: str = ""
    subtype: str = ""
    value: float | None = None
    unit: str = ""
    text: str = ""
    z_offset: float = 0.0
    h_offset: float = 0.0
    height: float = 0.0
    width: float = 0.0
    validity: tuple[tuple[int, int], ...] = ()
    references: tuple[SignalReference, ...] = ()


@dataclass(frozen=True, slots=True)
class Controller:
    """Signals that change together.

    Attributes:
        id: Controller id.
        name: Name, may be empty.
        sequence: Order among the controllers of a junction, None if not given.
        signals: Ids of the controlled signals, without repetition, in file order.
        junctions: Ids of the junctions with this controller.
    """

    id: str
    name: str
    sequence: int | None
    signals: tuple[str, ...]
    junctions: tuple[str, ...] = ()
