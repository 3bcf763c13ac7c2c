"""Trajectories in the run: from where their actor or another one is by then."""

from pathlib import Path
from typing import Any

import pytest

from tests.importing.documents import after, at_time, begin, document, event, imported
from tests.importing.test_measured import report_of

TIMELESS = '<TimeReference><None/></TimeReference><TrajectoryFollowingMode followingMode="follow"/>'
TIMED = (
    '<TimeReference><Timing domainAbsoluteRelative="{}" scale="1" offset="0"/></TimeReference>'
    '<TrajectoryFollowingMode followingMode="follow"/>'
)
CURVE = """<ClothoidSpline>
  <ClothoidSplineSegment curvatureStart="0" curvatureEnd="0.01" length="15"/>
  <ClothoidSplineSegment curvatureStart="0.01" curvatureEnd="-0.01" length="30"/>
  <ClothoidSplineSegment curvatureStart="-0.01" curvatureEnd="0" length="15"/></ClothoidSpline>"""


def follow(shape: str, timing: str = TIMELESS) -> str:
    """Return an action that follows a trajectory."""
    return f"""<RoutingAction><FollowTrajectoryAction>{timing}<TrajectoryRef>
      <Trajectory name="way" closed="false"><Shape>{shape}</Shape></Trajectory></TrajectoryRef>
      </FollowTrajectoryAction></RoutingAction>"""


def corners(*places: str, times: tuple[float, ...] = ()) -> str:
    """Return a polyline."""
    stamps = times or (0.0,) * len(places)
    vertices = (
        f'<Vertex time="{time}"><Position>{place}</Position></Vertex>'
        for time, place in zip(stamps, places, strict=True)
    )
    return f"<Polyline>{''.join(vertices)}</Polyline>"


def beside(name: str, ahead: float, left: float) -> str:
    """Return a position in the lane of an entity."""
    return f'<RelativeLanePosition entityRef="{name}" dLane="0" ds="{ahead}" offset="{left}"/>'


def measured(folder: Path, action: str, seconds: str = "3") -> dict[str, Any]:
    """Return the deviation from the player of a document with a trajectory in the run."""
    text = document(event("Follow", action, at_time(seconds)), end=at_time("7"))
    return dict(report_of(folder, text)["measured"])


@pytest.mark.parametrize(
    "shape",
    [
        corners(beside("other", 0, 0), beside("other", 20, 0), beside("other", 60, 3.5)),
        corners(beside("ego", 40, 3.5), beside("ego", 80, 3.5), beside("ego", 120, 3.5)),
        CURVE,
    ],
    ids=["its own actor", "another actor", "a curve"],
)
def test_a_trajectory_begins_where_actors_are_by_then(shape: str, tmp_path: Path) -> None:
    """They have gone 45 and 60 m by then."""
    found = measured(tmp_path, follow(shape))
    assert found["exact"] is True, found


def test_times_may_count_from_the_start_of_the_run(tmp_path: Path) -> None:
    places = [beside("other", *place) for place in ((0, 0), (45, 0), (75, 3.5), (95, 3.5))]
    shape = corners(*places, times=(3.0, 5.0, 6.0, 7.0))
    assert measured(tmp_path, follow(shape, TIMED.format("absolute")))["exact"] is True


def test_a_trajectory_at_the_start_puts_its_actor_elsewhere(tmp_path: Path) -> None:
    place = '<LanePosition roadId="1" laneId="-2" s="{}" offset="0"/>'
    shape = corners(place.format(300), place.format(400), times=(0.0, 10.0))
    put = begin("other", place.format(130), "10").removesuffix("</Private>")
    action = f"<PrivateAction>{follow(shape, TIMED.format('relative'))}</PrivateAction></Private>"
    text = document("").replace("</Actions></Init>", f"{put}{action}</Actions></Init>")
    report = report_of(tmp_path, text)
    assert report["measured"]["exact"] is True


THING = """<ScenarioObject name="thing"><MiscObject name="box"
  miscObjectCategory="obstacle" mass="1">
  <BoundingBox><Center x="0" y="0" z="0.5"/><Dimensions width="1" length="1" height="1"/>
  </BoundingBox><Properties/></MiscObject></ScenarioObject>"""


def test_an_object_follows_a_trajectory_from_the_start(tmp_path: Path) -> None:
    places = [f'<WorldPosition x="{x}" y="{y}" h="0"/>' for x, y in ((50, 30), (80, 30), (80, 70))]
    shape = corners(*places, times=(0.0, 3.0, 9.0))
    private = (
        f'<Private entityRef="thing"><PrivateAction>{follow(shape, TIMED.format("relative"))}'
        "</PrivateAction></Private>"
    )
    text = document("", end=at_time("8"))
    text = text.replace("</Entities>", f"{THING}</Entities>")
    text = text.replace("</Actions></Init>", f"{private}</Actions></Init>")
    assert "thing.replay_trajectory(" in imported(text).text
    assert report_of(tmp_path, text)["measured"]["exact"] is True


def test_curves_follow_each_other_in_their_directions(tmp_path: Path) -> None:
    """Each begins in the direction in which the one before it ends."""
    curve = '<Clothoid curvature="{}" curvatureDot="0" length="12">{}</Clothoid>'
    own = (
        '<Position><RelativeObjectPosition entityRef="other" dx="0" dy="0">'
        '<Orientation type="relative" h="0"/></RelativeObjectPosition></Position>'
    )
    bends = [follow(curve.format(bend, own)) for bend in (0.06, -0.06, 0.0)]
    text = document(
        event("Left", bends[0], at_time("1"))
        + event("Right", bends[1], after("Left"))
        + event("On", bends[2], after("Right")),
        end=at_time("3.3"),
    )
    found = report_of(tmp_path, text)["measured"]
    assert found["exact"] is True, found
