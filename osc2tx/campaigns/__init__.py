"""Campaigns: a logical scenario run many times, each time with other values.

In order of control flow: `identity` describes a campaign, `samplers` choose the values of its rows
(`designs` or tables; a `search` has an aim, of `aims`), `planner` leaves out rows that break a
constraint, `engine` runs rows in processes of this machine, `store` keeps their outcomes as
`records`, `driver` leads all of it. `replay` makes the files of one row again, `export` tables of
all. `coverage` counts hits of buckets, `summary` the outcomes of all rows; `report` makes the page
of both, `junit` a document for CI.

A row number has one meaning: row 17 depends on the scenario, the sampler and the seed, not on the
number of rows, nor on where and in which order they run.
"""

from __future__ import annotations

from .store import CampaignError

__all__ = ["CampaignError"]
