"""Documents that are imported together.

What distributions leave open of a scenario is a parameter of it, so that the scenarios with their
values inherit it: they only say what the parameters may be.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field
from pathlib import Path

from osc2tx.importing.distributions import NOTHING, Distribution, Open, merged
from osc2tx.importing.document import Folders, Refused
from osc2tx.importing.families import families
from osc2tx.importing.importer import Imported
from osc2tx.importing.libraries import COMMON, Library
from osc2tx.importing.names import snake
from osc2tx.importing.program import Declared, Program
from osc2tx.importing.reading import import_file, open_in
from osc2tx_shared.classes import dataclass, replace


@dataclass
class Found:
    """The result of a document.

    Attributes:
        source: Its file; `None` for standard input.
        imported: The scenario, or why there is none.
        distribution: Values for its runs.
    """

    source: Path | None
    imported: Imported | Refused
    distribution: Distribution | None = None


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
    _done: dict[Path, Found | None] = field(default_factory=dict)

    def run(self, sources: Sequence[Path | None], name: str | None = None) -> list[Found]:
        """Return the results of documents, and of the scenarios that distributions name.

        A scenario comes before those that inherit it; of catalogs, which others use, there is none.

        Args:
            sources: The documents; `None` for standard input.
            name: The name of the only scenario.
        """
        for source in sources:
            self._name(source, name)
        for source in sources:
            self._note_open(source)
        found = [each for source in sources for each in self._results(source)]
        self._find_families(found)
        return found

    def _find_families(self, found: Sequence[Found]) -> None:
        """Let scenarios of a folder that share much inherit it from one of their own."""
        alone = {
            each.imported.name: each
            for each in found
            if isinstance(each.imported, Imported) and not each.imported.program.base
        }
        programs = [
            (each.source.parent, each.imported.program)
            for each in alone.values()
            if each.source is not None and isinstance(each.imported, Imported)
        ]
        for base, heirs in families(programs, {COMMON, *alone}):
            self.bases.append(base)
            for name, program in heirs.items():
                heir = alone[name]
                assert isinstance(heir.imported, Imported)
                heir.imported = replace(heir.imported, program=program)

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
        try:
            found = None if source is None else open_in(source, self.folders)
        except Refused:
            return  # said where it is imported
        if source is not None and found is not None:
            path, open_ = found
            self._templates[source.resolve()] = path
            self._open[path.resolve()] = merged(self._open.get(path.resolve(), NOTHING), open_)

    def _results(self, source: Path | None) -> Iterator[Found]:
        if source is None:
            yield from filter(None, [self._import(source, ())])
            return
        key = source.resolve()
        if key in self._done:
            return
        self._done[key] = None
        if key in self._templates and self._templates[key].is_file():
            yield from self._results(self._templates[key])
        alike = self._alike.setdefault(self._templates.get(key, source).resolve(), [])
        found = self._done[key] = self._import(source, alike)
        if found is None:
            return
        if isinstance(found.imported, Imported) and not found.imported.program.base:
            alike.append(found.imported)
        yield found

    def _import(self, source: Path | None, alike: Sequence[Imported]) -> Found | None:
        """Return the result of a document.

        Args:
            source: Its file.
            alike: The scenario that it varies, then others that do so; it may inherit them.
        """
        varied = NOTHING if source is None else self._open.get(source.resolve(), NOTHING)
        kept = [said for each in alike[:1] for said, p in each.parameters.items() if not p.is_used]
        name = self._name(source)
        try:
            found = import_file(source, name, self.library, self.folders, varied, kept)
        except Refused as error:
            return Found(source, error)
        if found is None:
            return None
        imported, distribution = found
        if distribution is not None:
            imported = replace(imported, program=inheriting(imported.program, alike, distribution))
        return Found(source, imported, distribution)


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
