"""The page of a campaign, from plain data."""

from __future__ import annotations

from .html import fill, resource
from .json_values import Json

__all__ = ["render_campaign"]


def render_campaign(data: Json) -> str:
    """Return the page as text; the same data give the same text.

    Args:
        data: A summary, coverage, and columns of rows, as `osc2tx campaign report` collects them.
    """
    script = "\n".join(resource(name) for name in ("base.js", "campaign.js", "parallel.js"))
    style = "\n".join(resource(name) for name in ("report.css", "campaign.css"))
    return fill(resource("campaign.html"), style, script, data)
