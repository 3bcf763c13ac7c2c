"""The schemas of OpenSCENARIO XML, from the package of the quality checker of ASAM.

It ends with 1.3. The schema of 1.4 is that of 1.3 with the additions in `tools/xosc_1_4.toml`;
where `OSC2TX_XML_SCHEMA_1_4` names the file of ASAM, it is that file.
"""

import os
import runpy
from functools import cache
from pathlib import Path
from typing import Any

from lxml import etree

TOOL = Path(__file__).parents[3] / "tools" / "make_xosc_schema.py"
OFFICIAL_1_4 = os.environ.get("OSC2TX_XML_SCHEMA_1_4")


@cache
def tool() -> dict[str, Any]:
    """Return what the tool that makes the table of the schemas defines."""
    return runpy.run_path(str(TOOL))


def schema_of(version: str) -> Any:
    """Return the root of the schema of a version."""
    if version == "1.4" and OFFICIAL_1_4:
        return etree.parse(OFFICIAL_1_4).getroot()
    return tool()["schema_of"](version)


@cache
def validator(version: str) -> etree.XMLSchema:
    """Return the schema of a version, which can say what is wrong with a document."""
    return etree.XMLSchema(schema_of(version))
