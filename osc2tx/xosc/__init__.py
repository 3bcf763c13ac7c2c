"""OpenSCENARIO XML as a model: elements that are written, read, checked and played.

- `schema`: the table of the parts of each version, with units and defaults
- `elements`: a class for each element, made from the table; `element` is their base
- `writer`: elements to text; `reader`: text to elements with their places
- `checking`: parts of a document that a version does not allow
- `comparison`: whether two documents have the same meaning
- `profiles`: the features of the tools that read documents
- `expressions`: numbers with their expressions over open parameters
"""

from osc2tx.xosc.element import Element, Place, Unknown
from osc2tx.xosc.reader import Limits, Unreadable, read
from osc2tx.xosc.writer import serialize

__all__ = ["Element", "Limits", "Place", "Unknown", "Unreadable", "read", "serialize"]
