"""Files with documents: scenarios, and values for runs of scenarios."""

from __future__ import annotations

import sys
from collections.abc import Collection, Mapping
from pathlib import Path

from osc2tx.importing.distributions import NOTHING, Distribution, Open
from osc2tx.importing.document import Folders, Refused
from osc2tx.importing.importer import Imported, import_document
from osc2tx.importing.libraries import Library
from osc2tx.importing.reach import Reach
from osc2tx.importing.report import ImportReport
from osc2tx.importing.value_files import read_distribution
from osc2tx.xosc import Element, Place, Unreadable, read


def open_in(source: Path, folders: Folders) -> tuple[Path, Mapping[str, Open]] | None:
    """Return the scenario that a document with distributions names, and what they leave open.

    `None`: it is no such document.

    Raises:
        Refused: It cannot be read.
    """
    data = _bytes_of(source)
    if b"ParameterValueDistribution" not in data:
        return None
    values = read_distribution(_root(data), ImportReport(source.name))
    return scenario_of(source, values, folders), values.open


def scenario_of(source: Path | None, values: Distribution, folders: Folders) -> Path:
    """Return the path of the scenario that a document with distributions names.

    Raises:
        Refused: It is outside of the folders of the document.
    """
    folder = Path() if source is None else source.parent
    named = values.scenario.replace("\\", "/")
    problem = Reach(folder, (*folders.maps, *folders.catalogs)).problem(named, (folder,))
    if problem:
        raise Refused(f"its scenario {named!r} is not read: {problem}", values.place)
    return folder / named


def import_file(
    source: Path | None,
    name: str,
    library: Library,
    folders: Folders,
    varied: Mapping[str, Open] = NOTHING,
    kept: Collection[str] = (),
) -> tuple[Imported, Distribution | None] | None:
    """Return the scenario of a file, with values for its runs; none of a catalog, which others use.

    Args:
        source: The file; `None` for standard input.
        name: The name of the scenario.
        library: What scenarios share so far; gains what it needs.
        folders: Where maps and catalogs are.
        varied: What scenarios that inherit it leave open.
        kept: Parameters that keep the values of the scenario in the first run of distributions.

    Raises:
        Refused: It is none, or cannot be read.
    """
    data = _bytes_of(source)
    root = _root(data)
    tags = {child.tag for child in root.children}
    if "Catalog" in tags:
        return None
    said = "-" if source is None else source.name
    if "ParameterValueDistribution" in tags:
        return _with_values(root, source, said, name, library, folders, kept)
    found = import_document(
        data, said, library, path=source, name=name, folders=folders, varied=varied
    )
    return found, None


def _with_values(
    root: Element,
    source: Path | None,
    said: str,
    name: str,
    library: Library,
    folders: Folders,
    kept: Collection[str],
) -> tuple[Imported, Distribution]:
    report = ImportReport(said)
    values = read_distribution(root, report)
    path = scenario_of(source, values, folders)
    template = _bytes_of(path, values.place, f"its scenario {values.scenario!r}")
    try:
        values.constrain(_root(template), [each for each in kept if each in values.open])
        found = import_document(
            template,
            path.name,
            library,
            path=path,
            name=name,
            folders=folders,
            distribution=values,
        )
    except Refused as error:
        where = f"{path.name}:{error.place}" if error.place else path.name
        raise Refused(f"its scenario, {where}: {error.reason}", values.place) from None
    used = {each for each, parameter in found.parameters.items() if parameter.is_used}
    first = values.first
    for each, open_ in values.unvaried(used):
        reason = f"{each} does not vary here: it keeps its value {first.get(each)}"
        report.add("approximated", "<Distribution>", reason, open_.place, file=said)
    found.report.findings += report.findings
    found.report.idle += report.idle
    return found, values


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
