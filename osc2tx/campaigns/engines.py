"""Engines by name."""

from __future__ import annotations

from osc2tx.campaigns.cluster import DaskEngine
from osc2tx.campaigns.engine import Engine, LocalEngine
from osc2tx.campaigns.errors import CampaignError

__all__ = ["engine_by_name"]


def engine_by_name(
    name: str, batch: int, processes: int, workers: int | None, timeout: float | None = None
) -> Engine:
    """Return an engine.

    Args:
        name: `local`, or `dask://HOST:PORT`.
        batch: How many rows a worker has at once.
        processes: How many workers there are here if `workers` does not say.
        workers: How many are wanted.
        timeout: Seconds by the clock that a row may take.

    Raises:
        CampaignError: There is none of this name, or it cannot do what is wanted.
    """
    if name == "local":
        return LocalEngine(workers or processes, batch, timeout)
    scheme, _, address = name.partition("://")
    host, _, port = address.rpartition(":")
    if scheme != "dask" or not host or not port.isdecimal():
        raise CampaignError(f"--engine {name}: there is local and dask://HOST:PORT")
    for option, value in (("--workers", workers), ("--timeout", timeout)):
        if value is not None:
            raise CampaignError(
                f"{option} is for --engine local: a cluster has its own workers, and a row there"
                " cannot be ended from here"
            )
    return DaskEngine(address, batch)
