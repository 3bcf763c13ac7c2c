"""The outputs of a compilation: files, and facts for reports as plain data."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from osc2tx.compilation.file_reports import LossEntry
from osc2tx.diagnostics.report import ScenarioEntry
from osc2tx.support.paths import COVERAGE_MODEL, LOSS_REPORT, MODULE, PARAMETERS, SOURCE_MAP, XML
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx.analysis import Analysis, ScenarioLevel
    from osc2tx.backends.py_trees.emitter import GeneratedModule
    from osc2tx.backends.xosc.emitter import XmlScenario
    from osc2tx.diagnostics import DiagnosticSink
    from osc2tx.ir import Module
    from osc2tx.semantics import SemanticModel


@dataclass(frozen=True, slots=True)
class Output:
    """A file that a source makes: `stem` of its compilation, then `suffix`, holds `text`."""

    suffix: str
    text: str


def files_of_module(module: GeneratedModule) -> tuple[Output, ...]:
    """Return the Python module, its source map, and its sampled values, if it samples any."""
    written = (
        (MODULE, module.python),
        (SOURCE_MAP, module.source_map),
        (COVERAGE_MODEL, module.coverage_model),
    )
    return tuple(Output(suffix, text) for suffix, text in written if text is not None)


def files_of_xml(scenarios: Sequence[XmlScenario]) -> tuple[Output, ...]:
    """Return scenarios as OpenSCENARIO XML, each with its report and files."""
    return tuple(
        Output(f"{scenario.infix}{suffix}", text)
        for scenario in scenarios
        for suffix, text in (
            (XML, scenario.xml),
            (PARAMETERS, scenario.parameters),
            (LOSS_REPORT, scenario.report_json),
        )
        if text is not None
    )


def loss_of(scenario: XmlScenario) -> LossEntry:
    """Return the result of a scenario as OpenSCENARIO XML as plain data, for reports."""
    report = scenario.report
    reasons = dict.fromkeys(f"{each.construct}: {each.reason}" for each in report.losses)
    return LossEntry(
        scenario.name, scenario.xml is not None, report.summary(), tuple(sorted(reasons))
    )


def report_losses(scenarios: Iterable[XmlScenario], sink: DiagnosticSink) -> None:
    """Report the obstacles to XML."""
    for scenario in scenarios:
        scenario.report.tell_obstacles(sink)


def entries_of(
    levels: Sequence[ScenarioLevel],
    model: SemanticModel,
    analysis: Analysis,
    lowered: Module | None,
) -> tuple[ScenarioEntry, ...]:
    """Return the levels of scenarios as plain data, for reports.

    Args:
        levels: The level of each scenario.
        model: The program.
        analysis: The analysis of its constraints.
        lowered: The program in the IR, which states what can run by itself; `None` before that.
    """
    from osc2tx.analysis.levels import fixed_values

    scenarios = () if lowered is None else lowered.scenarios
    runnable = {each.name for each in scenarios if each.is_runnable}
    return tuple(
        ScenarioEntry(
            source=found.scenario.span.source,
            name=found.scenario.qualified_name,
            level=found.level.value,
            open=tuple(opening.text for opening in found.open),
            summary=str(found),
            is_runnable=found.scenario.actor is None and found.scenario.qualified_name in runnable,
            values=fixed_values(model, found.scenario, analysis.constraints),
        )
        for found in levels
    )
