"""Small documents, and what becomes of them."""

from pathlib import Path

from osc2tx.compilation.driver import Compilation
from osc2tx.importing.importer import Imported, import_document
from osc2tx.importing.libraries import Library
from osc2tx.options import CompileOptions

CAR = """<Vehicle name="car" vehicleCategory="car">
  <BoundingBox><Center x="1.4" y="0" z="0.8"/>
  <Dimensions width="2" length="5" height="1.6"/></BoundingBox>
  <Performance maxSpeed="70" maxDeceleration="10" maxAcceleration="10"/>
  <Axles><FrontAxle maxSteering="0.5" wheelDiameter="0.6" trackWidth="1.7" positionX="2.8"
  positionZ="0.3"/><RearAxle maxSteering="0" wheelDiameter="0.6" trackWidth="1.7" positionX="0"
  positionZ="0.3"/></Axles>
  <Properties/></Vehicle>"""

AT_ONCE = '<SpeedActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/>'


def begin(name: str, place: str, speed: str) -> str:
    """Return how an entity begins."""
    return f"""<Private entityRef="{name}">
      <PrivateAction><TeleportAction><Position>{place}</Position></TeleportAction></PrivateAction>
      <PrivateAction><LongitudinalAction><SpeedAction>{AT_ONCE}<SpeedActionTarget>
      <AbsoluteTargetSpeed value="{speed}"/></SpeedActionTarget></SpeedAction></LongitudinalAction>
      </PrivateAction></Private>"""


def event(name: str, actions: str, conditions: str, priority: str = "override") -> str:
    """Return an event."""
    return f"""<Event name="{name}" priority="{priority}">
      <Action name="{name}Action"><PrivateAction>{actions}</PrivateAction></Action>
      <StartTrigger><ConditionGroup>{conditions}</ConditionGroup></StartTrigger></Event>"""


def speed_change(value: str, time: str = "4", shape: str = "linear") -> str:
    """Return a change of the speed in a time."""
    return f"""<LongitudinalAction><SpeedAction>
      <SpeedActionDynamics dynamicsShape="{shape}" dynamicsDimension="time" value="{time}"/>
      <SpeedActionTarget><AbsoluteTargetSpeed value="{value}"/></SpeedActionTarget>
      </SpeedAction></LongitudinalAction>"""


def lane_change(lanes: int, time: str = "3") -> str:
    """Return a change of the lane of `other`."""
    return f"""<LateralAction><LaneChangeAction>
      <LaneChangeActionDynamics dynamicsShape="sinusoidal" dynamicsDimension="time" value="{time}"/>
      <LaneChangeTarget><RelativeTargetLane entityRef="other" value="{lanes}"/></LaneChangeTarget>
      </LaneChangeAction></LateralAction>"""


def at_time(seconds: str) -> str:
    """Return a condition on the time."""
    return f"""<Condition name="time" delay="0" conditionEdge="none"><ByValueCondition>
      <SimulationTimeCondition value="{seconds}" rule="greaterOrEqual"/></ByValueCondition>
      </Condition>"""


def after(name: str, delay: str = "0") -> str:
    """Return a condition on the end of an event."""
    return f"""<Condition name="after" delay="{delay}" conditionEdge="none"><ByValueCondition>
      <StoryboardElementStateCondition storyboardElementType="event" storyboardElementRef="{name}"
      state="completeState"/></ByValueCondition></Condition>"""


def document(events: str, end: str = "", parameters: str = "", ego_speed: str = "20") -> str:
    """Return a document with two cars on the built-in highway, of which `other` has events."""
    lane = '<LanePosition roadId="1" laneId="-3" s="100" offset="0"/>'
    beside = '<RelativeLanePosition entityRef="ego" dLane="1" ds="30" offset="0"/>'
    story = f"""<Story name="Story"><Act name="Act">
      <ManeuverGroup name="Group" maximumExecutionCount="1">
      <Actors selectTriggeringEntities="false"><EntityRef entityRef="other"/></Actors>
      <Maneuver name="Maneuver">{events}</Maneuver></ManeuverGroup></Act></Story>"""
    return f"""<?xml version="1.0" encoding="UTF-8"?>
    <OpenSCENARIO>
      <FileHeader revMajor="1" revMinor="3" date="2024-01-01T00:00:00" description="Two cars"
      author="us"/>
      <ParameterDeclarations>{parameters}</ParameterDeclarations>
      <CatalogLocations/>
      <RoadNetwork><LogicFile filepath="highway.xodr"/></RoadNetwork>
      <Entities><ScenarioObject name="ego">{CAR}</ScenarioObject>
      <ScenarioObject name="other">{CAR}</ScenarioObject></Entities>
      <Storyboard>
        <Init><Actions>
        {begin("ego", lane, ego_speed)}{begin("other", beside, "15")}
        </Actions></Init>
        {story if events else ""}
        <StopTrigger><ConditionGroup>{end or at_time("12")}</ConditionGroup></StopTrigger>
      </Storyboard>
    </OpenSCENARIO>"""


def imported(text: str) -> Imported:
    """Return what becomes of a document."""
    return import_document(text.encode(), "test.xosc", Library(), name="two_cars")


def faults(found: Imported) -> list[str]:
    """Return what a check finds in a scenario."""
    compilation = Compilation(
        Path("two_cars.osc"), "two_cars.osc", CompileOptions(), text=found.text
    )
    assert compilation.module is not None, found.text
    return [each.message for each in compilation.sink.sorted()]
