"""Rules of the library on objects and on calls of actions and modifiers, before either back end.

`check_rules` reports objects and calls that no world can carry out as they are written, whatever
the target: members that cannot be fixed, missing and impossible arguments, and modifiers that do
not go together. The rules of calls are in the catalogue; one interpreter applies them here and in
the runtime.
"""

from __future__ import annotations

from osc2tx.rules.scenarios import check_rules

__all__ = ["check_rules"]
