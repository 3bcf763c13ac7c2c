"""The enumerations of OpenSCENARIO XML, with the literals of all versions.

Made by `tools/make_xosc_elements.py` from `schema.json`: do not edit.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

AngleType: TypeAlias = Literal[
    "heading",
    "pitch",
    "roll",
]

AutomaticGearType: TypeAlias = Literal[
    "d",
    "n",
    "p",
    "r",
]

CloudState: TypeAlias = Literal[
    "cloudy",
    "free",
    "overcast",
    "rainy",
    "skyOff",
]

ColorType: TypeAlias = Literal[
    "black",
    "blue",
    "brown",
    "green",
    "grey",
    "orange",
    "other",
    "red",
    "violet",
    "white",
    "yellow",
]

ConditionEdge: TypeAlias = Literal[
    "falling",
    "none",
    "rising",
    "risingOrFalling",
]

ControllerType: TypeAlias = Literal[
    "all",
    "animation",
    "appearance",
    "lateral",
    "lighting",
    "longitudinal",
    "movement",
]

CoordinateSystem: TypeAlias = Literal[
    "entity",
    "lane",
    "road",
    "trajectory",
    "world",
]

DirectionalDimension: TypeAlias = Literal[
    "lateral",
    "longitudinal",
    "vertical",
]

DynamicsDimension: TypeAlias = Literal[
    "distance",
    "rate",
    "time",
]

DynamicsShape: TypeAlias = Literal[
    "cubic",
    "linear",
    "sinusoidal",
    "step",
]

FollowingMode: TypeAlias = Literal[
    "follow",
    "position",
]

FractionalCloudCover: TypeAlias = Literal[
    "eightOktas",
    "fiveOktas",
    "fourOktas",
    "nineOktas",
    "oneOktas",
    "sevenOktas",
    "sixOktas",
    "threeOktas",
    "twoOktas",
    "zeroOktas",
]

LaneLayerType: TypeAlias = Literal[
    "permanent",
    "temporary",
]

LateralDisplacement: TypeAlias = Literal[
    "any",
    "leftToReferencedEntity",
    "rightToReferencedEntity",
]

LightMode: TypeAlias = Literal[
    "flashing",
    "off",
    "on",
]

LongitudinalDisplacement: TypeAlias = Literal[
    "any",
    "leadingReferencedEntity",
    "trailingReferencedEntity",
]

MiscObjectCategory: TypeAlias = Literal[
    "barrier",
    "building",
    "crosswalk",
    "gantry",
    "none",
    "obstacle",
    "parkingSpace",
    "patch",
    "pole",
    "railing",
    "roadMark",
    "soundBarrier",
    "streetLamp",
    "trafficIsland",
    "tree",
    "vegetation",
    "wind",
]

ObjectType: TypeAlias = Literal[
    "external",
    "miscellaneous",
    "pedestrian",
    "vehicle",
]

ParameterType: TypeAlias = Literal[
    "boolean",
    "dateTime",
    "double",
    "int",
    "integer",
    "string",
    "unsignedInt",
    "unsignedShort",
]

PedestrianCategory: TypeAlias = Literal[
    "animal",
    "pedestrian",
    "wheelchair",
]

PedestrianGestureType: TypeAlias = Literal[
    "coffeeLeftHand",
    "coffeeRightHand",
    "crossArms",
    "phoneCallLeftHand",
    "phoneCallRightHand",
    "phoneTextLeftHand",
    "phoneTextRightHand",
    "sandwichLeftHand",
    "sandwichRightHand",
    "umbrellaLeftHand",
    "umbrellaRightHand",
    "wavingLeftArm",
    "wavingRightArm",
]

PedestrianMotionType: TypeAlias = Literal[
    "bendingDown",
    "crawling",
    "cycling",
    "ducking",
    "jumping",
    "lying",
    "reeling",
    "running",
    "sitting",
    "squatting",
    "standing",
    "walking",
]

PrecipitationType: TypeAlias = Literal[
    "dry",
    "rain",
    "snow",
]

Priority: TypeAlias = Literal[
    "override",
    "overwrite",
    "parallel",
    "skip",
]

ReferenceContext: TypeAlias = Literal[
    "absolute",
    "relative",
]

RelativeDistanceType: TypeAlias = Literal[
    "cartesianDistance",
    "euclidianDistance",
    "lateral",
    "longitudinal",
]

Role: TypeAlias = Literal[
    "agriculture",
    "ambulance",
    "civil",
    "construction",
    "dangerousGoodsTransport",
    "fire",
    "fireBrigade",
    "freightTransport",
    "garbageCollection",
    "military",
    "none",
    "other",
    "police",
    "publicTransport",
    "roadAssistance",
    "roadsideAssistance",
    "specialTransport",
    "trafficControl",
]

RouteStrategy: TypeAlias = Literal[
    "fastest",
    "leastIntersections",
    "random",
    "shortest",
]

RoutingAlgorithm: TypeAlias = Literal[
    "assignedRoute",
    "fastest",
    "leastIntersections",
    "shortest",
    "undefined",
]

Rule: TypeAlias = Literal[
    "equalTo",
    "greaterOrEqual",
    "greaterThan",
    "lessOrEqual",
    "lessThan",
    "notEqualTo",
]

SpeedTargetValueType: TypeAlias = Literal[
    "delta",
    "factor",
]

StoryboardElementState: TypeAlias = Literal[
    "completeState",
    "endTransition",
    "runningState",
    "skipTransition",
    "standbyState",
    "startTransition",
    "stopTransition",
]

StoryboardElementType: TypeAlias = Literal[
    "act",
    "action",
    "event",
    "maneuver",
    "maneuverGroup",
    "story",
]

TrafficSignalSemantics: TypeAlias = Literal[
    "attention_go",
    "attention_stop",
    "caution",
    "fallback",
    "go",
    "stop",
]

TriggeringEntitiesRule: TypeAlias = Literal[
    "all",
    "any",
]

VehicleCategory: TypeAlias = Literal[
    "aircraft",
    "bicycle",
    "bus",
    "car",
    "heavyTruck",
    "landVehicle",
    "micromobilityDevice",
    "motorbike",
    "motorcycle",
    "other",
    "semitractor",
    "semitrailer",
    "standupScooter",
    "trailer",
    "train",
    "tram",
    "truck",
    "van",
    "watercraft",
    "wheelchair",
    "workMachine",
]

VehicleComponentType: TypeAlias = Literal[
    "doorFrontLeft",
    "doorFrontRight",
    "doorRearLeft",
    "doorRearRight",
    "hood",
    "sideMirrorLeft",
    "sideMirrorRight",
    "sideMirrors",
    "trunk",
    "windowFrontLeft",
    "windowFrontRight",
    "windowRearLeft",
    "windowRearRight",
]

VehicleLightType: TypeAlias = Literal[
    "brakeLights",
    "daytimeRunningLights",
    "fogLights",
    "fogLightsFront",
    "fogLightsRear",
    "highBeam",
    "indicatorLeft",
    "indicatorRight",
    "licensePlateIllumination",
    "lowBeam",
    "reversingLights",
    "specialPurposeLights",
    "tailLights",
    "warningLights",
]

Wetness: TypeAlias = Literal[
    "dry",
    "highFlooded",
    "lowFlooded",
    "moist",
    "wetWithPuddles",
]
