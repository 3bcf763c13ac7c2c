"""Vehicle lights as commands for the simulator."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.actors import automatic_light
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import LightMode, VehicleLightType

AUTO = "auto"
"""The mode in which lights follow sun and fog."""

LIGHTS: Mapping[str, Mapping[VehicleLightType, LightMode]] = {
    "off": {"lowBeam": "off", "highBeam": "off", "daytimeRunningLights": "off"},
    "daytime": {"daytimeRunningLights": "on", "lowBeam": "off", "highBeam": "off"},
    "low_beam": {"lowBeam": "on", "highBeam": "off"},
    "high_beam": {"lowBeam": "on", "highBeam": "on"},
}
"""Mode of `set_lights` -> state of each light."""


@action("set_lights")
def _set_lights(leaf: Leaf) -> Performance:
    ctx = leaf.ctx
    mode = leaf.arguments.text("mode") or leaf.arguments.member("mode", AUTO)
    lit = automatic_light(ctx.weather) if mode == AUTO else mode
    if lit not in LIGHTS:
        raise Inexpressible(f"there is no counterpart of the light mode `{mode}`")
    # The schema of 1.2 asks for both alternatives of each choice at once.
    if ctx.version < "1.3":
        leaf.arguments.approximate(
            f"a light is not in OpenSCENARIO XML {ctx.version}",
            "the lights stay as they are; nothing that moves and no event is affected",
            Remedy(version="1.3"),
        )
        return Performance((), "instant")
    ctx.require_support("LightStateAction")
    ctx.automatic_lights.pop(leaf.member.name, None)
    if mode == AUTO:
        ctx.automatic_lights[leaf.member.name] = lit
    change = Change("lights", _shining(lit), 0.0, leaf.state, leaf.state)
    return Performance((change,), "instant")


def followed_lights(ctx: Context) -> dict[str, tuple[xml.ActionPart, ...]]:
    """Return the actions of vehicles whose automatic lights change with the weather."""
    now = automatic_light(ctx.weather)
    changing = [name for name, lit in ctx.automatic_lights.items() if lit != now]
    ctx.automatic_lights.update(dict.fromkeys(changing, now))
    return {name: _shining(now) for name in changing}


def _shining(mode: str) -> tuple[xml.ActionPart, ...]:
    actions = (
        xml.LightStateAction(
            xml.LightType(xml.VehicleLight(vehicleLightType=light)), xml.LightState(mode=state)
        )
        for light, state in LIGHTS[mode].items()
    )
    return tuple(xml.PrivateAction(xml.AppearanceAction(action)) for action in actions)
