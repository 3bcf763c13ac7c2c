"""Execution of the lines in order."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.connection import TIMEOUT
from osc2tx_runtime.worlds import CheckRequest, CheckResult

from . import contact, driving, motion, surroundings
from .probe import LINES, Finding, Line, Probe, differs, unknown

CONTACT = 5  # the last line that the others need

assert contact and driving and motion and surroundings  # they have declared their lines


def check(request: CheckRequest) -> Iterator[CheckResult]:
    """Check a server; later lines use the findings of earlier ones.

    Raises:
        SimulatorError: CARLA's client library has no version for this system.
    """
    probe = Probe(request, ClientProcess(request.world.options.get("carla_timeout", TIMEOUT)))
    lost = False
    try:
        for number in sorted(LINES):
            line = LINES[number]
            finding = unknown("no contact") if lost else _found(line, probe)
            lost = lost or (number <= CONTACT and finding.status == "differs")
            yield CheckResult(
                number,
                line.name,
                *finding,
                blocks=line.blocks and finding.status == "differs",
            )
    finally:
        probe.close()
        probe.client.close()


def _found(line: Line, probe: Probe) -> Finding:
    if line.drives and not probe.request.drives:
        return unknown("not tried", "--drive spawns and moves actors to find out")
    if line.of_map and probe.is_other_map:
        return unknown("the map of the scenario is not loaded")
    try:
        return line.look(probe)
    except ScenarioError as error:
        return differs(error.message, "")
