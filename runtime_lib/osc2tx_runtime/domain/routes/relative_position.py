"""Where an object is, and how that lies to others along the road."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.points_and_poses import Point
from osc2tx_runtime.world.measured import Measured

if TYPE_CHECKING:
    from osc2tx_runtime.domain.measuring.object_measurements import Measures

__all__ = ["RoutePosition"]


class RoutePosition:
    """Place of an object, with its relation to others along the road."""

    __slots__ = ("_object",)

    def __init__(self, of: Measures) -> None:
        self._object = of

    def ahead_of(self, reference: Measures) -> float:
        """How far (m) it is ahead of another object along the road; negative if behind."""
        return Measured(-self._object._along(reference))

    def behind(self, reference: Measures) -> float:
        """How far (m) it is behind another object along the road; negative if ahead."""
        return Measured(self._object._along(reference))

    @property
    def x(self) -> float:
        """World x (m)."""
        return Measured(self._object.state.x)

    @property
    def y(self) -> float:
        """World y (m)."""
        return Measured(self._object.state.y)

    @property
    def z(self) -> float:
        """World z (m)."""
        return Measured(self._object.state.z)

    def norm(self) -> float:
        """Distance from the world's origin (m)."""
        return Measured(Point(self.x, self.y, self.z).norm())
