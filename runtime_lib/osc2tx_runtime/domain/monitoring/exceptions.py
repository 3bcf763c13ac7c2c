"""The modifiers and actions without a monitor, with the reasons."""

from __future__ import annotations

from osc2tx_runtime.domain.monitoring.registry import unmonitored

unmonitored("decides whether a deviation of the others is a failure", "physical_movement")
unmonitored("a collision is a line of the trace and a criterion of `--fail-on`", "avoid_collisions")
unmonitored("states the start position alone, which the placement checks", "location", "on_path")
unmonitored("the world draws a trailer along exactly", "tow_trailer")

unmonitored("only its modifiers state something", "move", "drive", "walk")
unmonitored("takes no time, so it has no phase", "assign_position", "assign_orientation")
unmonitored("takes no time, so it has no phase", "assign_speed", "assign_acceleration")
unmonitored("the standard does not define its modifier", "keep_acceleration")
unmonitored("changes no motion state", "connect_trailer", "disconnect_trailer")
