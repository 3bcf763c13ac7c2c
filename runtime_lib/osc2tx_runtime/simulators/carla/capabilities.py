"""Support of the capability table in CARLA."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

RUNTIME = "by the runtime, on measured states"
MOTION = "exact: poses written; driven: throttle, brake, steering"
MAP = "by the runtime on the map of the level"
WEATHER = (
    "elevation of the sun and clouds exact; azimuth of the sun (from a zero of CARLA's own), rain,"
    " fog and wind (percentages) approximated; snow, temperature, pressure, humidity and direction"
    " of the wind not possible (no field), their effects and conditions hold"
)
VEHICLE_LIGHTS = (
    "position, low and high beam exact, daytime as position; brake, turn and reversing lights"
    " by the motion"
)
TRAILERS = "exact only (CARLA has no couplings)"
UNMOVED = "exact only (CARLA has no blueprints that move)"
WALKERS = "walker control"
HEADING = "exact; driven: transform"
PITCH_AND_ROLL = "pitch and roll exact only (driven: by the suspension)"

IN_CARLA: Mapping[str, str] = {
    "C01": RUNTIME,
    "C02": "role_name and ros_name; blueprint by model, else the nearest in size; color where the"
    " model has one",
    "C03": RUNTIME,
    "C04": RUNTIME,
    "C05": f"{MOTION}; persons by {WALKERS}; animals and movable objects {UNMOVED};"
    f" trailers {TRAILERS}",
    "C06": MOTION,
    "C07": f"{MOTION}; driven ones follow within the limits of the engine of the model",
    "C08": "exact; driven: brake and hand brake",
    "C09": "exact; driven: transform, then target velocity",
    "C10": f"{HEADING}; pitch and roll last until the wheels settle",
    "C11": f"{MOTION}; driven ones cut corners that are tighter than their look-ahead",
    "C12": f"{MOTION}; driven ones come some tenths of a second late where it asks for jumps",
    "C13": RUNTIME,
    "C14": RUNTIME,
    "C15": RUNTIME,
    "C16": f"{WEATHER}; vehicle lights: {VEHICLE_LIGHTS}",
    "C17": "by OpenDRIVE id; red, yellow, green and off exact; red with yellow, flashing lamps and"
    " arrows approximated by one color; a light of the scenario stops the cycles of all",
    "C18": "driven: a friction trigger over the whole map; exact: limits of the runtime",
    "C19": MOTION,
    "C20": MOTION,
    "C21": f"{MAP}; defaults from its spawn points",
    "C22": MOTION,
    "C23": "prefer_non_physical: transform and target velocity; else as the mode of the actor",
    "C24": RUNTIME,
    "C25": RUNTIME,
    "C26": f"heading as C10; {PITCH_AND_ROLL}",
    "C27": "y, pitch and yaw negated, degrees",
    "C28": RUNTIME,
    "C29": MAP,
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
"""Support of each row in CARLA. `exact` and `driven` are modes of control (`--control`)."""

# Actions and modifiers whose row, or a part of it, states more than their slots and needs.
_OF = {
    "animal.walk": UNMOVED,
    "assign_orientation": IN_CARLA["C10"],
    "assign_position": IN_CARLA["C09"],
    "follow_path": IN_CARLA["C11"],
    "follow_trajectory": IN_CARLA["C12"],
    "orientation": f"{HEADING}; {PITCH_AND_ROLL}",
    "person.walk": WALKERS,
    "physical_movement": IN_CARLA["C23"],
    "position": IN_CARLA["C21"],
    "remain_stationary": IN_CARLA["C08"],
    "yaw": HEADING,
}
_NEEDING = {
    "lights": VEHICLE_LIGHTS,
    "map": MAP,
    "towing": TRAILERS,
    "traffic_lights": IN_CARLA["C17"],
    "weather": WEATHER,
}


def how(name: str, *, moves: bool, needs: Sequence[str]) -> str:
    """Return the support of an action or modifier in CARLA.

    Args:
        name: `vehicle.drive`, `speed`.
        moves: Whether it controls the motion of an actor, or lets it move.
        needs: Capabilities of a world that it requires, as in its registration.
    """
    own = _OF.get(name) or _OF.get(name.rpartition(".")[2])
    of_needs = next((_NEEDING[need] for need in needs if need in _NEEDING), None)
    return own or of_needs or (MOTION if moves else RUNTIME)
