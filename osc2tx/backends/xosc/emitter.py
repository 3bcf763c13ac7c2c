"""Entry of the back end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath

from osc2tx import ir
from osc2tx.backends.xosc import (
    actions,
    environment,
    gaps,
    lateral,
    paths,
    places,
    positions,
    rates,
    signals,
    speed_modifiers,
    trailers,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.document import entry_scenarios, make_document
from osc2tx.backends.xosc.facts import read_signal, read_spawn
from osc2tx.backends.xosc.names import Names
from osc2tx.backends.xosc.parameters import (
    OpenParameter,
    distribution,
    nominal_values,
    open_parameters,
    unfaithful,
)
from osc2tx.backends.xosc.report import NOTHING, Inexpressible, LossReport, Remedy
from osc2tx.backends.xosc.tree import Element, serialize
from osc2tx.light_dataclass import dataclass
from osc2tx.options import XmlOptions

HANDLERS = (
    actions,
    environment,
    gaps,
    lateral,
    paths,
    places,
    positions,
    rates,
    signals,
    speed_modifiers,
    trailers,
)
"""Modules that register handlers when they are imported."""


@dataclass(frozen=True, slots=True)
class XmlScenario:
    """One scenario as XML.

    Attributes:
        name: Of the scenario.
        infix: What stands in the names of its files between stem and suffix.
        xml: The document; `None` if something in it cannot be said.
        parameters: A document with the values that open parameters may have; `None` without any.
        report: What became of its constructs.
        report_json: The same as JSON.
        map_places: Where its map was looked for, so that a change is noticed.
    """

    name: str
    infix: str
    xml: str | None
    parameters: str | None
    report: LossReport
    report_json: str
    map_places: tuple[Path, ...]


def emit(
    module: ir.Module, options: XmlOptions, folder: Path | None, stem: str | None = None
) -> tuple[XmlScenario, ...]:
    """Write down the scenarios of a file.

    Args:
        module: The verified IR.
        options: What was chosen.
        folder: Where the source lies; maps are looked for there.
        stem: What the names of the documents begin with; by default that of the source.
    """
    scenarios = entry_scenarios(module)
    stem = PurePosixPath(module.source).stem if stem is None else stem
    return tuple(
        _Emission(scenario, module, options, folder).run(f"{stem}{infix}", infix)
        for scenario, infix in zip(scenarios, _infixes(scenarios), strict=True)
    )


def _infixes(scenarios: Sequence[ir.Scenario]) -> list[str]:
    """Return what tells the documents of several scenarios of a file apart, even without case."""
    if len(scenarios) == 1:
        return [""]
    names = Names(folds_case=True)
    return [f".{names.new(scenario.name)}" for scenario in scenarios]


class _Emission:
    """Writes down one scenario."""

    def __init__(
        self, scenario: ir.Scenario, module: ir.Module, options: XmlOptions, folder: Path | None
    ) -> None:
        self._scenario = scenario
        self._module = module
        self._options = options
        self._folder = folder
        self._open = open_parameters(scenario, Names())

    def run(self, name: str, infix: str) -> XmlScenario:
        """Return the document called `name`, and what goes with it."""
        ctx, document, kept = self._document()
        if document is not None:
            self._report_parameters(ctx, kept)
        xml = parameters = None
        if document is not None and ctx.report.is_expressible:
            version = self._options.version
            xml = serialize(document, version)
            if kept and version >= "1.1":
                (header,) = (part for part in document.children if part.name == "FileHeader")
                values = distribution(header, kept, self._scenario, f"{name}.xosc")
                parameters = serialize(values, version)
        return XmlScenario(
            name=self._scenario.name,
            infix=infix,
            xml=xml,
            parameters=parameters,
            report=ctx.report,
            report_json=ctx.report.to_json(self._scenario.name, self._module.source),
            map_places=ctx.map_places,
        )

    def _document(self) -> tuple[Context, Element | None, tuple[OpenParameter, ...]]:
        """Return the document with those parameters for whose values it is right."""
        kept = self._open
        while True:
            ctx, document = self._write(kept, nominal_values(self._open))
            if document is None or not ctx.report.is_expressible or not kept:
                return ctx, document, kept
            wrong = unfaithful(document, kept, self._scenario, self._concrete)
            if not wrong:
                return ctx, document, kept
            kept = tuple(parameter for parameter in kept if parameter not in wrong)

    def _concrete(self, point: Mapping[str, float]) -> Element | None:
        """Return the document for values of the open parameters."""
        ctx, document = self._write((), {**nominal_values(self._open), **point})
        return document if ctx.report.is_expressible else None

    def _write(
        self, parameters: Sequence[OpenParameter], given: Mapping[str, float]
    ) -> tuple[Context, Element | None]:
        options = self._options
        ctx = Context(self._scenario, self._module, options, self._folder, parameters, given)
        if options.version not in ctx.profile.versions:
            known = ", ".join(ctx.profile.versions)
            reason = f"{ctx.profile.name} reads OpenSCENARIO XML {known} only"
            ctx.report.cannot("version", self._scenario.span, reason)
        for read, texts in ((read_signal, options.signals), (read_spawn, options.spawns)):
            for text in texts:
                try:
                    read(text)
                except Inexpressible as error:
                    ctx.report.cannot("option", self._scenario.span, error.reason)
                    return ctx, None
        try:
            return ctx, make_document(ctx)
        except Inexpressible as error:  # what is told above all of the scenario
            ctx.report.cannot(
                "scenario", error.span or self._scenario.span, error.reason, error.remedy
            )
            return ctx, None

    def _report_parameters(self, ctx: Context, kept: Sequence[OpenParameter]) -> None:
        """Say which parameters can still be chosen, and what the others are."""
        known = {parameter.declaration: parameter for parameter in self._open}
        for scope in ctx.scope.all():
            for declaration in scope.scenario.declarations:
                if not isinstance(declaration, ir.Parameter) or declaration.value is not None:
                    continue
                parameter = known.get(declaration) if scope is ctx.scope else None
                is_drawn = isinstance(declaration.domain, (ir.RangeValue, ir.Choices))
                if parameter is not None or (
                    is_drawn and not scope.values.is_given(declaration.name)
                ):
                    is_kept = parameter in kept
                    self._report_parameter(ctx, declaration, parameter, is_kept=is_kept)

    def _report_parameter(
        self,
        ctx: Context,
        declaration: ir.Parameter,
        parameter: OpenParameter | None,
        *,
        is_kept: bool,
    ) -> None:
        construct = f"parameter {declaration.name}"
        told = f" of {parameter.told()}" if parameter is not None else ""
        if is_kept and ctx.version >= "1.1":
            ctx.report.exact(construct, declaration.span, f"any{told}, as the document's own")
            return
        if is_kept:
            reason = "OpenSCENARIO XML 1.0 has parameters, but no ranges for them"
            remedy = Remedy(version="1.1")
        else:
            reason = "what is written down depends on it in a way that no expression can say"
            remedy = NOTHING
        value = f" is {parameter.nominal:g}{told}" if parameter else " is one value"
        bound = f"every run is one that the scenario allows; {declaration.name}{value}"
        ctx.report.approximate(construct, declaration.span, reason, bound, remedy)
