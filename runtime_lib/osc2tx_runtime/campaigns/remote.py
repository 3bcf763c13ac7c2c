"""Runs rows for a driver on another machine, in the processes of a cluster.

All inputs are sent with the rows: the module and the map are in a `Parcel`, which a process unpacks
once. So a machine of the cluster needs only this package and that of the cluster, and no files.
"""

from __future__ import annotations

import hashlib
import json
import tempfile
from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from threading import Lock

from osc2tx_runtime.errors import ScenarioError, message_of
from osc2tx_shared.classes import dataclass, replace

from .executor import Executor
from .rows import Plan, Row, RowResult
from .worker import Refused


@dataclass(frozen=True, slots=True)
class Parcel:
    """A plan with the files that it needs.

    Attributes:
        plan: The common part of the rows; it names no files.
        maps: The map, name to content; empty if it is a map of this package.
        runtime: The version of this package that the rows are for.
        digest: SHA-256 of the attributes above.
    """

    plan: Plan
    maps: Mapping[str, bytes]
    runtime: str
    digest: str


def parcel_of(plan: Plan) -> Parcel:
    """Pack a plan.

    Raises:
        ScenarioError: Its map does not exist.
    """
    maps: dict[str, bytes] = {}
    if plan.settings.map_path:
        executor = Executor(plan)
        try:
            place = executor.map_path(Row(0, 0))
        finally:
            executor.close()
        maps[place.name] = place.read_bytes()
    plan = replace(plan, settings=replace(plan.settings, map_path=()))
    digests = {name: hashlib.sha256(content).hexdigest() for name, content in maps.items()}
    text = json.dumps([repr(plan), digests])
    return Parcel(plan, maps, _runtime(), hashlib.sha256(text.encode()).hexdigest())


def unchanged(parcel: Parcel) -> Parcel:
    """Return a parcel: the task that stores it in a cluster, also after a loss."""
    return parcel


def run_rows(parcel: Parcel, rows: Sequence[Row]) -> list[RowResult] | Refused:
    """Run rows; one process runs one row at a time, whatever its number of threads."""
    if parcel.runtime != _runtime():
        return Refused(
            f"a worker has osc2tx-runtime {_runtime()}, the campaign is run with {parcel.runtime}:"
            " install the same version there"
        )
    with _LOCK:
        try:
            executor = _HELD.executor_of(parcel)
        except ScenarioError as error:
            return Refused(error.message)
        except Exception as error:  # any exception of the module
            return Refused(message_of(error))
        return [executor.run(row) for row in rows]


class _Held:
    """The parcel that was unpacked last: the modules of two parcels would mix."""

    def __init__(self) -> None:
        self._digest = ""
        self._executor: Executor | None = None
        self._folder: tempfile.TemporaryDirectory[str] | None = None

    def executor_of(self, parcel: Parcel) -> Executor:
        if self._executor is None or self._digest != parcel.digest:
            self._forget()
            self._executor = self._unpacked(parcel)
            self._digest = parcel.digest
        return self._executor

    def _unpacked(self, parcel: Parcel) -> Executor:
        self._folder = tempfile.TemporaryDirectory(prefix="osc2tx-maps-")
        places = [Path(self._folder.name, name) for name in parcel.maps]
        for place in places:
            place.write_bytes(parcel.maps[place.name])
        settings = replace(parcel.plan.settings, map_path=tuple(places))
        return Executor(replace(parcel.plan, settings=settings))

    def _forget(self) -> None:
        if self._executor is not None:
            self._executor.close()
            self._executor = None
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None


_HELD, _LOCK = _Held(), Lock()


def _runtime() -> str:
    try:
        return version("osc2tx-runtime")
    except PackageNotFoundError:  # run from a folder of sources
        return "of unknown version"
