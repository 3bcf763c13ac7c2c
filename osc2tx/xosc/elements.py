"""A class for each element of OpenSCENARIO XML, made from the table when it is first asked for.

Type checkers and editors see them in `elements.pyi`, which `tools/make_xosc_elements.py` writes:
which children an element takes, and its attributes with units, versions and defaults. There
`EventPart` is the type of what may stand in an `Event`; here it is any element.
"""

import keyword

from osc2tx.xosc.element import Attribute, Element, Unknown
from osc2tx.xosc.schema import attributes_of, tags

PART = "Part"


def class_of(tag: str) -> type[Element]:
    """Return the class of the elements with a tag."""
    known = _CLASSES.get(tag)
    if known is None:
        is_known = tag in tags()
        known = _made(tag, Element if is_known else Unknown)
        if is_known:
            _CLASSES[tag] = known
    return known


_CLASSES: dict[str, type[Element]] = {}


def _made(tag: str, base: type[Element]) -> type[Element]:
    parts = attributes_of(tag)
    values = {
        f"{name}_" if keyword.iskeyword(name) else name: Attribute(name, part)
        for name, part in parts.items()
    }
    return type(tag, (base,), {"__slots__": (), "__module__": __name__, "parts": parts, **values})


def __getattr__(name: str) -> type[Element]:
    if name.endswith(PART) and name.removesuffix(PART) in tags():
        return Element
    tag = name.removesuffix("_")  # as of `None_`, which is a word of Python
    if tag in tags():
        return class_of(tag)
    raise AttributeError(f"OpenSCENARIO XML has no <{name}>")
