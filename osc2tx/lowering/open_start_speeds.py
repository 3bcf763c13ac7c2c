"""Speeds at the start that a scenario leaves open, of actors that keep a place to another one.

Who starts ahead of or behind another actor and has to be somewhere else relative to it at the end
of the same action starts as fast as that one, if nothing says how fast it is.
"""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.catalogue import catalogue

REFERENCES = ("ahead_of", "behind")


def open_start_speed(
    action: str, modifiers: Sequence[ir.ModifierCall]
) -> tuple[ir.ModifierCall, ...]:
    """Return the speed with which the actor of an action starts; empty if something says it.

    Args:
        action: What it does from the start on.
        modifiers: All of that action.
    """
    entries = catalogue().modifiers
    entry = catalogue().actions.get(action)
    if entry is None or entry.ends != "open" or entry.paces:
        return ()
    positions = [each for each in modifiers if each.name == "position"]
    others = [each for each in modifiers if each not in positions]
    if not all(each.name in entries for each in others):
        return ()  # those of a dialect
    if any(entries[each.name].paces for each in others):
        return ()
    starts = [found for each in positions if each.at == "start" for found in _reference(each)]
    ends = [found for each in positions if each.at == "end" for found in _reference(each)]
    if len(starts) != 1 or len(ends) != 1 or starts[0].value.span.text != ends[0].value.span.text:
        return ()
    reference = starts[0]
    same = ir.Argument(
        parameter="same_as", value=reference.value, is_positional=False, span=reference.span
    )
    return (ir.ModifierCall(span=reference.span, name="speed", arguments=(same,), at="start"),)


def _reference(position: ir.ModifierCall) -> list[ir.Argument]:
    return [argument for argument in position.arguments if argument.parameter in REFERENCES]
