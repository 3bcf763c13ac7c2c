"""Elements of a map that are not read."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from lxml import etree

from .xml_reader import parse_xml

READ = frozenset(
    {
        *("OpenDRIVE", "header", "geoReference", "offset"),
        *("road", "link", "predecessor", "successor", "planView", "geometry"),
        *("line", "arc", "spiral", "poly3", "paramPoly3"),
        *("elevationProfile", "elevation", "lateralProfile", "superelevation"),
        *("shape", "crossSectionSurface", "tOffset", "surfaceStrips", "strip"),
        *("constant", "linear", "quadratic", "cubic", "coefficients"),
        *("lanes", "laneOffset", "laneSection", "left", "center", "right"),
        *("lane", "width", "border", "height"),
        *("signals", "signal", "signalReference", "validity", "objects"),
        *("junction", "connection", "laneLink", "controller", "control"),
    }
)
"""The types of objects that are read, besides crosswalks."""


def unread_elements(path: Path) -> tuple[tuple[str, int], ...]:
    """Elements of a file that are not read, with their number, the most frequent first.

    Raises:
        MapError: The file cannot be read.
    """
    root = parse_xml(path)
    for element in list(root.iter("object")):
        parent = element.getparent()
        if element.get("type") == "crosswalk" and parent is not None:
            parent.remove(element)
    tags = [str(e.tag) for e in root.iter(etree.Element) if e.tag not in READ]
    return tuple(sorted(Counter(tags).items(), key=lambda item: (-item[1], item[0])))
