"""What can be wrong with a campaign."""

from __future__ import annotations

__all__ = ["CampaignError"]


class CampaignError(Exception):
    """A campaign cannot be run, or its store cannot be used; the message says what to do."""
