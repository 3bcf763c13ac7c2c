"""What the backend knows of the runtime library, as tables.

The compiler does not import the runtime; a test compares these tables with the real thing.
"""

from __future__ import annotations

API_LEVEL = 1

# Actor type of the standard library -> class of the runtime.
ACTOR_CLASSES = {
    "animal": "Animal",
    "environment": "Environment",
    "map": "Map",
    "movable_object": "MovableObject",
    "person": "Person",
    "physical_object": "PhysicalObject",
    "stationary_object": "StationaryObject",
    "traffic_light_controller": "TrafficLightController",
    "traffic_participant": "TrafficParticipant",
    "trailer": "Trailer",
    "vehicle": "Vehicle",
}

# Struct type of the standard library -> value class of the runtime.
STRUCT_CLASSES = {
    "orientation_3d": "Orientation",
    "pose_3d": "Pose",
    "position_3d": "Point",
}
