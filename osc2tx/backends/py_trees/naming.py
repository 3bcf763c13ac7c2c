"""Python names for the names of a scenario: stable, unique, never a keyword."""

from __future__ import annotations

import keyword
import unicodedata
from collections.abc import Iterable
from pathlib import PurePosixPath

from osc2tx.backends.py_trees.code import PyName
from osc2tx.support.portable_names import is_portable
from osc2tx.support.python_modules import is_taken

# What `Scenario` of the runtime library uses itself; a test compares with the real class.
SCENARIO_ATTRIBUTES = frozenset(
    {
        "actors",
        "argument",
        "arguments",
        "behavior",
        "cast",
        "cover",
        "create_tree",
        "declare",
        "ended",
        "event",
        "events",
        "external",
        "failed",
        "first_come",
        "global_object",
        "global_parameter",
        "has_drawn_values",
        "is_main",
        "invoke",
        "invoked",
        "keep",
        "label_events",
        "map_file",
        "map_objects",
        "name",
        "one_of",
        "override",
        "parameter",
        "parameter_units",
        "parameters",
        "place",
        "placement",
        "placements",
        "record",
        "require",
        "required",
        "required_argument",
        "required_global",
        "sample",
        "settings",
        "source",
        "started",
    }
)


def identifier(text: str) -> str:
    """Return the closest Python identifier to a name of the language.

    Python folds identifiers by NFKC, so that is done here already; quoted names may hold any
    character; a leading underscore would make the name private to the base class.
    """
    folded = unicodedata.normalize("NFKC", text)
    cleaned = "".join(char if f"x{char}".isidentifier() else "_" for char in folded)
    if cleaned.startswith("_") or not cleaned:
        cleaned = f"x{cleaned}"
    if not cleaned.isidentifier():
        cleaned = f"x_{cleaned}"
    return f"{cleaned}_" if keyword.iskeyword(cleaned) else cleaned


def module_name(source: str) -> str:
    """Return the module name for a source file: importable, as close to its name as can be.

    It is a possible file name on every system, and no other module is hidden by it.
    """
    name = identifier(PurePosixPath(source).stem)
    return f"{name}_" if is_taken(name) or not is_portable(name) else name


def class_name(text: str) -> str:
    """Return a name of the language in the form of a Python class name."""
    words = [word for word in identifier(text).split("_") if word]
    camel = "".join(word[0].upper() + word[1:] for word in words)
    return camel if camel.isidentifier() and not keyword.iskeyword(camel) else f"X{camel}"


class NameTable:
    """Hands out Python names that differ from each other and from what is reserved.

    Attributes:
        looked_up: Keys whose names somebody wanted to know.
    """

    def __init__(self, reserved: Iterable[str] = ()) -> None:
        """Start with the reserved names taken."""
        self._taken = set(reserved)
        self._names: dict[str, PyName] = {}
        self.looked_up: set[str] = set()

    def add(self, key: str, wanted: str, fallback_suffix: str = "_") -> PyName:
        """Reserve a name for `key`, as close to `wanted` as is free: with suffix or number."""
        candidate = wanted
        if candidate in self._taken:
            candidate = f"{wanted}{fallback_suffix}"
        base, number = candidate, 2
        while candidate in self._taken:
            candidate = f"{base}_{number}" if not base.endswith("_") else f"{base}{number}"
            number += 1
        self._taken.add(candidate)
        self._names[key] = PyName(candidate)
        return self._names[key]

    def __getitem__(self, key: str) -> PyName:
        """Return the name reserved for `key`."""
        self.looked_up.add(key)
        return self._names[key]

    def __contains__(self, key: str) -> bool:
        """Tell whether a name is reserved for `key`."""
        return key in self._names
