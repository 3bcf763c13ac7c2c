"""Documents that are imported together: scenarios, and values for runs of scenarios.

What distributions leave open of a scenario is a parameter of it, so that the scenarios with their
values inherit it: they only say what the parameters may be.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import field
from pathlib import Path

from osc2tx.importing.distributions import NOTHING, Distribution, Open, merged
from osc2tx.importing.document import Folders, Refused
from osc2tx.importing.families import families
from osc2tx.importing.importer import Imported, import_document
from osc2tx.importing.libraries import COMMON, Library
from osc2tx.importing.names import snake
from osc2tx.importing.program import Declared, Program
from osc2tx.importing.reach import Reach
from osc2tx.importing.report import Finding, ImportReport
from osc2tx.importing.value_files import read_distribution
from osc2tx.xosc import Element, Place, Unreadable, read
from osc2tx_shared.classes import dataclass, replace

Result = Imported | Refused
"""The scenario of a document, or why there is none."""


@dataclass
class Batch:
    """Imports documents.

    Attributes:
        folders: Where maps and catalogs are.
        library: What the scenarios share.
        bases: Scenarios that others inherit, which have no documents.
    """

    folders: Folders
    library: Library = field(default_factory=Library)
    bases: list[Program] = field(default_factory=list)
    _names: dict[Path | None, str] = field(default_factory=dict)
    _taken: set[str] = field(default_factory=lambda: {COMMON})
    _templates: dict[Path, Path] = field(default_factory=dict)
    _open: dict[Path, dict[str, Open]] = field(default_factory=dict)
    _alike: dict[Path, list[Imported]] = field(default_factory=dict)
    _done: set[Path] = field(default_factory=set)

    def run(self, sources: Sequence[Path | None], name: str | None = None) -> list[Result]:
        """Return the results of documents, and of the scenarios that distributions name.

        A scenario comes before those that inherit it; of catalogs, which others use, there is none.
        Scenarios of a folder that share much inherit it from one of their own.

        Args:
            sources: The documents; `None` for standard input.
            name: The name of the only scenario.
        """
        for source in sources:
            self._name(source, name)
        for source in sources:
            self._note_open(source)
        found = [each for source in sources for each in self._results(source)]
        scenarios = [each for each in found if isinstance(each, Imported)]
        alone = {each.name: each for each in scenarios if not each.program.base}
        folders = [(each.source.parent, each.program) for each in alone.values() if each.source]
        heirs: dict[str, Program] = {}
        for base, members in families(folders, {COMMON, *alone}):
            self.bases.append(base)
            heirs |= members
        return [
            (
                replace(each, program=heirs[each.name])
                if isinstance(each, Imported) and each.name in heirs
                else each
            )
            for each in found
        ]

    def _name(self, source: Path | None, name: str | None = None) -> str:
        """Return the name of the scenario of a document, which is its own."""
        key = None if source is None else source.resolve()
        if key not in self._names:
            said = name or ("scenario" if source is None else source.stem)
            while snake(said) in self._taken:
                said += "_2"
            self._taken.add(snake(said))
            self.library.scenarios.add(snake(said))
            self._names[key] = said
        return self._names[key]

    def _note_open(self, source: Path | None) -> None:
        """Note what a document with distributions leaves open of its scenario."""
        if source is None:
            return
        try:
            data = _bytes_of(source)
            if b"ParameterValueDistribution" not in data:
                return
            values = read_distribution(_root(data), ImportReport(source.name))
            path = self._scenario_of(source, values)
        except Refused:
            return  # said where it is imported
        self._templates[source.resolve()] = path
        self._open[path.resolve()] = merged(self._open.get(path.resolve(), NOTHING), values.open)

    def _scenario_of(self, source: Path | None, values: Distribution) -> Path:
        """Return the path of the scenario that a document with distributions names.

        Raises:
            Refused: It is outside of the folders of the document.
        """
        folder = Path() if source is None else source.parent
        named = values.scenario.replace("\\", "/")
        reach = Reach(folder, (*self.folders.maps, *self.folders.catalogs))
        if problem := reach.problem(named, (folder,)):
            raise Refused(f"its scenario {named!r} is not read: {problem}", values.place)
        return folder / named

    def _results(self, source: Path | None) -> Iterator[Result]:
        alike: list[Imported] = []
        if source is not None:
            key = source.resolve()
            if key in self._done:
                return
            self._done.add(key)
            if key in self._templates and self._templates[key].is_file():
                yield from self._results(self._templates[key])
            alike = self._alike.setdefault(self._templates.get(key, source).resolve(), [])
        try:
            found = self._import(source, alike)
        except Refused as error:
            error.source = source
            yield error
            return
        if found is not None:
            if not found.program.base:
                alike.append(found)
            yield found

    def _import(self, source: Path | None, alike: Sequence[Imported]) -> Imported | None:
        """Return the scenario of a file; `None`: it is a catalog.

        Args:
            source: Its file.
            alike: The scenario that it varies, then others that do so; it may inherit them.

        Raises:
            Refused: It is none, or cannot be read.
        """
        data, name = _bytes_of(source), self._name(source)
        root, said = _root(data), "-" if source is None else source.name
        tags = {child.tag for child in root.children}
        if "Catalog" in tags:
            return None
        if "ParameterValueDistribution" in tags:
            return self._with_values(root, source, said, alike)
        varied = NOTHING if source is None else self._open.get(source.resolve(), NOTHING)
        found = import_document(
            data, said, self.library, path=source, name=name, folders=self.folders, varied=varied
        )
        return replace(found, source=source)

    def _with_values(
        self, root: Element, source: Path | None, said: str, alike: Sequence[Imported]
    ) -> Imported:
        """Return the scenario of a document with distributions.

        In the first run parameters that the scenario does not use keep its values.
        """
        report = ImportReport(said)
        values = read_distribution(root, report)
        path = self._scenario_of(source, values)
        template = _bytes_of(path, values.place, f"its scenario {values.scenario!r}")
        kept = [key for each in alike[:1] for key, p in each.parameters.items() if not p.is_used]
        try:
            values.constrain(_root(template), [each for each in kept if each in values.open])
            found = import_document(
                template,
                path.name,
                self.library,
                path=path,
                name=self._name(source),
                folders=self.folders,
                distribution=values,
            )
        except Refused as error:
            where = f"{path.name}:{error.place}" if error.place else path.name
            raise Refused(f"its scenario, {where}: {error.reason}", values.place) from None
        used = {each for each, parameter in found.parameters.items() if parameter.is_used}
        first = values.first
        for each, open_ in values.unvaried(used):
            reason = f"{each} does not vary here: it keeps its value {first.get(each)}"
            report.add(Finding("approximated", "<Distribution>", reason, open_.place, said))
        found.report.findings += report.findings
        found.report.idle += report.idle
        program = inheriting(found.program, alike, values)
        return replace(found, program=program, source=source, distribution=values)


def _root(data: bytes) -> Element:
    """Return the root of a document.

    Raises:
        Refused: It cannot be read.
    """
    try:
        return read(data)
    except Unreadable as error:
        raise Refused(error.reason, error.place) from None


def _bytes_of(source: Path | None, place: Place | None = None, what: str = "it") -> bytes:
    if source is None:
        return sys.stdin.buffer.read()
    try:
        return source.read_bytes()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise Refused(f"{what} cannot be read: {reason}", place) from None


def inheriting(program: Program, alike: Sequence[Imported], distribution: Distribution) -> Program:
    """Return a scenario with values for its runs as one that inherits one of some others.

    As it is, if the values give it another course or other places than all of these have.
    """
    varied = {each.name: each.varied for each in program.parameters if each.varied}

    def fixed(one: Program) -> tuple[object, ...]:
        parameters = [each for each in one.parameters if each.name not in varied]
        return parameters, one.members, one.behavior

    for base in (each.program for each in alike):
        defaults = {each.name: each.value for each in base.parameters}
        is_narrow = any(each.varied.startswith("in ") for each in base.parameters)
        if is_narrow or not varied.keys() <= defaults.keys() or fixed(program) != fixed(base):
            continue
        said = {name: told for name, told in varied.items() if told != f"== {defaults[name]}"}
        values = [Declared("", f"keep({name} {told})") for name, told in said.items()]
        header = distribution.header or program.header
        return Program(program.name, header, base=base.name, parameters=values)
    header = list(dict.fromkeys((*distribution.header, *program.header)))
    return replace(program, header=header)
