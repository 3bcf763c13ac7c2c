"""Third-party documents in the form of the player: with defaults, without parts of tools.

Controllers, appearance and weather have no effect in the player. Entities continue by the rest of
the document.
"""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import KINDS

WITHOUT_MOTION = frozenset(
    {
        "ControllerAction",
        "ActivateControllerAction",
        "AppearanceAction",
        "EnvironmentAction",
        "VisibilityAction",
        "UserDefinedAction",
    }
)
"""Actions that move nothing."""

UNUSED = frozenset({"ConstraintGroup", "ObjectController"})
"""Elements without a part in the motion, once parameters have their values."""

DEFAULTS: Mapping[str, Mapping[str, str]] = {
    "Condition": {"conditionEdge": "none", "delay": "0"},
    "Event": {"priority": "parallel", "maximumExecutionCount": "1"},
    "ManeuverGroup": {"maximumExecutionCount": "1"},
    "TriggeringEntities": {"triggeringEntitiesRule": "any"},
    "SpeedActionDynamics": {"dynamicsShape": "step", "dynamicsDimension": "time", "value": "0"},
    "LaneChangeActionDynamics": {"dynamicsShape": "sinusoidal", "dynamicsDimension": "time"},
    "LaneOffsetActionDynamics": {"dynamicsShape": "step"},
}
"""Values of required attributes that documents omit."""


ANY_VEHICLE = xml.Vehicle(
    xml.BoundingBox(
        xml.Center(x=1.4, y=0.0, z=0.75), xml.Dimensions(length=4.6, width=1.9, height=1.5)
    ),
    name="vehicle",
    vehicleCategory="car",
)
"""What an entity is that no catalog at hand describes."""


def plain(node: Element) -> Element:
    """Return a document, its parameters at their values, as the player takes it."""
    attributes = dict(DEFAULTS.get(node.tag, {})) | dict(node.attributes)
    children = [plain(child) for child in node.children if not _is_idle(child)]
    if node.tag == "ScenarioObject" and not any(child.tag in KINDS for child in children):
        children.append(ANY_VEHICLE)
    return node.with_attributes(attributes).with_children(*children)


def _is_idle(node: Element) -> bool:
    if node.tag in UNUSED or node.tag in WITHOUT_MOTION:
        return True
    if node.tag in ("Action", "PrivateAction", "GlobalAction"):
        return bool(node.children) and all(_is_idle(child) for child in node.children)
    if node.tag == "StartTrigger" and not node.children:
        return True  # tools immediately start elements without a trigger
    if node.tag == "TrailerRef":
        return not node.get("entityRef")
    return node.tag == "Trailer" and all(_is_idle(child) for child in node.children)
