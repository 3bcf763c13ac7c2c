"""Trailer actions: connect and disconnect (DSL 8.8.3.12, 8.8.3.13)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.planning.motion_action import Assignment, Refused
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import action
from osc2tx_runtime.world.motion.towing import COUPLING_REACH, coupling_gap

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import Vehicle
    from osc2tx_runtime.domain.objects.parts import Towable


@action("vehicle", "connect_trailer", ends="at_once", needs=("towing",))
class ConnectTrailer(Assignment):
    """Couple a trailer whose coupler is within `COUPLING_REACH` of the rear end of the vehicle."""

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        trailer: Towable,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.vehicle, self.trailer = actor, trailer

    def on_start(self) -> None:
        """Couples it, if it is within reach and not towed."""
        world, tow, trailer = self.world, self.actor.id, self.trailer.id
        gap = coupling_gap(self.here, world.state(trailer))
        if world.trailer_of(tow) is not None:
            raise Refused(f"{tow} tows {world.trailer_of(tow)} already")
        if any(world.trailer_of(other) == trailer for other in world.actors()):
            raise Refused(f"{trailer} is towed already")
        if gap > COUPLING_REACH:
            raise Refused(
                f"the coupler of {trailer} is {gap:.1f} m from the hitch of {tow}; couple within"
                f" {COUPLING_REACH:g} m"
            )
        misfit = self.trailer.misfit(self.vehicle.said_receiver)
        if misfit is not None:
            raise Refused(f"{tow} cannot tow {trailer}: {misfit}")
        self.effect("trailer", trailer, lambda: world.attach(tow, trailer))


@action("vehicle", "disconnect_trailer", ends="at_once", needs=("towing",))
class DisconnectTrailer(Assignment):
    """Uncouple the trailer, which brakes to standstill."""

    def on_start(self) -> None:
        """Uncouples it."""
        tow, world = self.actor.id, self.world
        if world.trailer_of(tow) is None:
            raise Refused(f"{tow} tows no trailer")
        self.effect("trailer", None, lambda: world.attach(tow, None))
