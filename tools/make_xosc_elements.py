"""Writes `elements.pyi` and `literals.py` in `osc2tx/xosc`: the table as type checkers see it.

`EventPart` is what may stand in an `Event`. An attribute is required if each type that a tag may
have requires it in each version that has it. Names are those of the standard.
"""

from __future__ import annotations

import keyword
from collections.abc import Iterator
from pathlib import Path

import black

from osc2tx.options import XML_VERSIONS
from osc2tx.xosc.schema import Part, all_literals, attributes_of, tags, types_of

TARGET = Path(__file__).parents[1] / "osc2tx" / "xosc"
HEAD = '''"""Made by `tools/make_xosc_elements.py` from `schema.json`: do not edit."""

from typing import Final, TypeAlias

from osc2tx.xosc import literals
from osc2tx.xosc.element import Element as Base

def class_of(tag: str) -> type[Base]: ...
'''
LITERALS_HEAD = '''"""The enumerations of OpenSCENARIO XML, with the literals of all versions.

Made by `tools/make_xosc_elements.py` from `schema.json`: do not edit.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

'''
NUMBERS = {
    "Double": "float",
    "Int": "int",
    "UnsignedInt": "int",
    "UnsignedShort": "int",
    "Boolean": "bool",
}


def elements() -> str:
    """Return the text of the stub."""
    blocks = [HEAD, *("\n".join(_class(tag)) + "\n" for tag in sorted(tags()))]
    return black.format_str("\n".join(blocks), mode=black.Mode(line_length=100, is_pyi=True))


def literals() -> str:
    """Return the text of the module with the enumerations."""
    parts = [part for tag in sorted(tags()) for part in attributes_of(tag).values()]
    enums = sorted({part.type for part in parts if all_literals(part.type)})
    text = LITERALS_HEAD + "\n".join(map(_alias, enums))
    return black.format_str(text, mode=black.Mode(line_length=100))


def _alias(enum: str) -> str:
    """Return the alias of an enumeration."""
    literals = "".join(f'    "{literal}",\n' for literal in sorted(all_literals(enum)))
    return f"{enum}: TypeAlias = Literal[\n{literals}]\n"


def _class(tag: str) -> Iterator[str]:
    types = types_of(tag)
    children = sorted({_python(child) for type_ in types for child in type_.children})
    attributes = attributes_of(tag)
    if len(children) > 1:
        yield f"{tag}Part: TypeAlias = {' | '.join(children)}"
    yield f"class {_python(tag)}(Base):"
    yield "    def __init__("
    yield "        self,"
    if children:
        kind = f"{tag}Part" if len(children) > 1 else children[0]
        yield f"        *children: {kind} | None,"
    elif attributes or any(type_.text for type_ in types):
        yield "        *,"
    if any(type_.text for type_ in types):
        yield "        text: str | None = None,"
    for name, part in attributes.items():
        optional = "" if _is_required(tag, name) else " | None = None"
        given = "str | float" if part.type == "String" and name != "name" else _type(part)
        yield f"        {_python(name)}: {given}{optional},"
    yield "    ) -> None: ..."
    for name, part in attributes.items():
        is_known = part.default is not None or _is_required(tag, name)
        type_ = _type(part) if is_known else f"{_type(part)} | None"
        said = _said(part)
        yield f"    {_python(name)}: Final[{type_}]" + (f"  # {said}" if said else "")


def _python(name: str) -> str:
    return f"{name}_" if keyword.iskeyword(name) else name


def _type(part: Part) -> str:
    if all_literals(part.type):
        return f"literals.{part.type}"
    return NUMBERS.get(part.type, "str")


def _is_required(tag: str, name: str) -> bool:
    """Whether elements with a tag cannot be without an attribute, of whatever type they are."""
    parts = [type_.attributes.get(name) for type_ in types_of(tag)]
    return all(part is not None and _always_required(part) for part in parts)


def _always_required(part: Part) -> bool:
    return set(part.required) == {each for each in XML_VERSIONS if part.is_in(each)}


def _said(part: Part) -> str:
    """Return what a reader wants to know of an attribute besides its name."""
    said = (
        part.unit,
        part.since > XML_VERSIONS[0] and f"since {part.since}",
        part.until < XML_VERSIONS[-1] and f"until {part.until}",
        part.deprecated and f"deprecated since {part.deprecated}",
        part.default is not None and f"by default {part.default}",
    )
    return ", ".join(each for each in said if each)


if __name__ == "__main__":
    (TARGET / "elements.pyi").write_text(elements(), encoding="utf-8")
    (TARGET / "literals.py").write_text(literals(), encoding="utf-8")
