"""Completes the reports of the documents of a file with measured deviations."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from functools import cache
from pathlib import Path

from osc2tx import ir
from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.backends.xosc import XmlScenario
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError, Span
from osc2tx.grading.comparison import first_unlike
from osc2tx.grading.findings import find
from osc2tx.grading.measuring import Finding, Measuring
from osc2tx.grading.runs import NoEvidence
from osc2tx.losses.bounds import Metres
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx.support.records import Records
from osc2tx.xosc import read
from osc2tx_runtime import Scenario, ScenarioError
from osc2tx_shared.classes import dataclass, replace

UNLIKE = "the played document deviates from the scenario"
PACKAGES = "actions come from packages of users"
OFF_ROAD = "its road ends during the run, and the motion beyond the end depends on the tool"
FORK = "the road that it takes at a fork of its lane depends on the tool"
BEYOND = "the played document deviates by more than its approximations state"


@dataclass(frozen=True)
class Source:
    """The origin of the documents of a file.

    Attributes:
        module: The program.
        options: Options of the compilation.
        folder: The folder of the file, with maps.
        generate: Generates its separate Python module.
        findings: Findings of earlier builds; `None` if documents are played in any case.
    """

    module: ir.Module
    options: CompileOptions
    folder: Path
    generate: Callable[[], GeneratedModule]
    findings: Records | None = None


def graded(
    documents: Sequence[XmlScenario], source: Source, sink: DiagnosticSink
) -> tuple[XmlScenario, ...]:
    """Return the documents of a file with measured grades.

    Args:
        documents: The documents of the back end.
        source: Their origin.
        sink: Takes an error for each document that contradicts its report.
    """
    if all(each.xml is None for each in documents):
        return tuple(documents)
    if any(map(_is_of_a_package, source.module.scenarios)):  # installed here, not elsewhere
        return tuple(_unmeasured(each, source, sink, PACKAGES) for each in documents)
    try:
        with ExitStack() as stack:
            module = source.generate()
            scenarios = cache(lambda: stack.enter_context(scenarios_of_module(module)))
            return tuple(_graded(each, module, scenarios, source, sink) for each in documents)
    except (ScenarioError, ImportError, InternalCompilerError) as error:
        reason = f"there is no module to run: {error}"
        return tuple(_unmeasured(each, source, sink, reason) for each in documents)


def _is_of_a_package(scenario: ir.Scenario) -> bool:
    """Whether a scenario invokes an action that a package has to bring."""
    known = catalogue().actions
    return any(
        isinstance(node, ir.Invoke) and node.qualified_name not in known
        for node in ir.walk_behaviors(scenario.body)
    )


def _graded(
    found: XmlScenario,
    module: GeneratedModule,
    scenarios: Callable[[], Mapping[str, type[Scenario]]],
    source: Source,
    sink: DiagnosticSink,
) -> XmlScenario:
    """Return a document, graded by its runs.

    Args:
        found: The document.
        module: The module with its scenario.
        scenarios: Loads the scenarios of the module.
        source: The origin of the document.
        sink: Takes an error if the document contradicts its report.
    """
    if found.xml is None:
        return found
    options = source.options.xml

    def measure() -> Finding:
        return Measuring(found, scenarios()[found.name], options, source.folder).run()

    try:
        known, files = source.findings, _files(source.module)
        finding = find(known, found, module, files, options, measure) if known else measure()
    except NoEvidence as error:
        return _unmeasured(found, source, sink, str(error))
    report, deviation = found.report, finding.deviation
    stated = [each.bound for each in report.approximations]
    span = None if finding.is_faithful else _blamed(found, finding)
    is_of_tool = deviation.is_off_road or deviation.is_at_fork
    is_explained = report.measure(finding.measured, None if is_of_tool else span)
    if span is None or not all(isinstance(bound, Metres) for bound in stated):
        return _allowed(found)
    if is_explained:
        return _settled(found, source, sink)
    construct = report.construct_at(span, "action")
    what = OFF_ROAD if deviation.is_off_road else BEYOND if stated else UNLIKE
    what = FORK if deviation.is_at_fork else what
    if what is BEYOND:
        report.cannot(construct, span, f"{BEYOND}; {finding.measured}")
    else:
        bound = "it may take another road" if what is FORK else str(finding.measured)
        report.approximate(construct, span, what, bound)
    if what is BEYOND or (report.obstacles and source.options.target == "xosc"):
        _complain(sink, construct, span, what, finding)
    return _allowed(found)


def _files(module: ir.Module) -> dict[str, str]:
    """Return the sources of the scenarios of a module, by their names."""
    return {each.name: each.span.source.name for each in (*module.bases, *module.scenarios)}


def unplayed(
    documents: Sequence[XmlScenario], source: Source, sink: DiagnosticSink
) -> tuple[XmlScenario, ...]:
    """Return the documents of a file where none is played: their reports state this."""
    return tuple(_unmeasured(each, source, sink, "`--no-verify`") for each in documents)


def _settled(found: XmlScenario, source: Source, sink: DiagnosticSink) -> XmlScenario:
    """Return a document after what was open is approximated, which may not be accepted."""
    if source.options.target == "xosc":
        found.report.tell_obstacles(sink)
    return _allowed(found)


def _unmeasured(
    found: XmlScenario, source: Source, sink: DiagnosticSink, reason: str
) -> XmlScenario:
    """Return a document as it is, with the reason why it is not measured."""
    if found.xml is None:
        return found
    found.report.leave_unmeasured(reason)
    return _settled(found, source, sink)


def _allowed(found: XmlScenario) -> XmlScenario:
    """Return a document; without XML if its report as it is now does not allow it."""
    return found if found.report.is_expressible else replace(found, xml=None, parameters=None)


def _blamed(found: XmlScenario, finding: Finding) -> Span:
    """Return the member of the scenario during which the document begins to deviate."""
    assert found.xml is not None, "it was played"
    members = {str(span): span for span in found.origins.values()}
    where = first_unlike(read(found.xml), found.origins, finding.starts, finding.deviation)
    return members[where] if where else next(iter(found.report.entries)).span


def _complain(
    sink: DiagnosticSink, construct: str, span: Span, what: str, finding: Finding
) -> None:
    notes = list(finding.deviation.problems)
    notes += [
        f"`{actor}` is {each.place:.2g} m off at {each.at:g} s"
        for actor, each in finding.deviation.actors.items()
        if each.since < float("inf")
    ]
    message = f"{construct}: {what}; {finding.measured}"
    remedy = "" if what is BEYOND else "`--allow-approx` accepts a measured deviation"
    remedy = "; ".join(filter(None, (remedy, "`--no-verify` does not play documents")))
    sink.report("OSC518", span, message, notes=notes, help=remedy)
