"""The action that sets the lights of a vehicle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack, get_args

from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.planning.motion_action import note_lights
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.action import Action, ActionOptions
from osc2tx_runtime.language.actions.registry import action
from osc2tx_runtime.language.tree.base import Status
from osc2tx_runtime.world.protocol import LightMode

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import Vehicle


@action("vehicle", "set_lights", ends="instant", needs=("lights",))
class SetLights(Action):
    """Switch the lights.

    Args:
        actor: The actor.
        *modifiers: None are accepted.
        mode: `off`, `auto` (low beams while the sun is lower than 15 degrees or the visual range is
            below 100 m), `daytime`, `position`, `low_beam` or `high_beam`.
        **options: Duration and label.
    """

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        mode: LightMode,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        if mode not in get_args(LightMode):
            known = ", ".join(get_args(LightMode))
            raise ScenarioError(f"{self.action_name}: mode `{mode}` is not one of {known}")
        self.mode: LightMode = mode

    def on_start(self) -> None:
        """Switches them."""
        self.effect("lights", self.mode, self._switch)

    def on_update(self) -> Status:
        """Ends in the same step."""
        return Status.SUCCESS

    def _switch(self) -> None:
        lights = self.context.world.set_lights(self.actor.id, self.mode)
        note_lights(self.context, self.actor.id, lights)
