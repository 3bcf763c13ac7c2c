"""Heights across a road: `shape` and `crossSectionSurface` (OpenDRIVE 10.5.3 and 10.5.4)."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from typing import Protocol

from lxml import etree

from osc2tx_shared.classes import dataclass

from .polynomials import ZERO, Piecewise, Row
from .xml_reader import Attributes

Height = tuple[float, float, float]
"""A height (m), and its derivatives along s and t."""

_FLAT: Height = 0.0, 0.0, 0.0


class CrossSection(Protocol):
    """Heights of the surface of a road above the plane of its elevation and superelevation."""

    def at(self, s: float, t: float) -> Height:
        """Height at road coordinates (m)."""
        ...


class Shapes:
    """Profiles over t at some s, linear in s between them; flat before the first one."""

    __slots__ = ("_profiles", "_starts")

    def __init__(self, profiles: Mapping[float, Piecewise]) -> None:
        self._starts = sorted(profiles)
        self._profiles = [profiles[s] for s in self._starts]

    def at(self, s: float, t: float) -> Height:
        """Height at road coordinates (m)."""
        i = bisect_right(self._starts, s) - 1
        if i < 0:
            return _FLAT
        height, slope = self._profiles[i].value_slope(t)
        if i + 1 == len(self._starts):
            return height, 0.0, slope
        onward, bend = self._profiles[i + 1].value_slope(t)
        span = self._starts[i + 1] - self._starts[i]
        share = (s - self._starts[i]) / span
        rise = onward - height
        return height + rise * share, rise / span, slope + (bend - slope) * share


@dataclass(frozen=True, slots=True)
class Strip:
    """A cubic polynomial across the road whose coefficients change along it.

    Attributes:
        terms: Its coefficients over s, the constant one first.
        width: Width of an inner strip (m over s); the outer strip begins beyond it.
        on_top: Whether its height is added to that of the edge of the inner strip.
    """

    terms: tuple[Piecewise, Piecewise, Piecewise, Piecewise]
    width: Piecewise | None
    on_top: bool

    def at(self, s: float, across: float) -> Height:
        """Height (m) at a distance (m) from its start."""
        height = along = slope = 0.0
        for i, term in enumerate(self.terms):
            value, rate = term.value_slope(s)
            height += value * across**i
            along += rate * across**i
            slope += i * value * across ** (i - 1) if i else 0.0
        return height, along, slope


class SurfaceStrips:
    """Up to two strips on each side of a line beside the reference line."""

    __slots__ = ("_offset", "_strips")

    def __init__(self, offset: Piecewise, strips: Mapping[int, Strip]) -> None:
        self._offset = offset
        self._strips = strips

    def at(self, s: float, t: float) -> Height:
        """Height at road coordinates (m)."""
        middle, drift = self._offset.value_slope(s)
        across = t - middle
        side = 1 if across > 0.0 else -1
        inner, outer = self._strips.get(side), self._strips.get(2 * side)
        if inner is None:
            return _FLAT
        if outer is not None and inner.width is not None:
            width, widening = inner.width.value_slope(s)
            if abs(across) > width:
                edge, rate = side * width, side * widening
                height, along, slope = outer.at(s, across - edge)
                along -= slope * (drift + rate)
                if outer.on_top:
                    base, base_along, base_slope = inner.at(s, edge)
                    height, along = height + base, along + base_along + base_slope * rate
                return height, along, slope
        height, along, slope = inner.at(s, across)
        return height, along - slope * drift, slope


def read_cross_section(
    lateral: etree._Element | None, attributes: Attributes
) -> CrossSection | None:
    """The cross-section that a `lateralProfile` describes; None if the cross-section is flat.

    Raises:
        MapError: A record of it cannot be read.
    """
    if lateral is None:
        return None
    surface = lateral.find("crossSectionSurface")
    if surface is not None:
        return _strips(surface, attributes)
    records: dict[float, list[tuple[float, Row]]] = {}
    for element in lateral.iterchildren("shape"):
        record = attributes.number(element, "t"), attributes.cubic(element)
        records.setdefault(attributes.number(element, "s"), []).append(record)
    profiles = {s: attributes.piecewise(found) for s, found in records.items()}
    found = {s: profile for s, profile in profiles.items() if profile is not None}
    return Shapes(found) if any(not profile.is_zero() for profile in found.values()) else None


def _strips(surface: etree._Element, attributes: Attributes) -> SurfaceStrips:
    strips = {}
    for element in surface.iter("strip"):
        number = attributes.integer(element, "id")
        if abs(number) not in (1, 2):
            raise attributes.error(element, f"id {number} is not one of 1, 2, -1 and -2")
        width = element.find("width")
        strips[number] = Strip(
            (
                _over_s(element.find("constant"), attributes),
                _over_s(element.find("linear"), attributes),
                _over_s(element.find("quadratic"), attributes),
                _over_s(element.find("cubic"), attributes),
            ),
            None if width is None else _over_s(width, attributes),
            element.get("mode") == "relative",
        )
    return SurfaceStrips(_over_s(surface.find("tOffset"), attributes), strips)


def _over_s(parent: etree._Element | None, attributes: Attributes) -> Piecewise:
    """Polynomials over s; missing coefficients are zero."""
    elements = [] if parent is None else list(parent.iterchildren("coefficients"))
    records = []
    for element in elements:
        a, b, c, d = (attributes.number(element, name, 0.0) for name in "abcd")
        records.append((attributes.number(element, "s"), (a, b, c, d)))
    return attributes.piecewise(records) or ZERO
