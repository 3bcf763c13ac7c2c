"""Small maps in memory for the tests of the OpenDRIVE package."""

from osc2tx_runtime.opendrive import RoadMap, read_map_text

WIDTH = '<width sOffset="0" a="3" b="0" c="0" d="0"/>'
LANES = (
    f'<laneSection s="0"><left><lane id="1" type="driving">{WIDTH}</lane></left>'
    '<center><lane id="0" type="none"/></center>'
    f'<right><lane id="-1" type="driving">{WIDTH}</lane></right></laneSection>'
)


def shape(
    kind: str, length: float, *, s: float = 0.0, x: float = 0.0, y: float = 0.0, h: float = 0.0
) -> str:
    """A geometry element around a shape such as `arc curvature="0.1"`."""
    place = f's="{s!r}" x="{x!r}" y="{y!r}" hdg="{h!r}" length="{length!r}"'
    return f"<geometry {place}><{kind}/></geometry>"


def road_text(
    geometry: str,
    length: float,
    *,
    identity: str = "1",
    lanes: str = LANES,
    extra: str = "",
    link: str = "",
    rule: str = "RHT",
    junction: str = "-1",
) -> str:
    """A road element."""
    return (
        f'<road id="{identity}" length="{length!r}" junction="{junction}" rule="{rule}">'
        f"<link>{link}</link><planView>{geometry}</planView>{extra}<lanes>{lanes}</lanes></road>"
    )


def map_text(*roads: str, rest: str = "") -> str:
    """The text of a map."""
    return f"<OpenDRIVE><header/>{''.join(roads)}{rest}</OpenDRIVE>"


def make_map(*roads: str, rest: str = "") -> RoadMap:
    """A map of roads (and junctions)."""
    return read_map_text(map_text(*roads, rest=rest), "small")


def one_road(kind: str, length: float, **options: str) -> RoadMap:
    """A map with one road of one geometry that begins at the origin along x."""
    return make_map(road_text(shape(kind, length), length, **options))
