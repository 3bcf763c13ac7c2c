"""A class for each element of OpenSCENARIO XML, made from the table on first access.

Type checkers and editors see them in `elements.pyi`, which `tools/make_xosc_elements.py` writes:
which children an element takes, and its attributes with units, versions and defaults. There
`EventPart` is the type of the children of an `Event`; here it is any element.
"""

import keyword

from osc2tx.xosc.element import Attribute, Unknown
from osc2tx.xosc.element import Element as Base
from osc2tx.xosc.schema import attributes_of, tags

PART = "Part"


def class_of(tag: str) -> type[Base]:
    """Return the class of the elements with a tag."""
    known = _CLASSES.get(tag)
    if known is not None:
        return known
    if tag not in tags():
        return type(tag, (Unknown,), {"__slots__": ()})
    parts = attributes_of(tag)
    values = {
        f"{name}_" if keyword.iskeyword(name) else name: Attribute(name, part)
        for name, part in parts.items()
    }
    made = type(tag, (Base,), {"__slots__": (), "__module__": __name__, **values})
    return _CLASSES.setdefault(tag, made)


_CLASSES: dict[str, type[Base]] = {}


def __getattr__(name: str) -> type[Base]:
    """Make a class on first access; then it is an attribute."""
    tag = name.removesuffix("_")  # as of `None_`, which is a word of Python
    if tag in tags():
        found = class_of(tag)
    elif name.endswith(PART) and name.removesuffix(PART) in tags():
        found = Base
    else:
        raise AttributeError(f"OpenSCENARIO XML has no <{name}>")
    return globals().setdefault(name, found)
