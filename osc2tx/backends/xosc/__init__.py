"""The XML back end: IR in, OpenSCENARIO XML 1.0 to 1.4 and a loss report out.

Begin at `emitter`. In order of control flow: `document` (the skeleton), `entities` (with
`Init`), `flatten` (the tree as acts and events) with `actions`, `conditions` and `events`; what
they make are elements of `osc2tx.xosc`, whose writer puts them in order and checks them.

Functions that find what the XML cannot say, or what only a run shows, raise `Inexpressible` with
the reason. It ends in the loss report, at the construct that was being looked at
(`Context.report_as`).
"""

from osc2tx.backends.xosc.emitter import Choice, XmlScenario, emit

__all__ = ["Choice", "XmlScenario", "emit"]
