"""How long an import of OpenSCENARIO XML takes, and whether that grows linearly.

    python benchmarks/importing.py [--size MB] [shape ...]

Each shape is a document of about `--size` (1 MB), and of half and a quarter of it. Printed are CPU
seconds of the import (document to text of the scenario, without its check and its run), the least
of a few runs; the share of the reader; what the import takes as a multiple of lxml's parse of the
same bytes, and of `python -c "import antlr4"`, which is there in any start; and the exponents of
growth from size to size, 1.00 being linear.
"""

from __future__ import annotations

import argparse
import gc
import math
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from itertools import pairwise

from lxml import etree

from osc2tx.importing.importer import import_document
from osc2tx.importing.libraries import Library
from osc2tx.start import collect_rarely
from osc2tx.xosc import read

STEP = '<SpeedActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/>'
LINEAR = '<SpeedActionDynamics dynamicsShape="linear" dynamicsDimension="time" value="2"/>'
VEHICLE = """<Vehicle name="car" vehicleCategory="car"><BoundingBox>
<Center x="1.4" y="0" z="0.8"/><Dimensions width="2" length="5" height="1.6"/></BoundingBox>
<Performance maxSpeed="70" maxDeceleration="10" maxAcceleration="10"/><Axles>
<FrontAxle maxSteering="0.5" wheelDiameter="0.6" trackWidth="1.7" positionX="2.8" positionZ="0.3"/>
<RearAxle maxSteering="0" wheelDiameter="0.6" trackWidth="1.7" positionX="0" positionZ="0.3"/>
</Axles><Properties/></Vehicle>"""


def condition(inner: str) -> str:
    """Return a trigger by a value."""
    return f"""<ConditionGroup><Condition name="c" delay="0" conditionEdge="none">
<ByValueCondition>{inner}</ByValueCondition></Condition></ConditionGroup>"""


def at(seconds: float) -> str:
    """Return a trigger at a time."""
    return condition(f'<SimulationTimeCondition value="{seconds}" rule="greaterOrEqual"/>')


def after(event: str) -> str:
    """Return a trigger at the end of an event."""
    return condition(
        f'<StoryboardElementStateCondition storyboardElementType="event" '
        f'storyboardElementRef="{event}" state="completeState"/>'
    )


def event(name: str, action: str, trigger: str) -> str:
    """Return an event."""
    return f"""<Event name="{name}" priority="override"><Action name="{name}_action">
<PrivateAction>{action}</PrivateAction></Action><StartTrigger>{trigger}</StartTrigger></Event>"""


def speed(value: float, dynamics: str = LINEAR) -> str:
    """Return a change of the speed."""
    return f"""<LongitudinalAction><SpeedAction>{dynamics}<SpeedActionTarget>
<AbsoluteTargetSpeed value="{value}"/></SpeedActionTarget></SpeedAction></LongitudinalAction>"""


def group(actor: str, events: str) -> str:
    """Return a group with one maneuver of one actor."""
    return f"""<ManeuverGroup name="group_{actor}" maximumExecutionCount="1">
<Actors selectTriggeringEntities="false"><EntityRef entityRef="{actor}"/></Actors>
<Maneuver name="maneuver_{actor}">{events}</Maneuver></ManeuverGroup>"""


def document(cars: int, groups: str) -> bytes:
    """Return a document with cars in a row."""
    names = [f"car_{each}" for each in range(cars)]
    entities = "".join(
        f'<ScenarioObject name="{name}">{VEHICLE}</ScenarioObject>' for name in names
    )
    starts = "".join(
        f'<Private entityRef="{name}"><PrivateAction><TeleportAction><Position><LanePosition '
        f'roadId="1" laneId="-2" s="{20 + 10 * index}" offset="0"/></Position></TeleportAction>'
        f"</PrivateAction><PrivateAction>{speed(20, STEP)}</PrivateAction></Private>"
        for index, name in enumerate(names)
    )
    return f"""<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="2024-01-01T00:00:00"
description="Many" author="us"/><CatalogLocations/><RoadNetwork/><Entities>{entities}</Entities>
<Storyboard><Init><Actions>{starts}</Actions></Init><Story name="story"><Act name="act">{groups}
<StartTrigger>{at(0)}</StartTrigger></Act></Story><StopTrigger>{at(60)}</StopTrigger></Storyboard>
</OpenSCENARIO>""".encode()


def chain(n: int) -> bytes:
    """Events, each at the end of the one before."""
    events = "".join(
        event(f"e_{k}", speed(10 + k % 20), after(f"e_{k - 1}") if k else at(1)) for k in range(n)
    )
    return document(1, group("car_0", events))


def times(n: int) -> bytes:
    """Events at times."""
    events = "".join(event(f"e_{k}", speed(10 + k % 20), at(3 * k + 1)) for k in range(n))
    return document(1, group("car_0", events))


def fleet(n: int) -> bytes:
    """Cars with an event each."""
    groups = (group(f"car_{k}", event(f"e_{k}", speed(10), at(k % 9 + 1))) for k in range(n))
    return document(n, "".join(groups))


def trajectory(n: int) -> bytes:
    """A polyline of many points."""
    points = "".join(
        f'<Vertex time="{k / 10}"><Position><WorldPosition x="{2 * k}" y="{(k % 7) / 10}" h="0"/>'
        "</Position></Vertex>"
        for k in range(n)
    )
    action = f"""<RoutingAction><FollowTrajectoryAction><TrajectoryRef><Trajectory name="t"
closed="false"><Shape><Polyline>{points}</Polyline></Shape></Trajectory></TrajectoryRef>
<TimeReference><None/></TimeReference><TrajectoryFollowingMode followingMode="position"/>
</FollowTrajectoryAction></RoutingAction>"""
    return document(1, group("car_0", event("e", action, at(1))))


SHAPES: Mapping[str, Callable[[int], bytes]] = {
    "chain": chain,
    "times": times,
    "fleet": fleet,
    "trajectory": trajectory,
}


def cpu(action: Callable[[], object], rounds: int = 3) -> float:
    """Return the least CPU seconds of some runs."""
    gc.collect()
    found = []
    for _ in range(rounds):
        start = time.process_time()
        action()
        found.append(time.process_time() - start)
    return min(found)


def start_of_antlr() -> float:
    """Return CPU seconds of a process that only imports the runtime of the parser."""
    code = "import time, antlr4; print(time.process_time())"
    runs = (subprocess.run([sys.executable, "-c", code], capture_output=True) for _ in range(5))
    return min(float(run.stdout) for run in runs)


def sized(shape: Callable[[int], bytes], size: float) -> bytes:
    """Return a document of about a size (bytes)."""
    few = len(shape(8))
    each = (len(shape(16)) - few) / 8
    return shape(max(2, 8 + round((size - few) / each)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("shapes", nargs="*", metavar="shape", help=", ".join(SHAPES))
    parser.add_argument("--size", type=float, default=1.0, metavar="MB")
    arguments = parser.parse_args()
    collect_rarely()  # as the command line does
    antlr = start_of_antlr()
    print(f"import antlr4: {antlr:.3f} s")
    import_document(chain(8), "warm.xosc", Library())
    print(
        f"{'shape':12} {'MB':>6} {'import':>8} {'reader':>7} {'x lxml':>7} {'x antlr4':>9}  growth"
    )
    for name in arguments.shapes or SHAPES:
        points = []
        for part in (4, 2, 1):
            data = sized(SHAPES[name], arguments.size * 1e6 / part)
            seconds = cpu(lambda data=data: import_document(data, "a.xosc", Library()))
            points.append((len(data), seconds))
        reader = cpu(lambda data=data: read(data))
        lxml = cpu(lambda data=data: etree.fromstring(data), 7)
        growth = (
            math.log(after[1] / before[1]) / math.log(after[0] / before[0])
            for before, after in pairwise(points)
        )
        shown = " ".join(f"{each:.2f}" for each in growth)
        print(
            f"{name:12} {len(data) / 1e6:6.2f} {seconds:7.2f}s {reader / seconds:7.0%}"
            f" {seconds / lxml:7.0f} {seconds / antlr:9.1f}  {shown}"
        )


if __name__ == "__main__":
    main()
