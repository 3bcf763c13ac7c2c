"""Entry of the back end: IR in, documents and loss reports out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path, PurePosixPath
from types import MappingProxyType

from osc2tx import ir
from osc2tx.backends.xosc import actions
from osc2tx.backends.xosc.conditions.comparisons import speeds_read
from osc2tx.backends.xosc.context import Context, Outlook
from osc2tx.backends.xosc.document import make_document
from osc2tx.backends.xosc.facts.maps import MapFolders
from osc2tx.backends.xosc.facts.start_places import read_signal, read_spawn
from osc2tx.backends.xosc.logical.distributions import document as values_document
from osc2tx.backends.xosc.logical.documents import LogicalWriter
from osc2tx.backends.xosc.logical.parameter_report import report_parameters
from osc2tx.backends.xosc.logical.sampling import Choosing
from osc2tx.backends.xosc.scopes import open_scopes
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Inexpressible
from osc2tx.losses.report import LossReport
from osc2tx.losses.report_json import report_json
from osc2tx.options import XmlOptions
from osc2tx.xosc.element import Element, Unwritable
from osc2tx.xosc.elements import FileHeader
from osc2tx.xosc.names import Names
from osc2tx.xosc.writer import serialize
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.registering import import_all

import_all(actions.__name__, actions.__path__)  # they register the forms that they write


@dataclass(frozen=True, slots=True)
class Choice:
    """A parameter of a document that chooses a member of a `one_of`.

    Attributes:
        name: Of the parameter.
        source: Line of the `one_of`.
        values: The value for each member, in order.
    """

    name: str
    source: str
    values: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class XmlScenario:
    """One scenario as XML.

    Attributes:
        name: Of the scenario.
        infix: What stands in the names of its files between stem and suffix.
        xml: The document; `None` if something in it cannot be said.
        parameters: A document with the values that open parameters may have; `None` without any.
        report: The grades of its constructs.
        origins: Where the members stand that the events of the document belong to, by event.
        map_places: Where its map was looked for, so that a change is noticed.
        choices: The parameters of the document that choose a member of a `one_of`.
    """

    name: str
    infix: str
    xml: str | None
    parameters: str | None
    report: LossReport
    origins: Mapping[str, Span]
    map_places: tuple[Path, ...]
    choices: tuple[Choice, ...] = ()

    @property
    def report_json(self) -> str | None:
        """What is not exact of it, and remarks, as JSON; `None` if there is nothing."""
        return report_json(self.report)


def emit(
    module: ir.Module, options: XmlOptions, folder: Path | None, stem: str | None = None
) -> tuple[XmlScenario, ...]:
    """Write down the scenarios of a file.

    Maps are looked for in the folder of the source. The names of the documents begin with the stem,
    by default that of the source.
    """
    scenarios = [each for each in module.own_scenarios if _can_begin(each)]
    stem = PurePosixPath(module.source).stem if stem is None else stem
    return tuple(
        _Emission(scenario, module, options, folder).run(f"{stem}{infix}", infix)
        for scenario, infix in zip(scenarios, _infixes(scenarios, stem), strict=True)
    )


def _can_begin(scenario: ir.Scenario) -> bool:
    """Whether a run can begin with a scenario: others do not have to give values to it."""
    required = (isinstance(d, ir.Parameter) and d.is_required for d in scenario.declarations)
    return not scenario.is_invoked or not any(required)


def _infixes(scenarios: Sequence[ir.Scenario], stem: str) -> list[str]:
    """Return what stands between the stem of the file and the suffix in the names of documents.

    It depends on the names of the file and of the scenario alone, so that no other scenario of the
    file renames a document. A scenario called as its file is not named twice. File systems may fold
    case: names that differ in nothing else are numbered.
    """
    names = Names(folds_case=True)
    return ["" if each.name == stem else f".{names.new(each.name)}" for each in scenarios]


@dataclass(frozen=True, slots=True, eq=False)
class _Emission:
    """Writes down one scenario."""

    _scenario: ir.Scenario
    _module: ir.Module
    _options: XmlOptions
    _folder: Path | None

    def run(self, name: str, infix: str) -> XmlScenario:
        """Return the document called `name`, and what goes with it."""
        try:
            open_scopes(self._scenario, self._module)
        except Inexpressible as error:
            report = LossReport(self._options, self._scenario, self._module)
            report.refuse("scenario invocation", self._scenario.span, error)
            return self._made(infix, report)
        version = self._options.version
        places = [*([self._folder] if self._folder else []), *map(Path, self._options.map_path)]
        write = partial(self._write, MapFolders(places))
        writer = LogicalWriter(self._scenario, self._module, version, write)
        found = writer.run()
        ctx, document = found.ctx, found.document
        if document is not None:
            report_parameters(found, writer.parameters)
        made = self._made(infix, ctx.report, ctx.origins, ctx.map_places)
        if document is None or not ctx.report.is_expressible:
            return made
        choices = (
            Choice(each.name, str(each.span), tuple(map(str, each.choices)))
            for each in found.kept
            if each.is_branch
        )
        made = replace(made, xml=serialize(document, version), choices=tuple(choices))
        if not found.kept or version < "1.1":
            return made
        header = document.one(FileHeader)
        values = values_document(header, f"{name}.xosc", found.distributions())
        return replace(made, parameters=serialize(values, version))

    def _made(
        self,
        infix: str,
        report: LossReport,
        origins: Mapping[str, Span] = MappingProxyType({}),
        map_places: tuple[Path, ...] = (),
    ) -> XmlScenario:
        """Return the scenario without its document."""
        name = self._scenario.name
        return XmlScenario(name, infix, None, None, report, origins, map_places)

    def _write(self, maps: MapFolders, choosing: Choosing) -> tuple[Context, Element | None]:
        """Return the document for a choice of open parameters; `None` if there cannot be one."""
        ctx, document = self._write_with(maps, choosing, None)
        if document is None or not ctx.asks_outlook:
            return ctx, document
        return self._write_with(
            maps, choosing, Outlook(ctx.demands, speeds_read(document), ctx.moves)
        )

    def _write_with(
        self, maps: MapFolders, choosing: Choosing, outlook: Outlook | None
    ) -> tuple[Context, Element | None]:
        """Return the same, given what the whole scenario asks for, as far as that is known."""
        options = self._options
        ctx = Context(self._scenario, self._module, options, maps, choosing, outlook)
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
        except Unwritable as error:  # what is told above all of the scenario
            ctx.report.refuse("scenario", self._scenario.span, error)
            return ctx, None
