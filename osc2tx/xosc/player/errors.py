"""Errors of documents that cannot be played."""

from osc2tx.xosc.element import Place


class Unplayable(Exception):
    """A document contains an unsupported construct, or contradicts itself or its map.

    Attributes:
        reason: A sentence without full stop.
        place: Position of its element.
    """

    def __init__(self, reason: str, place: Place | None = None) -> None:
        """Store the details."""
        super().__init__(reason if place is None else f"{place}: {reason}")
        self.reason = reason
        self.place = place
