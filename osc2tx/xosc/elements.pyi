"""Made by `tools/make_xosc_elements.py` from `schema.json`: do not edit."""

from typing import Final, TypeAlias

from osc2tx.xosc import literals
from osc2tx.xosc.element import Element as Base

def class_of(tag: str) -> type[Base]: ...

AbsoluteSpeedPart: TypeAlias = TargetDistanceSteadyState | TargetTimeSteadyState

class AbsoluteSpeed(Base):
    def __init__(
        self,
        *children: AbsoluteSpeedPart | None,
        value: float,
    ) -> None: ...
    value: Final[float]  # m/s

class AbsoluteTargetLane(Base):
    def __init__(
        self,
        *,
        value: str | float,
        layer: literals.LaneLayerType | None = None,
    ) -> None: ...
    value: Final[str]
    layer: Final[literals.LaneLayerType | None]  # since 1.4

class AbsoluteTargetLaneOffset(Base):
    def __init__(
        self,
        *,
        value: float,
    ) -> None: ...
    value: Final[float]  # m

class AbsoluteTargetSpeed(Base):
    def __init__(
        self,
        *,
        value: float,
    ) -> None: ...
    value: Final[float]  # m/s

class AccelerationCondition(Base):
    def __init__(
        self,
        *,
        rule: literals.Rule,
        value: float,
        direction: literals.DirectionalDimension | None = None,
    ) -> None: ...
    rule: Final[literals.Rule]
    value: Final[float]  # m/s²
    direction: Final[literals.DirectionalDimension | None]  # since 1.2

class AcquirePositionAction(Base):
    def __init__(
        self,
        *children: Position | None,
    ) -> None: ...

ActPart: TypeAlias = ManeuverGroup | StartTrigger | StopTrigger

class Act(Base):
    def __init__(
        self,
        *children: ActPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

ActionPart: TypeAlias = GlobalAction | PrivateAction | UserDefinedAction

class Action(Base):
    def __init__(
        self,
        *children: ActionPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

ActionsPart: TypeAlias = GlobalAction | Private | UserDefinedAction

class Actions(Base):
    def __init__(
        self,
        *children: ActionsPart | None,
    ) -> None: ...

class ActivateControllerAction(Base):
    def __init__(
        self,
        *,
        lateral: bool | None = None,
        longitudinal: bool | None = None,
        controllerRef: str | float | None = None,
        animation: bool | None = None,
        lighting: bool | None = None,
        objectControllerRef: str | float | None = None,
    ) -> None: ...
    lateral: Final[bool | None]
    longitudinal: Final[bool | None]
    controllerRef: Final[str | None]  # since 1.2, deprecated since 1.3
    animation: Final[bool | None]  # since 1.2
    lighting: Final[bool | None]  # since 1.2
    objectControllerRef: Final[str | None]  # since 1.3

class Actors(Base):
    def __init__(
        self,
        *children: EntityRef | None,
        selectTriggeringEntities: bool,
    ) -> None: ...
    selectTriggeringEntities: Final[bool]

class AddEntityAction(Base):
    def __init__(
        self,
        *children: Position | None,
    ) -> None: ...

class AddValue(Base):
    def __init__(
        self,
        *,
        value: float,
    ) -> None: ...
    value: Final[float]  # since 1.2

class AdditionalAxle(Base):
    def __init__(
        self,
        *,
        maxSteering: float,
        positionX: float,
        positionZ: float,
        trackWidth: float,
        wheelDiameter: float,
    ) -> None: ...
    maxSteering: Final[float]  # rad
    positionX: Final[float]  # m
    positionZ: Final[float]  # m
    trackWidth: Final[float]  # m
    wheelDiameter: Final[float]  # m

class AngleCondition(Base):
    def __init__(
        self,
        *,
        angleType: literals.AngleType,
        angle: float,
        angleTolerance: float,
        coordinateSystem: literals.CoordinateSystem | None = None,
    ) -> None: ...
    angleType: Final[literals.AngleType]  # since 1.3
    angle: Final[float]  # rad, since 1.3
    angleTolerance: Final[float]  # rad, since 1.3
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.3, by default world

AnimationActionPart: TypeAlias = AnimationState | AnimationType

class AnimationAction(Base):
    def __init__(
        self,
        *children: AnimationActionPart | None,
        loop: bool | None = None,
        animationDuration: float | None = None,
    ) -> None: ...
    loop: Final[bool]  # since 1.2, by default false
    animationDuration: Final[float | None]  # s, since 1.2

class AnimationFile(Base):
    def __init__(
        self,
        *children: File | None,
        timeOffset: float | None = None,
    ) -> None: ...
    timeOffset: Final[float]  # s, since 1.2, by default 0

class AnimationState(Base):
    def __init__(
        self,
        *,
        state: float,
    ) -> None: ...
    state: Final[float]  # since 1.2

AnimationTypePart: TypeAlias = (
    AnimationFile | ComponentAnimation | PedestrianAnimation | UserDefinedAnimation
)

class AnimationType(Base):
    def __init__(
        self,
        *children: AnimationTypePart | None,
    ) -> None: ...

AppearanceActionPart: TypeAlias = AnimationAction | LightStateAction

class AppearanceAction(Base):
    def __init__(
        self,
        *children: AppearanceActionPart | None,
    ) -> None: ...

AssignControllerActionPart: TypeAlias = CatalogReference | Controller | ObjectController

class AssignControllerAction(Base):
    def __init__(
        self,
        *children: AssignControllerActionPart | None,
        activateLateral: bool | None = None,
        activateLongitudinal: bool | None = None,
        activateAnimation: bool | None = None,
        activateLighting: bool | None = None,
    ) -> None: ...
    activateLateral: Final[bool | None]  # since 1.1
    activateLongitudinal: Final[bool | None]  # since 1.1
    activateAnimation: Final[bool | None]  # since 1.2
    activateLighting: Final[bool | None]  # since 1.2

AssignRouteActionPart: TypeAlias = CatalogReference | Route

class AssignRouteAction(Base):
    def __init__(
        self,
        *children: AssignRouteActionPart | None,
    ) -> None: ...

class AutomaticGear(Base):
    def __init__(
        self,
        *,
        gear: literals.AutomaticGearType,
    ) -> None: ...
    gear: Final[literals.AutomaticGearType]  # since 1.2

AxlesPart: TypeAlias = AdditionalAxle | FrontAxle | RearAxle

class Axles(Base):
    def __init__(
        self,
        *children: AxlesPart | None,
    ) -> None: ...

class Bin(Base):
    def __init__(
        self,
        *children: Range | None,
        weight: float,
    ) -> None: ...
    weight: Final[float]  # since 1.1

BoundingBoxPart: TypeAlias = Center | Dimensions

class BoundingBox(Base):
    def __init__(
        self,
        *children: BoundingBoxPart | None,
    ) -> None: ...

BrakePart: TypeAlias = BrakeForce | BrakePercent

class Brake(Base):
    def __init__(
        self,
        *children: BrakePart | None,
        active: bool,
        value: float | None = None,
    ) -> None: ...
    active: Final[bool]
    value: Final[float | None]  # deprecated since 1.2

class BrakeForce(Base):
    def __init__(
        self,
        *,
        value: float,
        maxRate: float | None = None,
    ) -> None: ...
    value: Final[float]  # %, since 1.2
    maxRate: Final[float | None]  # %/s, since 1.2

class BrakePercent(Base):
    def __init__(
        self,
        *,
        value: float,
        maxRate: float | None = None,
    ) -> None: ...
    value: Final[float]  # %, since 1.2
    maxRate: Final[float | None]  # %/s, since 1.2

ByEntityConditionPart: TypeAlias = EntityCondition | TriggeringEntities

class ByEntityCondition(Base):
    def __init__(
        self,
        *children: ByEntityConditionPart | None,
    ) -> None: ...

class ByType(Base):
    def __init__(
        self,
        *,
        type: literals.ObjectType | None = None,
        objectType: literals.ObjectType | None = None,
    ) -> None: ...
    type: Final[literals.ObjectType | None]
    objectType: Final[literals.ObjectType | None]

ByValueConditionPart: TypeAlias = (
    ParameterCondition
    | SimulationTimeCondition
    | StoryboardElementStateCondition
    | TimeOfDayCondition
    | TrafficSignalCondition
    | TrafficSignalControllerCondition
    | UserDefinedValueCondition
    | VariableCondition
)

class ByValueCondition(Base):
    def __init__(
        self,
        *children: ByValueConditionPart | None,
    ) -> None: ...

CatalogPart: TypeAlias = (
    Controller
    | Environment
    | Maneuver
    | MiscObject
    | Pedestrian
    | Route
    | TrafficDistributionEntry
    | Trajectory
    | Vehicle
)

class Catalog(Base):
    def __init__(
        self,
        *children: CatalogPart | None,
        name: str | None = None,
    ) -> None: ...
    name: Final[str | None]

CatalogLocationsPart: TypeAlias = (
    ControllerCatalog
    | EnvironmentCatalog
    | ManeuverCatalog
    | MiscObjectCatalog
    | PedestrianCatalog
    | RouteCatalog
    | TrafficDistributionEntryCatalog
    | TrajectoryCatalog
    | VehicleCatalog
)

class CatalogLocations(Base):
    def __init__(
        self,
        *children: CatalogLocationsPart | None,
    ) -> None: ...

class CatalogReference(Base):
    def __init__(
        self,
        *children: ParameterAssignments | None,
        catalogName: str | float,
        entryName: str | float,
    ) -> None: ...
    catalogName: Final[str]
    entryName: Final[str]

class CatalogReferences(Base):
    def __init__(
        self,
        *children: ParameterAssignments | None,
        catalogName: str | float,
        entryName: str | float,
    ) -> None: ...
    catalogName: Final[str]
    entryName: Final[str]

class Center(Base):
    def __init__(
        self,
        *,
        x: float,
        y: float,
        z: float,
    ) -> None: ...
    x: Final[float]  # m
    y: Final[float]  # m
    z: Final[float]  # m

class CentralObject(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
    ) -> None: ...
    entityRef: Final[str]

ClothoidPart: TypeAlias = MotionEnd | MotionStart | Position

class Clothoid(Base):
    def __init__(
        self,
        *children: ClothoidPart | None,
        curvature: float,
        curvatureDot: float | None = None,
        length: float,
        startTime: float | None = None,
        stopTime: float | None = None,
        curvaturePrime: float | None = None,
    ) -> None: ...
    curvature: Final[float]  # 1/m
    curvatureDot: Final[float | None]  # 1/s, deprecated since 1.1
    length: Final[float]  # m
    startTime: Final[float | None]  # s
    stopTime: Final[float | None]  # s
    curvaturePrime: Final[float | None]  # 1/m², since 1.1

ClothoidSplinePart: TypeAlias = ClothoidSplineSegment | MotionEnd

class ClothoidSpline(Base):
    def __init__(
        self,
        *children: ClothoidSplinePart | None,
        timeEnd: float | None = None,
    ) -> None: ...
    timeEnd: Final[float | None]  # s, since 1.3

ClothoidSplineSegmentPart: TypeAlias = MotionStart | PositionStart

class ClothoidSplineSegment(Base):
    def __init__(
        self,
        *children: ClothoidSplineSegmentPart | None,
        curvatureStart: float,
        curvatureEnd: float,
        length: float,
        hOffset: float | None = None,
        timeStart: float | None = None,
    ) -> None: ...
    curvatureStart: Final[float]  # 1/m, since 1.3
    curvatureEnd: Final[float]  # 1/m, since 1.3
    length: Final[float]  # m, since 1.3
    hOffset: Final[float | None]  # rad, since 1.3
    timeStart: Final[float | None]  # s, since 1.3

class Clutch(Base):
    def __init__(
        self,
        *,
        active: bool,
        value: float,
        maxRate: float | None = None,
    ) -> None: ...
    active: Final[bool]
    value: Final[float]
    maxRate: Final[float | None]  # %/s, since 1.2

CollisionConditionPart: TypeAlias = ByType | EntityRef

class CollisionCondition(Base):
    def __init__(
        self,
        *children: CollisionConditionPart | None,
    ) -> None: ...

ColorPart: TypeAlias = ColorCmyk | ColorRgb

class Color(Base):
    def __init__(
        self,
        *children: ColorPart | None,
        colorType: literals.ColorType,
    ) -> None: ...
    colorType: Final[literals.ColorType]  # since 1.2

class ColorCmyk(Base):
    def __init__(
        self,
        *,
        cyan: float,
        magenta: float,
        yellow: float,
        key: float,
    ) -> None: ...
    cyan: Final[float]  # since 1.2
    magenta: Final[float]  # since 1.2
    yellow: Final[float]  # since 1.2
    key: Final[float]  # since 1.2

class ColorRgb(Base):
    def __init__(
        self,
        *,
        red: float,
        green: float,
        blue: float,
    ) -> None: ...
    red: Final[float]  # since 1.2
    green: Final[float]  # since 1.2
    blue: Final[float]  # since 1.2

ComponentAnimationPart: TypeAlias = UserDefinedComponent | VehicleComponent

class ComponentAnimation(Base):
    def __init__(
        self,
        *children: ComponentAnimationPart | None,
    ) -> None: ...

ConditionPart: TypeAlias = ByEntityCondition | ByValueCondition

class Condition(Base):
    def __init__(
        self,
        *children: ConditionPart | None,
        conditionEdge: literals.ConditionEdge,
        delay: float,
        name: str,
    ) -> None: ...
    conditionEdge: Final[literals.ConditionEdge]
    delay: Final[float]  # s, by default 0
    name: Final[str]

class ConditionGroup(Base):
    def __init__(
        self,
        *children: Condition | None,
    ) -> None: ...

class ConnectTrailerAction(Base):
    def __init__(
        self,
        *,
        trailerRef: str | float,
    ) -> None: ...
    trailerRef: Final[str]  # since 1.3

class ConstraintGroup(Base):
    def __init__(
        self,
        *children: ValueConstraint | None,
    ) -> None: ...

class ControlPoint(Base):
    def __init__(
        self,
        *children: Position | None,
        time: float | None = None,
        weight: float | None = None,
    ) -> None: ...
    time: Final[float | None]  # s
    weight: Final[float | None]

ControllerPart: TypeAlias = ParameterDeclarations | Properties

class Controller(Base):
    def __init__(
        self,
        *children: ControllerPart | None,
        name: str,
        controllerType: literals.ControllerType | None = None,
    ) -> None: ...
    name: Final[str]
    controllerType: Final[literals.ControllerType]  # since 1.2, by default movement

ControllerActionPart: TypeAlias = (
    ActivateControllerAction | AssignControllerAction | OverrideControllerValueAction
)

class ControllerAction(Base):
    def __init__(
        self,
        *children: ControllerActionPart | None,
    ) -> None: ...

class ControllerCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

class ControllerDistribution(Base):
    def __init__(
        self,
        *children: ControllerDistributionEntry | None,
    ) -> None: ...

ControllerDistributionEntryPart: TypeAlias = CatalogReference | Controller

class ControllerDistributionEntry(Base):
    def __init__(
        self,
        *children: ControllerDistributionEntryPart | None,
        weight: float,
    ) -> None: ...
    weight: Final[float]

class CustomCommandAction(Base):
    def __init__(
        self,
        *,
        text: str | None = None,
        type: str | float,
    ) -> None: ...
    type: Final[str]

class CustomContent(Base):
    def __init__(
        self,
        *,
        text: str | None = None,
    ) -> None: ...

class DeleteEntityAction(Base):
    def __init__(
        self,
    ) -> None: ...

DeterministicPart: TypeAlias = (
    DeterministicMultiParameterDistribution | DeterministicSingleParameterDistribution
)

class Deterministic(Base):
    def __init__(
        self,
        *children: DeterministicPart | None,
    ) -> None: ...

class DeterministicMultiParameterDistribution(Base):
    def __init__(
        self,
        *children: ValueSetDistribution | None,
    ) -> None: ...

DeterministicSingleParameterDistributionPart: TypeAlias = (
    DistributionRange | DistributionSet | UserDefinedDistribution
)

class DeterministicSingleParameterDistribution(Base):
    def __init__(
        self,
        *children: DeterministicSingleParameterDistributionPart | None,
        parameterName: str | float,
    ) -> None: ...
    parameterName: Final[str]  # since 1.1

class Dimensions(Base):
    def __init__(
        self,
        *,
        height: float,
        length: float,
        width: float,
    ) -> None: ...
    height: Final[float]  # m
    length: Final[float]  # m
    width: Final[float]  # m

class DirectionOfTravelDistribution(Base):
    def __init__(
        self,
        *,
        same: float,
        opposite: float,
    ) -> None: ...
    same: Final[float]  # since 1.2
    opposite: Final[float]  # since 1.2

class Directory(Base):
    def __init__(
        self,
        *,
        path: str | float,
    ) -> None: ...
    path: Final[str]

class DisconnectTrailerAction(Base):
    def __init__(
        self,
    ) -> None: ...

class DistanceCondition(Base):
    def __init__(
        self,
        *children: Position | None,
        alongRoute: bool | None = None,
        freespace: bool,
        rule: literals.Rule,
        value: float,
        coordinateSystem: literals.CoordinateSystem | None = None,
        relativeDistanceType: literals.RelativeDistanceType | None = None,
        routingAlgorithm: literals.RoutingAlgorithm | None = None,
    ) -> None: ...
    alongRoute: Final[bool | None]  # deprecated since 1.1
    freespace: Final[bool]
    rule: Final[literals.Rule]
    value: Final[float]  # m
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.1, by default entity
    relativeDistanceType: Final[
        literals.RelativeDistanceType
    ]  # since 1.1, by default euclidianDistance
    routingAlgorithm: Final[literals.RoutingAlgorithm]  # since 1.2, by default undefined

class DistributionRange(Base):
    def __init__(
        self,
        *children: Range | None,
        stepWidth: float,
    ) -> None: ...
    stepWidth: Final[float]  # since 1.1

class DistributionSet(Base):
    def __init__(
        self,
        *children: Element | None,
    ) -> None: ...

class DomeFile(Base):
    def __init__(
        self,
        *,
        filepath: str | float,
    ) -> None: ...
    filepath: Final[str]

class DomeImage(Base):
    def __init__(
        self,
        *children: DomeFile | None,
        azimuthOffset: float | None = None,
    ) -> None: ...
    azimuthOffset: Final[float]  # rad, since 1.2, by default 0

class DynamicConstraints(Base):
    def __init__(
        self,
        *,
        maxAcceleration: float | None = None,
        maxDeceleration: float | None = None,
        maxSpeed: float | None = None,
        maxAccelerationRate: float | None = None,
        maxDecelerationRate: float | None = None,
    ) -> None: ...
    maxAcceleration: Final[float | None]  # m/s²
    maxDeceleration: Final[float | None]  # m/s²
    maxSpeed: Final[float | None]  # m/s
    maxAccelerationRate: Final[float | None]  # m/s³, since 1.2
    maxDecelerationRate: Final[float | None]  # m/s³, since 1.2

class Element(Base):
    def __init__(
        self,
        *,
        value: str | float,
        weight: float | None = None,
    ) -> None: ...
    value: Final[str]  # since 1.1
    weight: Final[float | None]  # since 1.1

class EndOfRoadCondition(Base):
    def __init__(
        self,
        *,
        duration: float,
    ) -> None: ...
    duration: Final[float]  # s

EntitiesPart: TypeAlias = EntitySelection | ScenarioObject

class Entities(Base):
    def __init__(
        self,
        *children: EntitiesPart | None,
    ) -> None: ...

EntityActionPart: TypeAlias = AddEntityAction | DeleteEntityAction

class EntityAction(Base):
    def __init__(
        self,
        *children: EntityActionPart | None,
        entityRef: str | float,
    ) -> None: ...
    entityRef: Final[str]

EntityConditionPart: TypeAlias = (
    AccelerationCondition
    | AngleCondition
    | CollisionCondition
    | DistanceCondition
    | EndOfRoadCondition
    | OffroadCondition
    | ReachPositionCondition
    | RelativeAngleCondition
    | RelativeClearanceCondition
    | RelativeDistanceCondition
    | RelativeSpeedCondition
    | SpeedCondition
    | StandStillCondition
    | TimeHeadwayCondition
    | TimeToCollisionCondition
    | TraveledDistanceCondition
)

class EntityCondition(Base):
    def __init__(
        self,
        *children: EntityConditionPart | None,
    ) -> None: ...

class EntityDistribution(Base):
    def __init__(
        self,
        *children: EntityDistributionEntry | None,
    ) -> None: ...

class EntityDistributionEntry(Base):
    def __init__(
        self,
        *children: ScenarioObjectTemplate | None,
        weight: float,
    ) -> None: ...
    weight: Final[float]  # since 1.3

class EntityRef(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
    ) -> None: ...
    entityRef: Final[str]

class EntitySelection(Base):
    def __init__(
        self,
        *children: Members | None,
        name: str,
    ) -> None: ...
    name: Final[str]

EnvironmentPart: TypeAlias = ParameterDeclarations | RoadCondition | TimeOfDay | Weather

class Environment(Base):
    def __init__(
        self,
        *children: EnvironmentPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

EnvironmentActionPart: TypeAlias = CatalogReference | Environment

class EnvironmentAction(Base):
    def __init__(
        self,
        *children: EnvironmentActionPart | None,
    ) -> None: ...

class EnvironmentCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

EventPart: TypeAlias = Action | StartTrigger

class Event(Base):
    def __init__(
        self,
        *children: EventPart | None,
        maximumExecutionCount: int | None = None,
        name: str,
        priority: literals.Priority,
    ) -> None: ...
    maximumExecutionCount: Final[int]  # by default 1
    name: Final[str]
    priority: Final[literals.Priority]

class ExternalObjectReference(Base):
    def __init__(
        self,
        *,
        name: str,
    ) -> None: ...
    name: Final[str]  # since 1.1

class File(Base):
    def __init__(
        self,
        *,
        filepath: str | float,
    ) -> None: ...
    filepath: Final[str]

FileHeaderPart: TypeAlias = License | Properties

class FileHeader(Base):
    def __init__(
        self,
        *children: FileHeaderPart | None,
        author: str | float,
        date: str,
        description: str | float,
        revMajor: int,
        revMinor: int,
    ) -> None: ...
    author: Final[str]
    date: Final[str]
    description: Final[str]
    revMajor: Final[int]
    revMinor: Final[int]

FinalSpeedPart: TypeAlias = AbsoluteSpeed | RelativeSpeedToMaster

class FinalSpeed(Base):
    def __init__(
        self,
        *children: FinalSpeedPart | None,
    ) -> None: ...

class Fog(Base):
    def __init__(
        self,
        *children: BoundingBox | None,
        visualRange: float,
    ) -> None: ...
    visualRange: Final[float]  # m

FollowTrajectoryActionPart: TypeAlias = (
    CatalogReference | TimeReference | Trajectory | TrajectoryFollowingMode | TrajectoryRef
)

class FollowTrajectoryAction(Base):
    def __init__(
        self,
        *children: FollowTrajectoryActionPart | None,
        initialDistanceOffset: float | None = None,
    ) -> None: ...
    initialDistanceOffset: Final[float | None]  # m, since 1.1

class FromCurrentEntity(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
    ) -> None: ...
    entityRef: Final[str]

class FromLaneCoordinates(Base):
    def __init__(
        self,
        *,
        laneId: str | float,
        laneOffset: float | None = None,
        pathS: float,
    ) -> None: ...
    laneId: Final[str]
    laneOffset: Final[float | None]  # m
    pathS: Final[float]  # m

class FromRoadCoordinates(Base):
    def __init__(
        self,
        *,
        pathS: float,
        t: float,
    ) -> None: ...
    pathS: Final[float]  # m
    t: Final[float]  # m

class FrontAxle(Base):
    def __init__(
        self,
        *,
        maxSteering: float,
        positionX: float,
        positionZ: float,
        trackWidth: float,
        wheelDiameter: float,
    ) -> None: ...
    maxSteering: Final[float]  # rad
    positionX: Final[float]  # m
    positionZ: Final[float]  # m
    trackWidth: Final[float]  # m
    wheelDiameter: Final[float]  # m

GearPart: TypeAlias = AutomaticGear | ManualGear

class Gear(Base):
    def __init__(
        self,
        *children: GearPart | None,
        active: bool,
        number: float | None = None,
    ) -> None: ...
    active: Final[bool]
    number: Final[float | None]  # deprecated since 1.2

class GeoPosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        latitude: float | None = None,
        longitude: float | None = None,
        height: float | None = None,
        latitudeDeg: float | None = None,
        longitudeDeg: float | None = None,
        altitude: float | None = None,
        verticalRoadSelection: int | None = None,
    ) -> None: ...
    latitude: Final[float | None]  # rad, since 1.1, deprecated since 1.2
    longitude: Final[float | None]  # rad, since 1.1, deprecated since 1.2
    height: Final[float | None]  # m, since 1.1, deprecated since 1.2
    latitudeDeg: Final[float | None]  # °, since 1.2
    longitudeDeg: Final[float | None]  # °, since 1.2
    altitude: Final[float | None]  # m, since 1.2
    verticalRoadSelection: Final[int | None]  # since 1.3

GlobalActionPart: TypeAlias = (
    EntityAction
    | EnvironmentAction
    | InfrastructureAction
    | ParameterAction
    | SetMonitorAction
    | TrafficAction
    | VariableAction
)

class GlobalAction(Base):
    def __init__(
        self,
        *children: GlobalActionPart | None,
    ) -> None: ...

class Histogram(Base):
    def __init__(
        self,
        *children: Bin | None,
    ) -> None: ...

InRoutePositionPart: TypeAlias = FromCurrentEntity | FromLaneCoordinates | FromRoadCoordinates

class InRoutePosition(Base):
    def __init__(
        self,
        *children: InRoutePositionPart | None,
    ) -> None: ...

class InfrastructureAction(Base):
    def __init__(
        self,
        *children: TrafficSignalAction | None,
    ) -> None: ...

class Init(Base):
    def __init__(
        self,
        *children: Actions | None,
    ) -> None: ...

class InitialSpeedRange(Base):
    def __init__(
        self,
        *,
        lowerLimit: float,
        upperLimit: float,
    ) -> None: ...
    lowerLimit: Final[float]  # since 1.1
    upperLimit: Final[float]  # since 1.1

class Interpolation(Base):
    def __init__(
        self,
    ) -> None: ...

class Knot(Base):
    def __init__(
        self,
        *,
        value: float,
    ) -> None: ...
    value: Final[float]

class Lane(Base):
    def __init__(
        self,
        *,
        id: int,
    ) -> None: ...
    id: Final[int]  # since 1.3

LaneChangeActionPart: TypeAlias = LaneChangeActionDynamics | LaneChangeTarget

class LaneChangeAction(Base):
    def __init__(
        self,
        *children: LaneChangeActionPart | None,
        targetLaneOffset: float | None = None,
    ) -> None: ...
    targetLaneOffset: Final[float | None]  # m

class LaneChangeActionDynamics(Base):
    def __init__(
        self,
        *,
        dynamicsDimension: literals.DynamicsDimension,
        dynamicsShape: literals.DynamicsShape,
        value: float,
        followingMode: literals.FollowingMode | None = None,
    ) -> None: ...
    dynamicsDimension: Final[literals.DynamicsDimension]
    dynamicsShape: Final[literals.DynamicsShape]
    value: Final[float]
    followingMode: Final[literals.FollowingMode]  # since 1.2, by default position

LaneChangeTargetPart: TypeAlias = AbsoluteTargetLane | RelativeTargetLane

class LaneChangeTarget(Base):
    def __init__(
        self,
        *children: LaneChangeTargetPart | None,
    ) -> None: ...

LaneOffsetActionPart: TypeAlias = LaneOffsetActionDynamics | LaneOffsetTarget

class LaneOffsetAction(Base):
    def __init__(
        self,
        *children: LaneOffsetActionPart | None,
        continuous: bool,
    ) -> None: ...
    continuous: Final[bool]

class LaneOffsetActionDynamics(Base):
    def __init__(
        self,
        *,
        dynamicsShape: literals.DynamicsShape,
        maxLateralAcc: float | None = None,
    ) -> None: ...
    dynamicsShape: Final[literals.DynamicsShape]
    maxLateralAcc: Final[float | None]  # m/s²

LaneOffsetTargetPart: TypeAlias = AbsoluteTargetLaneOffset | RelativeTargetLaneOffset

class LaneOffsetTarget(Base):
    def __init__(
        self,
        *children: LaneOffsetTargetPart | None,
    ) -> None: ...

class LanePosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        laneId: str | float,
        offset: float | None = None,
        roadId: str | float,
        s: float,
        layer: literals.LaneLayerType | None = None,
    ) -> None: ...
    laneId: Final[str]
    offset: Final[float]  # m, by default 0
    roadId: Final[str]
    s: Final[float]  # m
    layer: Final[literals.LaneLayerType]  # since 1.4, by default temporary

LateralActionPart: TypeAlias = LaneChangeAction | LaneOffsetAction | LateralDistanceAction

class LateralAction(Base):
    def __init__(
        self,
        *children: LateralActionPart | None,
    ) -> None: ...

class LateralDistanceAction(Base):
    def __init__(
        self,
        *children: DynamicConstraints | None,
        entityRef: str | float,
        continuous: bool,
        distance: float | None = None,
        freespace: bool,
        displacement: literals.LateralDisplacement | None = None,
        coordinateSystem: literals.CoordinateSystem | None = None,
    ) -> None: ...
    entityRef: Final[str]
    continuous: Final[bool]
    distance: Final[float | None]  # m
    freespace: Final[bool]
    displacement: Final[literals.LateralDisplacement | None]  # since 1.1
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.1, by default entity

class License(Base):
    def __init__(
        self,
        *,
        text: str | None = None,
        name: str,
        resource: str | float | None = None,
        spdxId: str | float | None = None,
    ) -> None: ...
    name: Final[str]  # since 1.1
    resource: Final[str | None]  # since 1.1
    spdxId: Final[str | None]  # since 1.1

class LightState(Base):
    def __init__(
        self,
        *children: Color | None,
        mode: literals.LightMode,
        luminousIntensity: float | None = None,
        flashingOnDuration: float | None = None,
        flashingOffDuration: float | None = None,
    ) -> None: ...
    mode: Final[literals.LightMode]  # since 1.2
    luminousIntensity: Final[float | None]  # cd, since 1.2
    flashingOnDuration: Final[float]  # s, since 1.2, by default 0
    flashingOffDuration: Final[float]  # s, since 1.2, by default 0

LightStateActionPart: TypeAlias = LightState | LightType

class LightStateAction(Base):
    def __init__(
        self,
        *children: LightStateActionPart | None,
        transitionTime: float | None = None,
    ) -> None: ...
    transitionTime: Final[float]  # s, since 1.2, by default 0

LightTypePart: TypeAlias = UserDefinedLight | VehicleLight

class LightType(Base):
    def __init__(
        self,
        *children: LightTypePart | None,
    ) -> None: ...

class LogNormalDistribution(Base):
    def __init__(
        self,
        *children: Range | None,
        expectedValue: float,
        variance: float,
    ) -> None: ...
    expectedValue: Final[float]  # since 1.3
    variance: Final[float]  # since 1.3

class LogicFile(Base):
    def __init__(
        self,
        *,
        filepath: str | float,
    ) -> None: ...
    filepath: Final[str]

LongitudinalActionPart: TypeAlias = LongitudinalDistanceAction | SpeedAction | SpeedProfileAction

class LongitudinalAction(Base):
    def __init__(
        self,
        *children: LongitudinalActionPart | None,
    ) -> None: ...

class LongitudinalDistanceAction(Base):
    def __init__(
        self,
        *children: DynamicConstraints | None,
        entityRef: str | float,
        continuous: bool,
        distance: float | None = None,
        freespace: bool,
        timeGap: float | None = None,
        displacement: literals.LongitudinalDisplacement | None = None,
        coordinateSystem: literals.CoordinateSystem | None = None,
    ) -> None: ...
    entityRef: Final[str]
    continuous: Final[bool]
    distance: Final[float | None]  # m
    freespace: Final[bool]
    timeGap: Final[float | None]  # s
    displacement: Final[literals.LongitudinalDisplacement | None]  # since 1.1
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.1, by default entity

ManeuverPart: TypeAlias = Event | ParameterDeclarations

class Maneuver(Base):
    def __init__(
        self,
        *children: ManeuverPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

class ManeuverCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

ManeuverGroupPart: TypeAlias = Actors | CatalogReference | Maneuver

class ManeuverGroup(Base):
    def __init__(
        self,
        *children: ManeuverGroupPart | None,
        maximumExecutionCount: int,
        name: str,
    ) -> None: ...
    maximumExecutionCount: Final[int]
    name: Final[str]

class ManualGear(Base):
    def __init__(
        self,
        *,
        number: int,
    ) -> None: ...
    number: Final[int]  # since 1.2

MembersPart: TypeAlias = ByType | EntityRef

class Members(Base):
    def __init__(
        self,
        *children: MembersPart | None,
    ) -> None: ...

MiscObjectPart: TypeAlias = BoundingBox | ParameterDeclarations | Properties

class MiscObject(Base):
    def __init__(
        self,
        *children: MiscObjectPart | None,
        mass: float,
        miscObjectCategory: literals.MiscObjectCategory,
        name: str,
        model3d: str | float | None = None,
    ) -> None: ...
    mass: Final[float]  # kg
    miscObjectCategory: Final[literals.MiscObjectCategory]
    name: Final[str]
    model3d: Final[str | None]  # since 1.1

class MiscObjectCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

class ModifyAction(Base):
    def __init__(
        self,
        *children: Rule | None,
    ) -> None: ...

class MonitorDeclaration(Base):
    def __init__(
        self,
        *,
        name: str,
        value: bool,
    ) -> None: ...
    name: Final[str]  # since 1.3
    value: Final[bool]  # since 1.3

class MonitorDeclarations(Base):
    def __init__(
        self,
        *children: MonitorDeclaration | None,
    ) -> None: ...

class Motion(Base):
    def __init__(
        self,
        *,
        speed_longitudinal: float | None = None,
        acceleration_longitudinal: float | None = None,
    ) -> None: ...
    speed_longitudinal: Final[float | None]  # m/s, since 1.4
    acceleration_longitudinal: Final[float | None]  # m/s², since 1.4

class MotionEnd(Base):
    def __init__(
        self,
        *,
        speed_longitudinal: float | None = None,
        acceleration_longitudinal: float | None = None,
    ) -> None: ...
    speed_longitudinal: Final[float | None]  # m/s, since 1.4
    acceleration_longitudinal: Final[float | None]  # m/s², since 1.4

class MotionStart(Base):
    def __init__(
        self,
        *,
        speed_longitudinal: float | None = None,
        acceleration_longitudinal: float | None = None,
    ) -> None: ...
    speed_longitudinal: Final[float | None]  # m/s, since 1.4
    acceleration_longitudinal: Final[float | None]  # m/s², since 1.4

class MultiplyByValue(Base):
    def __init__(
        self,
        *,
        value: float,
    ) -> None: ...
    value: Final[float]  # since 1.2

class None_(Base):
    def __init__(
        self,
    ) -> None: ...

class NormalDistribution(Base):
    def __init__(
        self,
        *children: Range | None,
        expectedValue: float,
        variance: float,
    ) -> None: ...
    expectedValue: Final[float]  # since 1.1
    variance: Final[float]  # since 1.1

NurbsPart: TypeAlias = ControlPoint | Knot

class Nurbs(Base):
    def __init__(
        self,
        *children: NurbsPart | None,
        order: int,
    ) -> None: ...
    order: Final[int]

ObjectControllerPart: TypeAlias = CatalogReference | Controller

class ObjectController(Base):
    def __init__(
        self,
        *children: ObjectControllerPart | None,
        name: str | None = None,
    ) -> None: ...
    name: Final[str | None]  # since 1.3

class OffroadCondition(Base):
    def __init__(
        self,
        *,
        duration: float,
    ) -> None: ...
    duration: Final[float]  # s

OpenSCENARIOPart: TypeAlias = (
    Catalog
    | CatalogLocations
    | Entities
    | FileHeader
    | MonitorDeclarations
    | ParameterDeclarations
    | ParameterValueDistribution
    | RoadNetwork
    | Storyboard
    | VariableDeclarations
)

class OpenSCENARIO(Base):
    def __init__(
        self,
        *children: OpenSCENARIOPart | None,
    ) -> None: ...

class Orientation(Base):
    def __init__(
        self,
        *,
        h: float | None = None,
        p: float | None = None,
        r: float | None = None,
        type: literals.ReferenceContext | None = None,
    ) -> None: ...
    h: Final[float]  # rad, by default 0
    p: Final[float]  # rad, by default 0
    r: Final[float]  # rad, by default 0
    type: Final[literals.ReferenceContext]  # by default absolute

OverrideControllerValueActionPart: TypeAlias = (
    Brake | Clutch | Gear | ParkingBrake | SteeringWheel | Throttle
)

class OverrideControllerValueAction(Base):
    def __init__(
        self,
        *children: OverrideControllerValueActionPart | None,
    ) -> None: ...

ParameterActionPart: TypeAlias = ModifyAction | SetAction

class ParameterAction(Base):
    def __init__(
        self,
        *children: ParameterActionPart | None,
        parameterRef: str | float,
    ) -> None: ...
    parameterRef: Final[str]

class ParameterAssignment(Base):
    def __init__(
        self,
        *,
        parameterRef: str | float,
        value: str | float,
    ) -> None: ...
    parameterRef: Final[str]
    value: Final[str]

class ParameterAssignments(Base):
    def __init__(
        self,
        *children: ParameterAssignment | None,
    ) -> None: ...

class ParameterCondition(Base):
    def __init__(
        self,
        *,
        parameterRef: str | float,
        rule: literals.Rule,
        value: str | float,
    ) -> None: ...
    parameterRef: Final[str]
    rule: Final[literals.Rule]
    value: Final[str]

class ParameterDeclaration(Base):
    def __init__(
        self,
        *children: ConstraintGroup | None,
        name: str,
        parameterType: literals.ParameterType,
        value: str | float,
    ) -> None: ...
    name: Final[str]
    parameterType: Final[literals.ParameterType]
    value: Final[str]

class ParameterDeclarations(Base):
    def __init__(
        self,
        *children: ParameterDeclaration | None,
    ) -> None: ...

ParameterValueDistributionPart: TypeAlias = Deterministic | ScenarioFile | Stochastic

class ParameterValueDistribution(Base):
    def __init__(
        self,
        *children: ParameterValueDistributionPart | None,
    ) -> None: ...

class ParameterValueSet(Base):
    def __init__(
        self,
        *children: ParameterAssignment | None,
    ) -> None: ...

ParkingBrakePart: TypeAlias = BrakeForce | BrakePercent

class ParkingBrake(Base):
    def __init__(
        self,
        *children: ParkingBrakePart | None,
        active: bool,
        value: float | None = None,
    ) -> None: ...
    active: Final[bool]
    value: Final[float | None]  # deprecated since 1.2

PedestrianPart: TypeAlias = BoundingBox | ParameterDeclarations | Properties

class Pedestrian(Base):
    def __init__(
        self,
        *children: PedestrianPart | None,
        mass: float,
        model: str | float | None = None,
        name: str,
        pedestrianCategory: literals.PedestrianCategory,
        model3d: str | float | None = None,
        role: literals.Role | None = None,
    ) -> None: ...
    mass: Final[float]  # kg
    model: Final[str | None]  # deprecated since 1.1
    name: Final[str]
    pedestrianCategory: Final[literals.PedestrianCategory]
    model3d: Final[str | None]  # since 1.1
    role: Final[literals.Role]  # since 1.2, by default none

class PedestrianAnimation(Base):
    def __init__(
        self,
        *children: PedestrianGesture | None,
        motion: literals.PedestrianMotionType | None = None,
        userDefinedPedestrianAnimation: str | float | None = None,
    ) -> None: ...
    motion: Final[literals.PedestrianMotionType | None]  # since 1.2
    userDefinedPedestrianAnimation: Final[str | None]  # since 1.2

class PedestrianCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

class PedestrianGesture(Base):
    def __init__(
        self,
        *,
        gesture: literals.PedestrianGestureType,
    ) -> None: ...
    gesture: Final[literals.PedestrianGestureType]  # since 1.2

class Performance(Base):
    def __init__(
        self,
        *,
        maxAcceleration: float,
        maxDeceleration: float,
        maxSpeed: float,
        maxAccelerationRate: float | None = None,
        maxDecelerationRate: float | None = None,
    ) -> None: ...
    maxAcceleration: Final[float]  # m/s²
    maxDeceleration: Final[float]  # m/s²
    maxSpeed: Final[float]  # m/s
    maxAccelerationRate: Final[float | None]  # m/s³, since 1.2
    maxDecelerationRate: Final[float | None]  # m/s³, since 1.2

PhasePart: TypeAlias = TrafficSignalGroupState | TrafficSignalState | TrafficeSignalGroupState

class Phase(Base):
    def __init__(
        self,
        *children: PhasePart | None,
        duration: float,
        name: str,
        semantics: literals.TrafficSignalSemantics | None = None,
    ) -> None: ...
    duration: Final[float]  # s
    name: Final[str]
    semantics: Final[literals.TrafficSignalSemantics | None]  # since 1.4

class PoissonDistribution(Base):
    def __init__(
        self,
        *children: Range | None,
        expectedValue: float,
    ) -> None: ...
    expectedValue: Final[float]  # since 1.1

class Polygon(Base):
    def __init__(
        self,
        *children: Position | None,
    ) -> None: ...

PolylinePart: TypeAlias = Interpolation | Vertex

class Polyline(Base):
    def __init__(
        self,
        *children: PolylinePart | None,
    ) -> None: ...

PositionPart: TypeAlias = (
    GeoPosition
    | LanePosition
    | RelativeLanePosition
    | RelativeObjectPosition
    | RelativeRoadPosition
    | RelativeWorldPosition
    | RoadPosition
    | RoutePosition
    | TrajectoryPosition
    | WorldPosition
)

class Position(Base):
    def __init__(
        self,
        *children: PositionPart | None,
    ) -> None: ...

PositionStartPart: TypeAlias = (
    GeoPosition
    | LanePosition
    | RelativeLanePosition
    | RelativeObjectPosition
    | RelativeRoadPosition
    | RelativeWorldPosition
    | RoadPosition
    | RoutePosition
    | TrajectoryPosition
    | WorldPosition
)

class PositionStart(Base):
    def __init__(
        self,
        *children: PositionStartPart | None,
    ) -> None: ...

class Precipitation(Base):
    def __init__(
        self,
        *,
        intensity: float | None = None,
        precipitationType: literals.PrecipitationType,
        precipitationIntensity: float | None = None,
    ) -> None: ...
    intensity: Final[float | None]  # deprecated since 1.1
    precipitationType: Final[literals.PrecipitationType]
    precipitationIntensity: Final[float | None]  # mm/h, since 1.1

class PreferredLaneLayerAction(Base):
    def __init__(
        self,
        *,
        layer: literals.LaneLayerType,
    ) -> None: ...
    layer: Final[literals.LaneLayerType]  # since 1.4

class Private(Base):
    def __init__(
        self,
        *children: PrivateAction | None,
        entityRef: str | float,
    ) -> None: ...
    entityRef: Final[str]

PrivateActionPart: TypeAlias = (
    ActivateControllerAction
    | AppearanceAction
    | ControllerAction
    | LateralAction
    | LongitudinalAction
    | RoutingAction
    | SynchronizeAction
    | TeleportAction
    | TrailerAction
    | VisibilityAction
)

class PrivateAction(Base):
    def __init__(
        self,
        *children: PrivateActionPart | None,
    ) -> None: ...

class ProbabilityDistributionSet(Base):
    def __init__(
        self,
        *children: Element | None,
    ) -> None: ...

PropertiesPart: TypeAlias = CustomContent | File | Property

class Properties(Base):
    def __init__(
        self,
        *children: PropertiesPart | None,
    ) -> None: ...

class Property(Base):
    def __init__(
        self,
        *,
        name: str,
        value: str | float,
    ) -> None: ...
    name: Final[str]
    value: Final[str]

class RandomRouteAction(Base):
    def __init__(
        self,
    ) -> None: ...

class Range(Base):
    def __init__(
        self,
        *,
        lowerLimit: float,
        upperLimit: float,
    ) -> None: ...
    lowerLimit: Final[float]  # since 1.1
    upperLimit: Final[float]  # since 1.1

class ReachPositionCondition(Base):
    def __init__(
        self,
        *children: Position | None,
        tolerance: float,
    ) -> None: ...
    tolerance: Final[float]  # m

class RearAxle(Base):
    def __init__(
        self,
        *,
        maxSteering: float,
        positionX: float,
        positionZ: float,
        trackWidth: float,
        wheelDiameter: float,
    ) -> None: ...
    maxSteering: Final[float]  # rad
    positionX: Final[float]  # m
    positionZ: Final[float]  # m
    trackWidth: Final[float]  # m
    wheelDiameter: Final[float]  # m

class RelativeAngleCondition(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        angleType: literals.AngleType,
        angle: float,
        angleTolerance: float,
        coordinateSystem: literals.CoordinateSystem | None = None,
    ) -> None: ...
    entityRef: Final[str]  # since 1.3
    angleType: Final[literals.AngleType]  # since 1.3
    angle: Final[float]  # rad, since 1.3
    angleTolerance: Final[float]  # rad, since 1.3
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.3, by default entity

RelativeClearanceConditionPart: TypeAlias = EntityRef | RelativeLaneRange

class RelativeClearanceCondition(Base):
    def __init__(
        self,
        *children: RelativeClearanceConditionPart | None,
        oppositeLanes: bool,
        distanceForward: float | None = None,
        distanceBackward: float | None = None,
        freeSpace: bool,
    ) -> None: ...
    oppositeLanes: Final[bool]  # since 1.2
    distanceForward: Final[float]  # m, since 1.2, by default 0
    distanceBackward: Final[float]  # m, since 1.2, by default 0
    freeSpace: Final[bool]  # since 1.2

class RelativeDistanceCondition(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        freespace: bool,
        relativeDistanceType: literals.RelativeDistanceType,
        rule: literals.Rule,
        value: float,
        coordinateSystem: literals.CoordinateSystem | None = None,
        routingAlgorithm: literals.RoutingAlgorithm | None = None,
    ) -> None: ...
    entityRef: Final[str]
    freespace: Final[bool]
    relativeDistanceType: Final[literals.RelativeDistanceType]
    rule: Final[literals.Rule]
    value: Final[float]  # m
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.1, by default entity
    routingAlgorithm: Final[literals.RoutingAlgorithm]  # since 1.2, by default undefined

class RelativeLanePosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        entityRef: str | float,
        dLane: int,
        ds: float | None = None,
        offset: float | None = None,
        dsLane: float | None = None,
    ) -> None: ...
    entityRef: Final[str]
    dLane: Final[int]
    ds: Final[float | None]  # m
    offset: Final[float]  # m, by default 0
    dsLane: Final[float | None]  # m, since 1.1

class RelativeLaneRange(Base):
    def __init__(
        self,
        *,
        from_: int | None = None,
        to: int | None = None,
    ) -> None: ...
    from_: Final[int]  # since 1.2, by default -INF
    to: Final[int]  # since 1.2, by default INF

class RelativeObjectPosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        entityRef: str | float,
        dx: float,
        dy: float,
        dz: float | None = None,
    ) -> None: ...
    entityRef: Final[str]
    dx: Final[float]  # m
    dy: Final[float]  # m
    dz: Final[float]  # m, by default 0

class RelativeRoadPosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        entityRef: str | float,
        ds: float,
        dt: float,
    ) -> None: ...
    entityRef: Final[str]
    ds: Final[float]  # m
    dt: Final[float]  # m

class RelativeSpeedCondition(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        rule: literals.Rule,
        value: float,
        direction: literals.DirectionalDimension | None = None,
    ) -> None: ...
    entityRef: Final[str]
    rule: Final[literals.Rule]
    value: Final[float]  # m/s
    direction: Final[literals.DirectionalDimension | None]  # since 1.2

RelativeSpeedToMasterPart: TypeAlias = TargetDistanceSteadyState | TargetTimeSteadyState

class RelativeSpeedToMaster(Base):
    def __init__(
        self,
        *children: RelativeSpeedToMasterPart | None,
        speedTargetValueType: literals.SpeedTargetValueType,
        value: float,
    ) -> None: ...
    speedTargetValueType: Final[literals.SpeedTargetValueType]
    value: Final[float]  # m/s

class RelativeTargetLane(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        value: int,
        layer: literals.LaneLayerType | None = None,
    ) -> None: ...
    entityRef: Final[str]
    value: Final[int]
    layer: Final[literals.LaneLayerType | None]  # since 1.4

class RelativeTargetLaneOffset(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        value: float,
    ) -> None: ...
    entityRef: Final[str]
    value: Final[float]  # m

class RelativeTargetSpeed(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        continuous: bool,
        speedTargetValueType: literals.SpeedTargetValueType,
        value: float,
    ) -> None: ...
    entityRef: Final[str]
    continuous: Final[bool]
    speedTargetValueType: Final[literals.SpeedTargetValueType]
    value: Final[float]  # m/s

class RelativeWorldPosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        entityRef: str | float,
        dx: float,
        dy: float,
        dz: float | None = None,
    ) -> None: ...
    entityRef: Final[str]
    dx: Final[float]  # m
    dy: Final[float]  # m
    dz: Final[float]  # m, by default 0

class RoadCondition(Base):
    def __init__(
        self,
        *children: Properties | None,
        frictionScaleFactor: float,
        wetness: literals.Wetness | None = None,
    ) -> None: ...
    frictionScaleFactor: Final[float]
    wetness: Final[literals.Wetness | None]  # since 1.2

class RoadCursor(Base):
    def __init__(
        self,
        *children: Lane | None,
        roadId: str | float,
        s: float | None = None,
    ) -> None: ...
    roadId: Final[str]  # since 1.3
    s: Final[float | None]  # m, since 1.3

RoadNetworkPart: TypeAlias = LogicFile | SceneGraphFile | TrafficSignals | UsedArea

class RoadNetwork(Base):
    def __init__(
        self,
        *children: RoadNetworkPart | None,
    ) -> None: ...

class RoadPosition(Base):
    def __init__(
        self,
        *children: Orientation | None,
        roadId: str | float,
        s: float,
        t: float,
    ) -> None: ...
    roadId: Final[str]
    s: Final[float]  # m
    t: Final[float]  # m

class RoadRange(Base):
    def __init__(
        self,
        *children: RoadCursor | None,
        length: float | None = None,
    ) -> None: ...
    length: Final[float | None]  # m, since 1.3

RoutePart: TypeAlias = ParameterDeclarations | Waypoint

class Route(Base):
    def __init__(
        self,
        *children: RoutePart | None,
        closed: bool,
        name: str,
    ) -> None: ...
    closed: Final[bool]
    name: Final[str]

class RouteCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

RoutePositionPart: TypeAlias = InRoutePosition | Orientation | RouteRef

class RoutePosition(Base):
    def __init__(
        self,
        *children: RoutePositionPart | None,
    ) -> None: ...

RouteRefPart: TypeAlias = CatalogReference | Route

class RouteRef(Base):
    def __init__(
        self,
        *children: RouteRefPart | None,
    ) -> None: ...

RoutingActionPart: TypeAlias = (
    AcquirePositionAction
    | AssignRouteAction
    | FollowTrajectoryAction
    | PreferredLaneLayerAction
    | RandomRouteAction
)

class RoutingAction(Base):
    def __init__(
        self,
        *children: RoutingActionPart | None,
    ) -> None: ...

RulePart: TypeAlias = AddValue | MultiplyByValue

class Rule(Base):
    def __init__(
        self,
        *children: RulePart | None,
    ) -> None: ...

class ScenarioFile(Base):
    def __init__(
        self,
        *,
        filepath: str | float,
    ) -> None: ...
    filepath: Final[str]

ScenarioObjectPart: TypeAlias = (
    CatalogReference
    | ExternalObjectReference
    | MiscObject
    | ObjectController
    | Pedestrian
    | Vehicle
)

class ScenarioObject(Base):
    def __init__(
        self,
        *children: ScenarioObjectPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

ScenarioObjectTemplatePart: TypeAlias = (
    CatalogReference
    | ExternalObjectReference
    | MiscObject
    | ObjectController
    | Pedestrian
    | Vehicle
)

class ScenarioObjectTemplate(Base):
    def __init__(
        self,
        *children: ScenarioObjectTemplatePart | None,
    ) -> None: ...

class SceneGraphFile(Base):
    def __init__(
        self,
        *,
        filepath: str | float,
    ) -> None: ...
    filepath: Final[str]

class SensorReference(Base):
    def __init__(
        self,
        *,
        name: str,
    ) -> None: ...
    name: Final[str]  # since 1.2

class SensorReferenceSet(Base):
    def __init__(
        self,
        *children: SensorReference | None,
    ) -> None: ...

class SetAction(Base):
    def __init__(
        self,
        *,
        value: str | float,
    ) -> None: ...
    value: Final[str]  # since 1.2

class SetMonitorAction(Base):
    def __init__(
        self,
        *,
        monitorRef: str | float,
        value: bool,
    ) -> None: ...
    monitorRef: Final[str]  # since 1.3
    value: Final[bool]  # since 1.3

ShapePart: TypeAlias = Clothoid | ClothoidSpline | Nurbs | Polyline

class Shape(Base):
    def __init__(
        self,
        *children: ShapePart | None,
    ) -> None: ...

class SimulationTimeCondition(Base):
    def __init__(
        self,
        *,
        rule: literals.Rule,
        value: float,
    ) -> None: ...
    rule: Final[literals.Rule]
    value: Final[float]  # s

SpeedActionPart: TypeAlias = SpeedActionDynamics | SpeedActionTarget

class SpeedAction(Base):
    def __init__(
        self,
        *children: SpeedActionPart | None,
    ) -> None: ...

class SpeedActionDynamics(Base):
    def __init__(
        self,
        *,
        dynamicsDimension: literals.DynamicsDimension,
        dynamicsShape: literals.DynamicsShape,
        value: float,
        followingMode: literals.FollowingMode | None = None,
    ) -> None: ...
    dynamicsDimension: Final[literals.DynamicsDimension]
    dynamicsShape: Final[literals.DynamicsShape]
    value: Final[float]
    followingMode: Final[literals.FollowingMode]  # since 1.2, by default position

SpeedActionTargetPart: TypeAlias = AbsoluteTargetSpeed | RelativeTargetSpeed

class SpeedActionTarget(Base):
    def __init__(
        self,
        *children: SpeedActionTargetPart | None,
    ) -> None: ...

class SpeedCondition(Base):
    def __init__(
        self,
        *,
        rule: literals.Rule,
        value: float,
        direction: literals.DirectionalDimension | None = None,
    ) -> None: ...
    rule: Final[literals.Rule]
    value: Final[float]  # m/s
    direction: Final[literals.DirectionalDimension | None]  # since 1.2

SpeedProfileActionPart: TypeAlias = DynamicConstraints | SpeedProfileEntry

class SpeedProfileAction(Base):
    def __init__(
        self,
        *children: SpeedProfileActionPart | None,
        entityRef: str | float | None = None,
        followingMode: literals.FollowingMode,
    ) -> None: ...
    entityRef: Final[str | None]  # since 1.2
    followingMode: Final[literals.FollowingMode]  # since 1.2

class SpeedProfileEntry(Base):
    def __init__(
        self,
        *,
        speed: float,
        time: float | None = None,
    ) -> None: ...
    speed: Final[float]  # m/s, since 1.2
    time: Final[float | None]  # s, since 1.2

class StandStillCondition(Base):
    def __init__(
        self,
        *,
        duration: float,
    ) -> None: ...
    duration: Final[float]  # s

class StartTrigger(Base):
    def __init__(
        self,
        *children: ConditionGroup | None,
    ) -> None: ...

class SteeringWheel(Base):
    def __init__(
        self,
        *,
        active: bool,
        value: float,
        maxRate: float | None = None,
        maxTorque: float | None = None,
    ) -> None: ...
    active: Final[bool]
    value: Final[float]  # rad
    maxRate: Final[float | None]  # %/s, since 1.2
    maxTorque: Final[float | None]  # Nm, since 1.2

class Stochastic(Base):
    def __init__(
        self,
        *children: StochasticDistribution | None,
        numberOfTestRuns: int,
        randomSeed: float | None = None,
    ) -> None: ...
    numberOfTestRuns: Final[int]  # since 1.1
    randomSeed: Final[float | None]  # since 1.1

StochasticDistributionPart: TypeAlias = (
    Histogram
    | LogNormalDistribution
    | NormalDistribution
    | PoissonDistribution
    | ProbabilityDistributionSet
    | UniformDistribution
    | UserDefinedDistribution
)

class StochasticDistribution(Base):
    def __init__(
        self,
        *children: StochasticDistributionPart | None,
        parameterName: str | float,
    ) -> None: ...
    parameterName: Final[str]  # since 1.1

class StopTrigger(Base):
    def __init__(
        self,
        *children: ConditionGroup | None,
    ) -> None: ...

StoryPart: TypeAlias = Act | ParameterDeclarations

class Story(Base):
    def __init__(
        self,
        *children: StoryPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

StoryboardPart: TypeAlias = Init | StopTrigger | Story

class Storyboard(Base):
    def __init__(
        self,
        *children: StoryboardPart | None,
    ) -> None: ...

class StoryboardElementStateCondition(Base):
    def __init__(
        self,
        *,
        storyboardElementRef: str | float,
        state: literals.StoryboardElementState,
        storyboardElementType: literals.StoryboardElementType,
    ) -> None: ...
    storyboardElementRef: Final[str]
    state: Final[literals.StoryboardElementState]
    storyboardElementType: Final[literals.StoryboardElementType]

class Sun(Base):
    def __init__(
        self,
        *,
        azimuth: float,
        elevation: float,
        intensity: float | None = None,
        illuminance: float | None = None,
    ) -> None: ...
    azimuth: Final[float]  # rad
    elevation: Final[float]  # rad
    intensity: Final[float | None]  # lx, deprecated since 1.2
    illuminance: Final[float]  # lx, since 1.2, by default 0

SynchronizeActionPart: TypeAlias = FinalSpeed | TargetPosition | TargetPositionMaster

class SynchronizeAction(Base):
    def __init__(
        self,
        *children: SynchronizeActionPart | None,
        masterEntityRef: str | float,
        targetToleranceMaster: float | None = None,
        targetTolerance: float | None = None,
    ) -> None: ...
    masterEntityRef: Final[str]
    targetToleranceMaster: Final[float | None]  # m, since 1.1
    targetTolerance: Final[float | None]  # m, since 1.1

class TargetDistanceSteadyState(Base):
    def __init__(
        self,
        *,
        distance: float,
    ) -> None: ...
    distance: Final[float]  # m, since 1.1

TargetPositionPart: TypeAlias = (
    GeoPosition
    | LanePosition
    | RelativeLanePosition
    | RelativeObjectPosition
    | RelativeRoadPosition
    | RelativeWorldPosition
    | RoadPosition
    | RoutePosition
    | TrajectoryPosition
    | WorldPosition
)

class TargetPosition(Base):
    def __init__(
        self,
        *children: TargetPositionPart | None,
    ) -> None: ...

TargetPositionMasterPart: TypeAlias = (
    GeoPosition
    | LanePosition
    | RelativeLanePosition
    | RelativeObjectPosition
    | RelativeRoadPosition
    | RelativeWorldPosition
    | RoadPosition
    | RoutePosition
    | TrajectoryPosition
    | WorldPosition
)

class TargetPositionMaster(Base):
    def __init__(
        self,
        *children: TargetPositionMasterPart | None,
    ) -> None: ...

class TargetTimeSteadyState(Base):
    def __init__(
        self,
        *,
        time: float,
    ) -> None: ...
    time: Final[float]  # s, since 1.1

class TeleportAction(Base):
    def __init__(
        self,
        *children: Position | None,
    ) -> None: ...

class Throttle(Base):
    def __init__(
        self,
        *,
        active: bool,
        value: float,
        maxRate: float | None = None,
    ) -> None: ...
    active: Final[bool]
    value: Final[float]
    maxRate: Final[float | None]  # %/s, since 1.2

class TimeHeadwayCondition(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
        alongRoute: bool | None = None,
        freespace: bool,
        rule: literals.Rule,
        value: float,
        coordinateSystem: literals.CoordinateSystem | None = None,
        relativeDistanceType: literals.RelativeDistanceType | None = None,
        routingAlgorithm: literals.RoutingAlgorithm | None = None,
    ) -> None: ...
    entityRef: Final[str]
    alongRoute: Final[bool | None]  # deprecated since 1.1
    freespace: Final[bool]
    rule: Final[literals.Rule]
    value: Final[float]  # s
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.1, by default entity
    relativeDistanceType: Final[
        literals.RelativeDistanceType
    ]  # since 1.1, by default euclidianDistance
    routingAlgorithm: Final[literals.RoutingAlgorithm]  # since 1.2, by default undefined

class TimeOfDay(Base):
    def __init__(
        self,
        *,
        animation: bool,
        dateTime: str,
    ) -> None: ...
    animation: Final[bool]
    dateTime: Final[str]

class TimeOfDayCondition(Base):
    def __init__(
        self,
        *,
        dateTime: str,
        rule: literals.Rule,
    ) -> None: ...
    dateTime: Final[str]
    rule: Final[literals.Rule]

TimeReferencePart: TypeAlias = None_ | Timing

class TimeReference(Base):
    def __init__(
        self,
        *children: TimeReferencePart | None,
    ) -> None: ...

class TimeToCollisionCondition(Base):
    def __init__(
        self,
        *children: TimeToCollisionConditionTarget | None,
        alongRoute: bool | None = None,
        freespace: bool,
        rule: literals.Rule,
        value: float,
        relativeDistanceType: literals.RelativeDistanceType | None = None,
        coordinateSystem: literals.CoordinateSystem | None = None,
        routingAlgorithm: literals.RoutingAlgorithm | None = None,
    ) -> None: ...
    alongRoute: Final[bool | None]  # deprecated since 1.1
    freespace: Final[bool]
    rule: Final[literals.Rule]
    value: Final[float]  # s
    relativeDistanceType: Final[
        literals.RelativeDistanceType
    ]  # since 1.1, by default euclidianDistance
    coordinateSystem: Final[literals.CoordinateSystem]  # since 1.1, by default entity
    routingAlgorithm: Final[literals.RoutingAlgorithm]  # since 1.2, by default undefined

TimeToCollisionConditionTargetPart: TypeAlias = EntityRef | Position

class TimeToCollisionConditionTarget(Base):
    def __init__(
        self,
        *children: TimeToCollisionConditionTargetPart | None,
    ) -> None: ...

class Timing(Base):
    def __init__(
        self,
        *,
        domainAbsoluteRelative: literals.ReferenceContext,
        offset: float,
        scale: float,
    ) -> None: ...
    domainAbsoluteRelative: Final[literals.ReferenceContext]
    offset: Final[float]  # s
    scale: Final[float]

TrafficActionPart: TypeAlias = (
    TrafficAreaAction
    | TrafficSinkAction
    | TrafficSourceAction
    | TrafficStopAction
    | TrafficSwarmAction
)

class TrafficAction(Base):
    def __init__(
        self,
        *children: TrafficActionPart | None,
        trafficName: str | float | None = None,
    ) -> None: ...
    trafficName: Final[str | None]  # since 1.1

TrafficAreaPart: TypeAlias = Polygon | RoadRange

class TrafficArea(Base):
    def __init__(
        self,
        *children: TrafficAreaPart | None,
    ) -> None: ...

TrafficAreaActionPart: TypeAlias = TrafficArea | TrafficDistribution

class TrafficAreaAction(Base):
    def __init__(
        self,
        *children: TrafficAreaActionPart | None,
        numberOfEntities: int,
        continuous: bool,
    ) -> None: ...
    numberOfEntities: Final[int]  # since 1.3
    continuous: Final[bool]  # since 1.3

TrafficDefinitionPart: TypeAlias = (
    ControllerDistribution | VehicleCategoryDistribution | VehicleRoleDistribution
)

class TrafficDefinition(Base):
    def __init__(
        self,
        *children: TrafficDefinitionPart | None,
        name: str,
    ) -> None: ...
    name: Final[str]

TrafficDistributionPart: TypeAlias = CatalogReferences | TrafficDistributionEntry

class TrafficDistribution(Base):
    def __init__(
        self,
        *children: TrafficDistributionPart | None,
    ) -> None: ...

TrafficDistributionEntryPart: TypeAlias = EntityDistribution | ParameterDeclarations | Properties

class TrafficDistributionEntry(Base):
    def __init__(
        self,
        *children: TrafficDistributionEntryPart | None,
        weight: float,
        name: str | None = None,
    ) -> None: ...
    weight: Final[float]  # since 1.3
    name: Final[str | None]  # since 1.4

class TrafficDistributionEntryCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

TrafficSignalActionPart: TypeAlias = TrafficSignalControllerAction | TrafficSignalStateAction

class TrafficSignalAction(Base):
    def __init__(
        self,
        *children: TrafficSignalActionPart | None,
    ) -> None: ...

class TrafficSignalCondition(Base):
    def __init__(
        self,
        *,
        name: str,
        state: str | float,
    ) -> None: ...
    name: Final[str]
    state: Final[str]

class TrafficSignalController(Base):
    def __init__(
        self,
        *children: Phase | None,
        delay: float | None = None,
        name: str,
        reference: str | float | None = None,
    ) -> None: ...
    delay: Final[float | None]  # s
    name: Final[str]
    reference: Final[str | None]

class TrafficSignalControllerAction(Base):
    def __init__(
        self,
        *,
        trafficSignalControllerRef: str | float,
        phase: str | float,
    ) -> None: ...
    trafficSignalControllerRef: Final[str]
    phase: Final[str]

class TrafficSignalControllerCondition(Base):
    def __init__(
        self,
        *,
        trafficSignalControllerRef: str | float,
        phase: str | float,
    ) -> None: ...
    trafficSignalControllerRef: Final[str]
    phase: Final[str]

class TrafficSignalGroupState(Base):
    def __init__(
        self,
        *,
        state: str | float,
    ) -> None: ...
    state: Final[str]  # since 1.2

class TrafficSignalState(Base):
    def __init__(
        self,
        *,
        state: str | float,
        trafficSignalId: str | float,
    ) -> None: ...
    state: Final[str]
    trafficSignalId: Final[str]

class TrafficSignalStateAction(Base):
    def __init__(
        self,
        *,
        name: str,
        state: str | float,
    ) -> None: ...
    name: Final[str]
    state: Final[str]

class TrafficSignals(Base):
    def __init__(
        self,
        *children: TrafficSignalController | None,
    ) -> None: ...

TrafficSinkActionPart: TypeAlias = Position | TrafficDefinition

class TrafficSinkAction(Base):
    def __init__(
        self,
        *children: TrafficSinkActionPart | None,
        radius: float,
        rate: float | None = None,
    ) -> None: ...
    radius: Final[float]  # m
    rate: Final[float | None]  # vehicles/s

TrafficSourceActionPart: TypeAlias = Position | TrafficDefinition | TrafficDistribution

class TrafficSourceAction(Base):
    def __init__(
        self,
        *children: TrafficSourceActionPart | None,
        radius: float,
        rate: float,
        velocity: float | None = None,
        speed: float | None = None,
    ) -> None: ...
    radius: Final[float]  # m
    rate: Final[float]  # vehicles/s
    velocity: Final[float | None]  # m/s, deprecated since 1.2
    speed: Final[float | None]  # m/s, since 1.2

class TrafficStopAction(Base):
    def __init__(
        self,
    ) -> None: ...

TrafficSwarmActionPart: TypeAlias = (
    CentralObject
    | DirectionOfTravelDistribution
    | InitialSpeedRange
    | TrafficDefinition
    | TrafficDistribution
)

class TrafficSwarmAction(Base):
    def __init__(
        self,
        *children: TrafficSwarmActionPart | None,
        innerRadius: float,
        numberOfVehicles: int,
        offset: float,
        semiMajorAxis: float,
        semiMinorAxis: float,
        velocity: float | None = None,
    ) -> None: ...
    innerRadius: Final[float]  # m
    numberOfVehicles: Final[int]
    offset: Final[float]  # m
    semiMajorAxis: Final[float]  # m
    semiMinorAxis: Final[float]  # m
    velocity: Final[float | None]  # m/s, deprecated since 1.2

class TrafficeSignalGroupState(Base):
    def __init__(
        self,
        *,
        state: str | float,
    ) -> None: ...
    state: Final[str]  # since 1.2

TrailerPart: TypeAlias = (
    CatalogReference
    | ExternalObjectReference
    | MiscObject
    | ObjectController
    | Pedestrian
    | Trailer
    | TrailerRef
    | Vehicle
)

class Trailer(Base):
    def __init__(
        self,
        *children: TrailerPart | None,
        name: str | None = None,
    ) -> None: ...
    name: Final[str | None]

TrailerActionPart: TypeAlias = ConnectTrailerAction | DisconnectTrailerAction

class TrailerAction(Base):
    def __init__(
        self,
        *children: TrailerActionPart | None,
    ) -> None: ...

class TrailerCoupler(Base):
    def __init__(
        self,
        *,
        dx: float,
        dz: float | None = None,
    ) -> None: ...
    dx: Final[float]  # m, since 1.3
    dz: Final[float | None]  # m, since 1.3

class TrailerHitch(Base):
    def __init__(
        self,
        *,
        dx: float,
        dz: float | None = None,
    ) -> None: ...
    dx: Final[float]  # m, since 1.3
    dz: Final[float | None]  # m, since 1.3

class TrailerRef(Base):
    def __init__(
        self,
        *,
        entityRef: str | float,
    ) -> None: ...
    entityRef: Final[str]

TrajectoryPart: TypeAlias = ParameterDeclarations | Shape

class Trajectory(Base):
    def __init__(
        self,
        *children: TrajectoryPart | None,
        closed: bool,
        name: str,
    ) -> None: ...
    closed: Final[bool]
    name: Final[str]

class TrajectoryCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

class TrajectoryFollowingMode(Base):
    def __init__(
        self,
        *,
        followingMode: literals.FollowingMode,
    ) -> None: ...
    followingMode: Final[literals.FollowingMode]

TrajectoryPositionPart: TypeAlias = Orientation | TrajectoryRef

class TrajectoryPosition(Base):
    def __init__(
        self,
        *children: TrajectoryPositionPart | None,
        s: float,
        t: float | None = None,
    ) -> None: ...
    s: Final[float]  # m, since 1.1
    t: Final[float | None]  # m, since 1.1

TrajectoryRefPart: TypeAlias = CatalogReference | Trajectory

class TrajectoryRef(Base):
    def __init__(
        self,
        *children: TrajectoryRefPart | None,
    ) -> None: ...

class TraveledDistanceCondition(Base):
    def __init__(
        self,
        *,
        value: float,
    ) -> None: ...
    value: Final[float]  # m

class TriggeringEntities(Base):
    def __init__(
        self,
        *children: EntityRef | None,
        triggeringEntitiesRule: literals.TriggeringEntitiesRule,
    ) -> None: ...
    triggeringEntitiesRule: Final[literals.TriggeringEntitiesRule]

class UniformDistribution(Base):
    def __init__(
        self,
        *children: Range | None,
    ) -> None: ...

class UsedArea(Base):
    def __init__(
        self,
        *children: Position | None,
    ) -> None: ...

class UserDefinedAction(Base):
    def __init__(
        self,
        *children: CustomCommandAction | None,
    ) -> None: ...

class UserDefinedAnimation(Base):
    def __init__(
        self,
        *,
        userDefinedAnimationType: str | float,
    ) -> None: ...
    userDefinedAnimationType: Final[str]  # since 1.2

class UserDefinedComponent(Base):
    def __init__(
        self,
        *,
        userDefinedComponentType: str | float,
    ) -> None: ...
    userDefinedComponentType: Final[str]  # since 1.2

class UserDefinedDistribution(Base):
    def __init__(
        self,
        *,
        text: str | None = None,
        type: str | float,
    ) -> None: ...
    type: Final[str]  # since 1.1

class UserDefinedLight(Base):
    def __init__(
        self,
        *,
        userDefinedLightType: str | float,
    ) -> None: ...
    userDefinedLightType: Final[str]  # since 1.2

class UserDefinedValueCondition(Base):
    def __init__(
        self,
        *,
        name: str,
        rule: literals.Rule,
        value: str | float,
    ) -> None: ...
    name: Final[str]
    rule: Final[literals.Rule]
    value: Final[str]

class ValueConstraint(Base):
    def __init__(
        self,
        *,
        rule: literals.Rule,
        value: str | float,
    ) -> None: ...
    rule: Final[literals.Rule]  # since 1.1
    value: Final[str]  # since 1.1

class ValueSetDistribution(Base):
    def __init__(
        self,
        *children: ParameterValueSet | None,
    ) -> None: ...

VariableActionPart: TypeAlias = ModifyAction | SetAction

class VariableAction(Base):
    def __init__(
        self,
        *children: VariableActionPart | None,
        variableRef: str | float,
    ) -> None: ...
    variableRef: Final[str]  # since 1.2

class VariableCondition(Base):
    def __init__(
        self,
        *,
        variableRef: str | float,
        rule: literals.Rule,
        value: str | float,
    ) -> None: ...
    variableRef: Final[str]  # since 1.2
    rule: Final[literals.Rule]  # since 1.2
    value: Final[str]  # since 1.2

class VariableDeclaration(Base):
    def __init__(
        self,
        *,
        name: str,
        variableType: literals.ParameterType,
        value: str | float,
    ) -> None: ...
    name: Final[str]  # since 1.2
    variableType: Final[literals.ParameterType]  # since 1.2
    value: Final[str]  # since 1.2

class VariableDeclarations(Base):
    def __init__(
        self,
        *children: VariableDeclaration | None,
    ) -> None: ...

VehiclePart: TypeAlias = (
    Axles
    | BoundingBox
    | ParameterDeclarations
    | Performance
    | Properties
    | Trailer
    | TrailerCoupler
    | TrailerHitch
)

class Vehicle(Base):
    def __init__(
        self,
        *children: VehiclePart | None,
        name: str,
        vehicleCategory: literals.VehicleCategory,
        mass: float | None = None,
        model3d: str | float | None = None,
        role: literals.Role | None = None,
    ) -> None: ...
    name: Final[str]
    vehicleCategory: Final[literals.VehicleCategory]
    mass: Final[float | None]  # kg, since 1.1
    model3d: Final[str | None]  # since 1.1
    role: Final[literals.Role]  # since 1.2, by default none

class VehicleCatalog(Base):
    def __init__(
        self,
        *children: Directory | None,
    ) -> None: ...

class VehicleCategoryDistribution(Base):
    def __init__(
        self,
        *children: VehicleCategoryDistributionEntry | None,
    ) -> None: ...

class VehicleCategoryDistributionEntry(Base):
    def __init__(
        self,
        *,
        category: literals.VehicleCategory,
        weight: float,
    ) -> None: ...
    category: Final[literals.VehicleCategory]
    weight: Final[float]

class VehicleComponent(Base):
    def __init__(
        self,
        *,
        vehicleComponentType: literals.VehicleComponentType,
    ) -> None: ...
    vehicleComponentType: Final[literals.VehicleComponentType]  # since 1.2

class VehicleLight(Base):
    def __init__(
        self,
        *,
        vehicleLightType: literals.VehicleLightType,
    ) -> None: ...
    vehicleLightType: Final[literals.VehicleLightType]  # since 1.2

class VehicleRoleDistribution(Base):
    def __init__(
        self,
        *children: VehicleRoleDistributionEntry | None,
    ) -> None: ...

class VehicleRoleDistributionEntry(Base):
    def __init__(
        self,
        *,
        role: literals.Role,
        weight: float,
    ) -> None: ...
    role: Final[literals.Role]  # since 1.2
    weight: Final[float]  # since 1.2

VertexPart: TypeAlias = Motion | Position

class Vertex(Base):
    def __init__(
        self,
        *children: VertexPart | None,
        time: float | None = None,
    ) -> None: ...
    time: Final[float | None]  # s

class VisibilityAction(Base):
    def __init__(
        self,
        *children: SensorReferenceSet | None,
        graphics: bool,
        sensors: bool,
        traffic: bool,
    ) -> None: ...
    graphics: Final[bool]
    sensors: Final[bool]
    traffic: Final[bool]

class Waypoint(Base):
    def __init__(
        self,
        *children: Position | None,
        routeStrategy: literals.RouteStrategy,
    ) -> None: ...
    routeStrategy: Final[literals.RouteStrategy]

WeatherPart: TypeAlias = DomeImage | Fog | Precipitation | Sun | Wind

class Weather(Base):
    def __init__(
        self,
        *children: WeatherPart | None,
        cloudState: literals.CloudState | None = None,
        atmosphericPressure: float | None = None,
        temperature: float | None = None,
        fractionalCloudCover: literals.FractionalCloudCover | None = None,
    ) -> None: ...
    cloudState: Final[literals.CloudState | None]  # deprecated since 1.2
    atmosphericPressure: Final[float | None]  # Pa, since 1.1
    temperature: Final[float | None]  # K, since 1.1
    fractionalCloudCover: Final[literals.FractionalCloudCover | None]  # since 1.2

class Wind(Base):
    def __init__(
        self,
        *,
        direction: float,
        speed: float,
    ) -> None: ...
    direction: Final[float]  # rad, since 1.1
    speed: Final[float]  # m/s, since 1.1

class WorldPosition(Base):
    def __init__(
        self,
        *,
        h: float | None = None,
        p: float | None = None,
        r: float | None = None,
        x: float,
        y: float,
        z: float | None = None,
    ) -> None: ...
    h: Final[float]  # rad, by default 0
    p: Final[float]  # rad, by default 0
    r: Final[float]  # rad, by default 0
    x: Final[float]  # m
    y: Final[float]  # m
    z: Final[float]  # m, by default 0
