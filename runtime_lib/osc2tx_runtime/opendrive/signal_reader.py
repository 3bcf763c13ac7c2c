"""OpenDRIVE text to signals and controllers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lxml import etree

from .model import Junction, road_order
from .signals import Controller, Signal, SignalReference
from .xml_reader import Attributes


def read_signals(roads: Iterable[etree._Element], attributes: Attributes) -> tuple[Signal, ...]:
    """All signals of a map, sorted by id, with their references."""
    elements: list[tuple[str, etree._Element]] = []
    references: dict[str, list[SignalReference]] = {}
    for road in roads:
        container = road.find("signals")
        if container is None:
            continue
        road_id = attributes.text(road, "id")
        elements.extend((road_id, e) for e in container.iterchildren("signal"))
        for element in container.iterchildren("signalReference"):
            found = references.setdefault(attributes.text(element, "id"), [])
            found.append(_reference(element, road_id, attributes))
    signals = [
        _signal(element, road, tuple(references.get(element.get("id", ""), ())), attributes)
        for road, element in elements
    ]
    return tuple(sorted(signals, key=lambda signal: road_order(signal.id)))


def _validity(element: etree._Element, attributes: Attributes) -> tuple[tuple[int, int], ...]:
    return tuple(
        (attributes.integer(e, "fromLane"), attributes.integer(e, "toLane"))
        for e in element.iterchildren("validity")
    )


def _reference(element: etree._Element, road: str, attributes: Attributes) -> SignalReference:
    return SignalReference(
        road,
        attributes.number(element, "s"),
        attributes.number(element, "t"),
        element.get("orientation", "none"),
        _validity(element, attributes),
    )


def _signal(
    element: etree._Element,
    road: str,
    references: tuple[SignalReference, ...],
    attributes: Attributes,
) -> Signal:
    has_value = element.get("value") not in (None, "")
    return Signal(
        id=attributes.text(element, "id"),
        name=element.get("name", ""),
        road=road,
        s=attributes.number(element, "s"),
        t=attributes.number(element, "t"),
        orientation=element.get("orientation", "none"),
        dynamic=element.get("dynamic", "no") == "yes",
        country=element.get("country", ""),
        type=element.get("type", ""),
        subtype=element.get("subtype", ""),
        value=attributes.number(element, "value") if has_value else None,
        unit=element.get("unit", ""),
        text=element.get("text", ""),
        z_offset=attributes.number(element, "zOffset", 0.0),
        h_offset=attributes.number(element, "hOffset", 0.0),
        height=attributes.number(element, "height", 0.0),
        width=attributes.number(element, "width", 0.0),
        validity=_validity(element, attributes),
        references=references,
    )


def read_controllers(
    root: etree._Element, junctions: Sequence[Junction], attributes: Attributes
) -> tuple[Controller, ...]:
    """All controllers of a map, sorted by id."""
    found = [_controller(e, junctions, attributes) for e in root.iterchildren("controller")]
    return tuple(sorted(found, key=lambda controller: road_order(controller.id)))


def _controller(
    element: etree._Element, junctions: Sequence[Junction], attributes: Attributes
) -> Controller:
    own_id = attributes.text(element, "id")
    signals = [attributes.text(e, "signalId") for e in element.iterchildren("control")]
    return Controller(
        own_id,
        element.get("name", ""),
        attributes.integer(element, "sequence") if element.get("sequence") else None,
        tuple(dict.fromkeys(signals)),  # files repeat a signal once per light
        tuple(junction.id for junction in junctions if own_id in junction.controllers),
    )
