"""What of the capability table holds in CARLA, and how."""

from __future__ import annotations

from collections.abc import Mapping

__all__ = ["IN_CARLA"]

RUNTIME = "by the runtime, on measured states"
MOTION = "exact: poses written; driven: throttle, brake, steering"

IN_CARLA: Mapping[str, str] = {
    "C01": RUNTIME,
    "C02": "role_name and ros_name; blueprint by model, else the nearest in size; color where the"
    " model has one",
    "C03": RUNTIME,
    "C04": RUNTIME,
    "C05": f"{MOTION}; persons by walker control; animals and movable objects exact only (CARLA has"
    " no blueprints that move); trailers exact only (CARLA has no couplings)",
    "C06": MOTION,
    "C07": f"{MOTION}; driven ones follow within what the engine of the model gives",
    "C08": "exact; driven: brake and hand brake",
    "C09": "exact; driven: transform, then target velocity",
    "C10": "exact; driven: transform; pitch and roll last until the wheels settle",
    "C11": f"{MOTION}; driven ones cut corners that are tighter than their look-ahead",
    "C12": f"{MOTION}; driven ones come some tenths of a second late where it asks for jumps",
    "C13": RUNTIME,
    "C14": RUNTIME,
    "C15": RUNTIME,
    "C16": "sun and clouds exact; rain, fog and wind approximated (percentages); snow, temperature,"
    " pressure, humidity and direction of the wind not possible (no field), their effects and"
    " conditions hold; vehicle lights: position, low and high beam exact, daytime as position",
    "C17": "by OpenDRIVE id; red, yellow, green and off exact; red with yellow, flashing lamps and"
    " arrows approximated by one color; a light of the scenario stops the cycles of all",
    "C18": "driven: a friction trigger over the whole map; exact: limits of the runtime",
    "C19": MOTION,
    "C20": MOTION,
    "C21": "by the runtime on the map of the level; defaults from its spawn points",
    "C22": MOTION,
    "C23": "prefer_non_physical: transform and target velocity; else as the mode of the actor",
    "C24": RUNTIME,
    "C25": RUNTIME,
    "C26": "heading as C10; pitch and roll exact only (driven: what the suspension makes of it)",
    "C27": "y, pitch and yaw negated, degrees",
    "C28": RUNTIME,
    "C29": "by the runtime on the map of the level",
    "C30": RUNTIME,
    "C31": RUNTIME,
    "C32": RUNTIME,
    "C33": "own actions command the same slots",
    "C34": RUNTIME,
    "C35": "before the run, as everywhere; blueprints, colors and sizes when it begins",
    "C36": RUNTIME,
    "C37": RUNTIME,
    "C38": RUNTIME,
}
"""How each row does in CARLA. `exact` and `driven` are modes of control (`--control`)."""
