"""What cannot be played."""

from osc2tx.xosc.element import Place


class Unplayable(Exception):
    """A document asks for what the player does not know, or contradicts itself or its map.

    Attributes:
        reason: A sentence without full stop.
        place: Where the element stands that asks for it.
    """

    def __init__(self, reason: str, place: Place | None = None) -> None:
        """Take what there is to say."""
        super().__init__(reason if place is None else f"{place}: {reason}")
        self.reason = reason
        self.place = place
