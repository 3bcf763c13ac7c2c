"""Writes the enums of the standard library as types of Python: `osc2tx_runtime/enums.py`.

Read from `osc2tx/stdlib/domain.osc`. Where the versions of the standard differ, the type has the
members of all of them. A test compares.
"""

from __future__ import annotations

import re
from pathlib import Path

from osc2tx.backends.py_trees.naming import class_name
from osc2tx.stdlib import DOMAIN, library_file, library_source
from osc2tx.syntax import ast

TARGET = Path(__file__).parents[1] / "runtime_lib/osc2tx_runtime/enums.py"
STANDARDS = ("2.2", "2.1")  # the newer one gives the order of the members
HEAD = '''"""Enums of the standard library: a type for each, with its members as literals.

Made by tools/make_enums.py from the text of the library; the section of the standard stands below.
"""

from __future__ import annotations

from typing import Literal, TypeAlias
'''


def enums() -> dict[str, tuple[str, ...]]:
    """Return the members of each enum, in their order."""
    found: dict[str, dict[str, None]] = {}
    for standard in STANDARDS:
        for each in library_file(DOMAIN, standard).statements:
            if isinstance(each, ast.EnumDeclaration):
                members = found.setdefault(each.name.text, {})
                members.update(dict.fromkeys(member.name.text for member in each.members))
    return {name: tuple(members) for name, members in found.items()}


def sections() -> dict[str, str]:
    """Return the section of the standard for each enum, from the comment above it."""
    text = library_source(DOMAIN, STANDARDS[0]).text
    above = re.findall(r"^# (§[\d.]+)[^\n]*\n(?:#[^\n]*\n)*enum (\w+):", text, re.MULTILINE)
    return {name: section for section, name in above}


def render() -> str:
    """Return the module as text."""
    places = sections()
    types = enums()
    names = sorted(class_name(name) for name in types)
    lines = [HEAD, "__all__ = [", *(f'    "{name}",' for name in names), "]"]
    for name, members in types.items():
        listed = ", ".join(f'"{member}"' for member in members)
        line = f"{class_name(name)}: TypeAlias = Literal[{listed}]"
        if len(line) > 100:
            rows = "".join(f'    "{member}",\n' for member in members)
            line = f"{class_name(name)}: TypeAlias = Literal[\n{rows}]"
        lines += ["", line, f'"""`{name}` ({places[name]})."""']
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    TARGET.write_text(render(), encoding="utf-8")
