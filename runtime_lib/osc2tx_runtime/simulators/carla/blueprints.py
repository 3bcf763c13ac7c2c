"""Blueprints and attributes of actors."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.world.actor_dimensions import MODELS, RGB
from osc2tx_runtime.world.protocol import ActorSpec

Library = Mapping[str, Mapping[str, Sequence[str]]]
"""Blueprints of a server: recommended values of their attributes."""

SLOW_STARTER = 2.0  # m/s^2: trucks, buses and bicycles accelerate less
WALKER, CHILD = "walker.pedestrian.0001", "walker.pedestrian.0010"
PROP = "static.prop.box01"


def blueprint_for(spec: ActorSpec, library: Library) -> str:
    """Return the blueprint of an actor: its model, else one of its kind and length.

    Raises:
        SimulatorError: The server has no such blueprint.
    """
    if spec.model is not None:
        if spec.model in library:
            return spec.model
        if spec.model.startswith(("vehicle.", "walker.", "static.")):
            raise SimulatorError(_unknown(spec, library))
    if spec.shape.wheelbase > 0.0:
        return _vehicle_like(spec, library)
    wanted = {"person": WALKER, "animal": CHILD}.get(spec.kind, PROP)
    return _there(wanted, wanted.rpartition(".")[0], library)


def _unknown(spec: ActorSpec, library: Library) -> str:
    assert spec.model is not None
    near = difflib.get_close_matches(spec.model, library, 1)
    hint = f"; did you mean {near[0]}?" if near else ""
    return f"{spec.id}: CARLA has no blueprint {spec.model}{hint}"


def _vehicle_like(spec: ActorSpec, library: Library) -> str:
    """The vehicle whose size is nearest, of the same number of wheels."""
    two_wheels = spec.shape.width < 1.2 and spec.shape.length < 3.0
    known = {
        name: abs(length - spec.shape.length) + abs(width - spec.shape.width)
        for name, (_, length, width, _) in MODELS.items()
        if name in library and name.startswith("vehicle.")
    }
    if two_wheels:
        bikes = sorted(n for n, has in library.items() if has.get("number_of_wheels") == ["2"])
        kind = ["bicycle" if spec.limits.acceleration < SLOW_STARTER else "motorcycle"]
        alike = [each for each in bikes if library[each].get("base_type") == kind]
        if alike or bikes:
            return (alike or bikes)[0]
    if known:
        return min(known, key=lambda name: (known[name], name))
    return _there("vehicle.tesla.model3", "vehicle", library)


def _there(wanted: str, kind: str, library: Library) -> str:
    """A blueprint, or the first of its kind."""
    if wanted in library:
        return wanted
    found = sorted(name for name in library if name.startswith(f"{kind}."))
    if not found:
        raise SimulatorError(f"CARLA has no blueprint {kind}.*")
    return found[0]


def attributes_of(
    spec: ActorSpec, blueprint: Mapping[str, Sequence[str]], role: str
) -> tuple[Mapping[str, str], str | None]:
    """Return the attributes of an actor, and the unsupported requests."""
    attributes, problem = {}, None
    for name in ("role_name", "ros_name"):
        if name in blueprint:
            attributes[name] = role
    if spec.color is not None:
        color = _color(spec.color)
        if color is None or "color" not in blueprint:
            problem = f"{spec.id}: this model cannot be {spec.color}"
        else:
            attributes["color"] = color
    return attributes, problem


def _color(written: str) -> str | None:
    """`255,0,0` for that, for `#ff0000` or `red`."""
    text = written.strip().lower().replace("grey", "gray")
    if text in RGB:
        return ",".join(map(str, RGB[text]))
    try:
        if text.startswith("#") and len(text) == 7:
            return ",".join(str(int(text[i : i + 2], 16)) for i in (1, 3, 5))
        numbers = [int(part) for part in text.split(",")]
    except ValueError:
        return None
    return ",".join(map(str, numbers)) if len(numbers) == 3 else None
