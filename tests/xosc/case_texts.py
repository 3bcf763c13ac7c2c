"""Texts of scenarios that are made of parts."""

from __future__ import annotations

from collections.abc import Iterable

Case = tuple[str, str]  # name, and what it holds besides the map

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n"
SCENARIO = """
scenario {name}:
    road: map with:
        keep(it.map_file == "{map}.xodr")
{body}"""
EGO = """\
lane(2, at: start)
position(200m, at: start)
speed(20mps)"""


def indented(text: str, levels: int) -> str:
    """Return a text so many levels deeper."""
    return "".join(f"{'    ' * levels}{line}\n" for line in text.strip().splitlines())


def source(cases: Iterable[Case], map_: str = "highway") -> str:
    """Return the source text of a family."""
    texts = (SCENARIO.format(name=name, map=map_, body=indented(body, 1)) for name, body in cases)
    return HEAD + "".join(texts)


def point(name: str, x: float, y: float, z: float = 0.0) -> str:
    """Return the declaration of a point."""
    axes = (("x", x), ("y", y), ("z", z))
    return f"{name}: position_3d with:\n" + "".join(
        f"    keep(it.{axis} == {value:g}m)\n" for axis, value in axes
    )
