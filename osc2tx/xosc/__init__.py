"""OpenSCENARIO XML as a model: elements that are written, read, checked and played.

- `schema`: the table of what each version has, and what units and defaults count
- `elements`: a class for each element, made from the table; `element` is their base
- `writer`: elements to text; `reader`: text to elements with their places
- `checking`: what in a document a version does not allow
- `comparison`: whether two documents say the same
- `profiles`: what the tools support that read documents
- `expressions`: numbers that remember how open parameters give them
"""

from osc2tx.xosc.element import Element, Place, Unknown
from osc2tx.xosc.reader import Limits, Unreadable, read
from osc2tx.xosc.writer import serialize

__all__ = ["Element", "Limits", "Place", "Unknown", "Unreadable", "read", "serialize"]
