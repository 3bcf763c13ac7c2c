"""Scenarios of one folder that begin alike inherit what they share from one that says it once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from itertools import chain, count, takewhile
from pathlib import Path

from osc2tx.importing.names import snake
from osc2tx.importing.program import ROAD, Declared, Program
from osc2tx_shared.classes import replace

LEAST_SCENARIOS = 3
LEAST_SHARE = 0.6
"""Of the scenarios of a folder: what fewer have is said in each of them."""
LEAST_LINES = 4
INHERITED = "#! allow OSC510: scenarios beside it inherit it"


def families(
    programs: Sequence[tuple[Path, Program]], taken: Collection[str]
) -> Iterator[tuple[Program, dict[str, Program]]]:
    """Yield scenarios that others inherit, with these by their names.

    Args:
        programs: Scenarios that inherit nothing yet, with the folders of their documents.
        taken: Names that other files have.
    """
    folders: dict[Path, list[Program]] = {}
    for folder, program in programs:
        folders.setdefault(folder, []).append(program)
    names = set(taken)
    for folder, members in folders.items():
        shared, heirs = _shared(members)
        if shared:
            base = _base(_name(heirs, folder, names), shared, heirs)
            names.add(base.name)
            yield base, {each.name: _heir(each, base) for each in heirs}


def _key(part: Declared) -> str:
    """Return what is alike in members that a base can declare; of maps only that there is one."""
    return ROAD if part.name == ROAD else "\n".join(part.lines)


def _parts(program: Program) -> dict[str, Declared]:
    """Return the named members of a scenario by what is alike in those of others."""
    return {_key(each): each for each in (*program.members, *program.parameters) if each.name}


def _shared(members: Sequence[Program]) -> tuple[list[str], list[Program]]:
    """Return what most scenarios have, and those that have it; nothing if it is little."""
    counts = Counter(key for each in members for key in _parts(each))
    least = max(LEAST_SCENARIOS, LEAST_SHARE * len(members))
    found = {key for key, number in counts.items() if number >= least}
    heirs = [each for each in members if found <= _parts(each).keys()]
    if len(heirs) < least:
        return [], []
    parts = _parts(heirs[0])
    kept = _closed([parts[key] for key in parts if key in found], heirs)
    is_enough = sum(len(each.lines) for each in kept) >= LEAST_LINES
    return ([_key(each) for each in kept], heirs) if is_enough else ([], [])


def _closed(parts: list[Declared], heirs: Sequence[Program]) -> list[Declared]:
    """Return members without those that read others, which only some scenarios have."""
    names = {each.name for heir in heirs for each in _parts(heir).values()}
    while True:
        others = names - {each.name for each in parts}
        kept = [each for each in parts if each.words.isdisjoint(others)]
        if len(kept) == len(parts):
            return kept
        parts = kept


def _name(heirs: Sequence[Program], folder: Path, taken: Collection[str]) -> str:
    """Return a name: the words that those of the scenarios begin with, else that of the folder."""
    columns = zip(*(each.name.split("_") for each in heirs), strict=False)
    common = takewhile(lambda words: len(set(words)) == 1, columns)
    words = "_".join(word for word, *_ in common if not word.isdigit())
    base = f"{words or snake(folder.name)}_base"
    others = (f"{base}_{number}" for number in count(2))
    return next(each for each in chain([base], others) if each not in taken)


def _base(name: str, shared: Collection[str], heirs: Sequence[Program]) -> Program:
    """Return the scenario that says what others share."""
    first = heirs[0]
    maps = {tuple(each.lines) for heir in heirs for each in heir.members if each.name == ROAD}
    members = [each for each in first.members if each.name and _key(each) in shared]
    if len(maps) > 1:
        members = [replace(each, constraints=[]) if each.name == ROAD else each for each in members]
    return Program(
        name,
        [line for line in first.header if all(line in each.header for each in heirs)],
        [each for each in first.imports if all(each in heir.imports for heir in heirs)],
        members=members,
        parameters=[each for each in first.parameters if each.name and _key(each) in shared],
        remark=INHERITED,
    )


def _heir(program: Program, base: Program) -> Program:
    """Return a scenario as one that inherits another one with some of its members."""
    shared = {_key(each) for each in (*base.members, *base.parameters)}
    own = {tuple(each.lines) for each in base.members}
    road = [
        Declared("", f"keep({each.replace('it.', f'{ROAD}.', 1)})")
        for part in program.members
        if part.name == ROAD and tuple(part.lines) not in own
        for each in part.constraints
    ]
    return replace(
        program,
        base=base.name,
        brought=base.imports,
        members=[*road, *(each for each in program.members if _is_own(each, shared))],
        parameters=[each for each in program.parameters if _is_own(each, shared)],
    )


def _is_own(part: Declared, shared: Collection[str]) -> bool:
    return not part.name or _key(part) not in shared
