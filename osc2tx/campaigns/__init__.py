"""Campaigns: a logical scenario run many times, each time with other values.

In order of control flow: `identity` says what a campaign is, `samplers` which values its rows have
(`designs` or tables; a `search` has an aim, of `aims`), `planner` leaves out those that break a
constraint, `engine` runs rows in processes of this machine, `store` keeps their outcomes as
`records`, `driver` leads all of it. `replay` makes the files of one row again, `export` tables of
all. `coverage` counts hits of buckets, `summary` the outcomes of all rows; `report` makes the page
of both, `junit` a document for CI.

A row number has one meaning: what row 17 stands for depends on the scenario, the sampler and the
seed, not on how many rows there are, who runs them and in which order.
"""

from __future__ import annotations

from .store import CampaignError

__all__ = ["CampaignError"]
