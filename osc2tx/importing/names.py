"""Names of documents as names of the language: lower case, words joined by underscores, unique."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import cache

from osc2tx.importing.report import ImportReport
from osc2tx.options import STANDARDS
from osc2tx.stdlib import LIBRARY, library_source

_WORD = re.compile(
    r"[A-Z]\d[A-Z]+(?![a-z])"  # C2C, V2X
    r"|[A-Z]{2,}s(?![a-z])"  # a plural: VRUs
    r"|\d+[a-z]+\d*"  # a value with its unit: 50kph
    r"|[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+\d*|[A-Z]+\d*|\d+"
)
_DECLARED = re.compile(r"^(?:enum|struct|actor|unit) (\w+)", re.MULTILINE)
_WORDS = (
    "import namespace use export struct actor action scenario modifier enum unit type extend def"
    " var event global inherits of is if with in as do on wait call until emit serial parallel"
    " one_of keep hard default remove_default cover record range every fall rise elapsed and or"
    " not it true false null list actor int uint float bool string SI expression undefined"
    " external only override repeat at start end fail"
)
KINDS = ("event", "action", "maneuver", "act", "story", "group", "sequence")
"""Last words of names that only say what an element is."""
LONGEST = 36
"""Characters of a name that does not make lines long."""
_SYMBOL = re.compile(r"[a-z]{1,2}\d|[adv][xy]")
_NEEDLESS = ("init", "initial", "position")


def snake(name: str) -> str:
    """Return a name in lower case with underscores: `CutInVehicle_1` is `cut_in_vehicle_1`."""
    words = _WORD.findall(name)
    joined = "_".join(word.lower() for word in words)
    return f"n{joined}" if joined[:1].isdigit() else joined or "unnamed"


def short(name: str) -> str:
    """Return the name of an event without the words that say that it is one."""
    words = snake(name).split("_")
    while len(words) > 1 and words[-1] in KINDS:
        words.pop()
    return "_".join(words)


def shortened(names: Sequence[str], actors: Iterable[str]) -> list[str]:
    """Return names of parameters, long ones without words that the others do not need.

    These are symbols at the end (`Ve0`), words that hold for most of them, then the actor.

    Args:
        names: The names.
        actors: Names of actors, with which those of parameters may begin.
    """
    known = sorted(actors, key=len, reverse=True)
    found = [_shortened(each, known) for each in names]
    counts = Counter((*found, *known))
    return [short if counts[short] == 1 else name for name, short in zip(names, found, strict=True)]


def _shortened(name: str, actors: Sequence[str]) -> str:
    if len(name) <= LONGEST:
        return name
    words = name.split("_")
    while len(words) > 1 and _SYMBOL.fullmatch(words[-1]):
        words.pop()
    found = "_".join(each for each in words[:-1] if each not in _NEEDLESS) + f"_{words[-1]}"
    if len(found) > LONGEST:
        actor = next((each for each in actors if found.startswith(f"{each}_")), None)
        found = found if actor is None else found.removeprefix(f"{actor}_")
    return found.lstrip("_")


@cache
def _library() -> tuple[str, ...]:
    return tuple(library_source(name, STANDARDS[-1]).text for name in LIBRARY)


@cache
def actions_of(actor: str) -> frozenset[str]:
    """Return the names of the actions that the library has for a type of actors."""
    declared = re.compile(rf"^action {actor}\.(\w+)", re.MULTILINE)
    return frozenset(name for text in _library() for name in declared.findall(text))


@cache
def reserved() -> frozenset[str]:
    """Return the names that the language and its library have."""
    texts = _library()
    found = {name for text in texts for name in _DECLARED.findall(text)}
    return frozenset(found | set(_WORDS.split()))


class Names:
    """The names of a scenario; each is given once."""

    def __init__(self, report: ImportReport, taken: Iterable[str] = ()) -> None:
        self._report = report
        self._taken = set(taken)
        self._counts: dict[str, int] = {}

    def new(self, said: str, *, kind: str, base: str | None = None) -> str:
        """Return the name for something of the document.

        Args:
            said: Its name there.
            kind: What it is, for the table of names.
            base: What to call it if that is free; its own name in the style of the language.
        """
        wanted = base or snake(said)
        if wanted in reserved():
            wanted = f"{wanted}_{kind.split()[-1]}"
        name, base, count = wanted, wanted.rstrip("_"), self._counts.get(wanted, 2)
        while name in self._taken:
            name, count = f"{base}_{count}", count + 1
        self._counts[wanted] = count
        self._taken.add(name)
        if said and said != name:
            self._report.names[f"{kind} {said}"] = name
        return name
