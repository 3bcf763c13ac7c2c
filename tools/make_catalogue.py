"""Writes the catalogue: joins the library, the classes of the runtime and the forms of XML.

An action or modifier is stated in three places: its declaration (`osc2tx/stdlib`), its class
(`@action`, `@modifier` of the runtime) and its form in OpenSCENARIO XML, or the word that it has
none (`osc2tx/backends/xosc/actions`). The tables are not written while one of them is missing.
Run it after a change of any; a test compares.
"""

from __future__ import annotations

import json
import keyword
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from osc2tx import stdlib
from osc2tx.backends.xosc.actions import registry as xml
from osc2tx.semantics.dialects import DIALECTS
from osc2tx.syntax import ast
from osc2tx_runtime.domain import capabilities
from osc2tx_runtime.domain.modifiers import MODIFIERS
from osc2tx_runtime.domain.monitoring.registry import CLARIFIED, MONITORS, UNMONITORED

REPOSITORY = Path(__file__).parent.parent
TABLES = REPOSITORY / "osc2tx" / "catalogue"
NAMES = REPOSITORY / "runtime_lib" / "osc2tx_runtime" / "modifiers.py"

# Words at the end of a declaration in the library: the action is only there to be inherited from;
# the lowering turns the item into something else; nothing carries it out.
WORDS = ("abstract", "lowered", "unsupported")

WIDTH = 100

SECTION = re.compile(r"# §([\d.]+)")


class CatalogueError(Exception):
    """The three sources disagree; the message lists them, one line each."""


@dataclass
class Declaration:
    """An action or modifier of the library, all versions and dialects taken together.

    Attributes:
        name: `vehicle.drive`, `map.start_lane`; `speed` for a modifier of actions.
        section: Of the standard, from the comment above it.
        word: One of `WORDS`, or nothing.
        base: Its base type.
        parameters: Names.
    """

    name: str
    section: str
    word: str
    base: str
    parameters: set[str] = field(default_factory=set)

    @property
    def short(self) -> str:
        """The name without its actor."""
        return self.name.rpartition(".")[2]


Declarations = dict[str, Declaration]


def declared() -> tuple[Declarations, Declarations]:
    """Return the actions and the modifiers of the library."""
    actions: Declarations = {}
    modifiers: Declarations = {}
    preludes = [d.prelude for d in DIALECTS.values() if d.prelude is not None]
    for name in (*stdlib.LIBRARY, *preludes):
        for standard in ("2.2", "2.1"):
            for node in stdlib.library_file(name, standard).statements:
                match node:
                    case ast.ActionDeclaration():
                        _declare(actions, node)
                    case ast.ModifierDeclaration():
                        _declare(modifiers, node)
                    case ast.TypeExtension() if str(node.name) in actions:
                        actions[str(node.name)].parameters |= set(_parameters(node))
    return actions, modifiers


def _declare(found: Declarations, node: ast.ActionDeclaration | ast.ModifierDeclaration) -> None:
    text, start = node.span.source.text, node.span.start
    line = text[start : text.find("\n", start)]
    word = line.partition("#! ")[2].partition(" ")[0]
    base = str(node.base) if isinstance(node, ast.ActionDeclaration) and node.base else ""
    own = Declaration(str(node.name), _section(text[:start]), word, base)
    found.setdefault(own.name, own).parameters |= set(_parameters(node))


def _section(above: str) -> str:
    """Return the section that the comment right above a declaration names."""
    section = ""
    for line in reversed(above.removesuffix("\n").split("\n")):
        if not line.startswith("#"):
            break
        match = SECTION.match(line)
        section = match[1] if match else section
    return section


def _parameters(
    node: ast.ActionDeclaration | ast.ModifierDeclaration | ast.TypeExtension,
) -> Iterator[str]:
    for member in node.members:
        if isinstance(member, ast.ParameterDeclaration):
            yield from (name.text for name in member.names)


# --- joining -------------------------------------------------------------------------------------


def library() -> dict[str, Any]:
    """Return the tables of actions and modifiers.

    Raises:
        CatalogueError: The three sources disagree.
    """
    actions, modifiers = declared()
    classes, kinds = capabilities.actions(), capabilities.modifiers()
    wrong = [
        *_abstract(actions, classes),
        *_unmatched("action", actions, classes),
        *_unmatched("modifier", _by_short_name(modifiers), kinds),
        *_without_monitor(classes, kinds, {n for n in kinds if _owner(modifiers, n) == "map"}),
        *_without_statement("action", {name.rpartition(".")[2] for name in classes}, set()),
        *_without_statement(
            "modifier", set(kinds), {n for n in kinds if _owner(modifiers, n) == "map"}
        ),
    ]
    if wrong:
        raise CatalogueError("\n".join(wrong))
    return {
        **{
            word: sorted(name for name, each in actions.items() if each.word == word)
            for word in ("abstract", "lowered")
        },
        "actions": {name: _action(name, entry, actions) for name, entry in classes.items()},
        "modifiers": {name: _modifier(name, entry, modifiers) for name, entry in kinds.items()},
    }


def _by_short_name(modifiers: Declarations) -> Declarations:
    """Return modifiers that are carried out, by the names under which they are applied."""
    return {each.short: each for each in modifiers.values() if each.word in ("", "abstract")}


def _owner(modifiers: Declarations, name: str) -> str:
    each = _by_short_name(modifiers).get(name)
    return "" if each is None else each.name.rpartition(".")[0]


def _abstract(actions: Declarations, classes: Mapping[str, Any]) -> Iterator[str]:
    bases = {each.base for each in actions.values()}
    for name, each in actions.items():
        if each.word not in ("", *WORDS):
            yield f"action {name}: `#! {each.word}` is not one of {', '.join(WORDS)}"
        if each.word == "abstract" and name in classes:
            yield f"action {name}: the library calls it abstract, but the runtime has a class of it"
        if each.word == "abstract" and name not in bases:
            yield f"action {name}: the library calls it abstract, but nothing inherits from it"


def _unmatched(what: str, found: Declarations, classes: Mapping[str, Any]) -> Iterator[str]:
    """Yield items that are declared without a class, or the other way round."""
    for name, each in found.items():
        if not each.word and name not in classes:
            yield (
                f"{what} {name}: the library declares it, but the runtime registers no class for it"
                f" (@{what} in runtime_lib/osc2tx_runtime/domain/{what}s)"
            )
    for name, entry in classes.items():
        if name not in found and not entry["undeclared"]:
            yield (
                f"{what} {name}: the runtime registers a class for it, but the library does not"
                " declare it (osc2tx/stdlib), and `undeclared=` does not say why"
            )
        if name in found and entry["undeclared"]:
            yield f"{what} {name}: its class says `undeclared=`, but the library declares it"
        if name in found and not entry["undeclared"]:
            parameters = entry["arguments"] if what == "action" else entry["parameters"]
            for parameter in sorted({*map(_dsl, parameters)} - found[name].parameters):
                yield f"{what} {name}: its class takes `{parameter}`, which is not declared"


def _without_statement(what: xml.What, names: set[str], found_on_map: set[str]) -> Iterator[str]:
    """Yield what XML says nothing of, or has a form of though there is no such thing.

    Relations of the map need no form of their own: roads are looked for before the XML is written.
    """
    written = {*xml.MODIFIERS, *xml.AT_START}
    if what == "action":
        written = {*xml.ACTIONS, *xml.GLOBAL_ACTIONS}
    for name in sorted(names - written - found_on_map - xml.WITHOUT_FORM[what].keys()):
        yield (
            f"{what} {name}: OpenSCENARIO XML has neither a form of it nor a reason why not"
            f" (@{what} or without_form in osc2tx/backends/xosc)"
        )
    for name in sorted((written | xml.WITHOUT_FORM[what].keys()) - names):
        yield f"{what} {name}: OpenSCENARIO XML knows it, but the library and the runtime do not"
    for name in sorted(written & xml.WITHOUT_FORM[what].keys()):
        yield f"{what} {name}: OpenSCENARIO XML has a form of it, and a reason why not"


def _without_monitor(
    classes: Mapping[str, Any], kinds: Mapping[str, Any], of_map: set[str]
) -> Iterator[str]:
    """Yield the modifiers, and actions that move actors, that runs do not check."""
    moving = {name.rpartition(".")[2] for name, each in classes.items() if each["slots"]}
    moving |= {name.rpartition(".")[2] for name, each in classes.items() if each["moves"]}
    for what, names, known in (
        ("modifier", kinds.keys() - of_map, MONITORS.keys()),
        ("action", moving, CLARIFIED.keys()),
    ):
        for name in sorted(names - known - UNMONITORED.keys()):
            yield (
                f"{what} {name}: it has neither a monitor nor a reason why not"
                " (runtime_lib/osc2tx_runtime/domain/monitoring)"
            )
        for name in sorted(known & UNMONITORED.keys() & names):
            yield f"{what} {name}: it has a monitor, and a reason why not"


def _action(name: str, entry: Mapping[str, Any], found: Declarations) -> dict[str, Any]:
    declaration = found.get(name)
    return {
        "section": "" if declaration is None else declaration.section,
        **_in_dsl({key: value for key, value in entry.items() if key != "undeclared"}),
        "without_xml": xml.WITHOUT_FORM["action"].get(name.rpartition(".")[2], ""),
    }


def _modifier(name: str, entry: Mapping[str, Any], found: Declarations) -> dict[str, Any]:
    declaration = _by_short_name(found).get(name)
    return {
        "owner": _owner(found, name),
        "section": "" if declaration is None else declaration.section,
        **_in_dsl({key: value for key, value in entry.items() if key != "undeclared"}),
        "without_xml": xml.WITHOUT_FORM["modifier"].get(name, ""),
    }


def _in_dsl(value: Any) -> Any:
    """Return data of the runtime with the names of parameters as the DSL has them."""
    match value:
        case str():
            return _dsl(value)
        case list() | tuple():
            return [_in_dsl(each) for each in value]
        case dict():
            return {key: _in_dsl(each) for key, each in value.items()}
    return value


def _dsl(name: str) -> str:
    """Return a parameter as the DSL has it: `from` instead of `from_`."""
    plain = name.removesuffix("_")
    return plain if keyword.iskeyword(plain) else name


# --- writing -------------------------------------------------------------------------------------


def names() -> str:
    """Return the module with the modifiers by their names in the DSL."""
    kinds = sorted(MODIFIERS.items(), key=lambda each: (each[1].__module__, each[1].__name__))
    return "\n".join(
        [
            '"""The modifiers by their names in the DSL; made by tools/make_catalogue.py."""',
            "",
            *(_import(kind.__module__, kind.__name__, name) for name, kind in kinds),
            "",
            "__all__ = [",
            *(f'    "{name}",' for name in sorted(MODIFIERS)),
            "]\n",
        ]
    )


def _import(module: str, kind: str, name: str) -> str:
    """Return an import of a class by another name, broken as black does it."""
    line = f"from {module} import {kind} as {name}"
    return line if len(line) <= WIDTH else f"from {module} import (\n    {kind} as {name},\n)"


def render() -> dict[Path, str]:
    """Return the texts of all files.

    Raises:
        CatalogueError: The three sources disagree.
    """
    return {
        TABLES / "library.json": written(library(), 3) + "\n",
        TABLES / "objects.json": written(capabilities.objects(), 2) + "\n",
        NAMES: names(),
    }


def written(value: Any, depth: int, indent: str = "") -> str:
    """Return JSON with a line for each member of the dictionaries down to a depth."""
    if not depth or not isinstance(value, dict):
        return json.dumps(value)
    inner = indent + " "
    members = (
        f"{inner}{json.dumps(key)}: {written(each, depth - 1, inner)}"
        for key, each in value.items()
    )
    return "{\n" + ",\n".join(members) + f"\n{indent}}}"


if __name__ == "__main__":
    try:
        for path, text in render().items():
            path.write_text(text, encoding="utf-8")
    except CatalogueError as error:
        sys.exit(str(error))
