"""The run report: one self-contained HTML file made from a trace and, if known, the road map."""

from __future__ import annotations

from .page import render_report

__all__ = ["render_report"]
