"""What events, acts and marks are called: after labels, else after what a member does.

No name counts members, so that one more of them renames no other; only what says the very same is
told apart by numbers.
"""

from __future__ import annotations

from osc2tx import ir


def member_name(scenario: ir.Scenario, node: ir.Behavior) -> str:
    """Return what a member of a scenario is called; its body has no name but its kind."""
    if node.label is not None:
        return node.label
    return type(node).__name__.lower() if node is scenario.body else node.name


def event_name(scenario: ir.Scenario, node: ir.Invoke, actor: str | None = None) -> str:
    """Return what the event of an action is called.

    The action alone will do where it is done once; else its arguments and modifiers follow.

    Args:
        scenario: Where it stands.
        node: The invocation.
        actor: The entity that acts, if there is one.
    """
    if node.label is not None:
        return node.label
    alike = [each for each in ir.walk_behaviors(scenario.body) if _is_alike(each, node)]
    details = [] if len(alike) == 1 else [*_values(node.arguments), *_modifiers(node)]
    return "_".join(([] if actor is None else [actor]) + [node.action, *details])


def _is_alike(node: ir.Behavior, other: ir.Invoke) -> bool:
    return (
        isinstance(node, ir.Invoke)
        and node.label is None
        and node.action == other.action
        and _written(node.actor) == _written(other.actor)
    )


def _written(actor: ir.Expression | None) -> str:
    return "" if actor is None else actor.span.text


def _values(arguments: tuple[ir.Argument, ...]) -> list[str]:
    return [argument.value.span.text.strip('"') for argument in arguments]


def _modifiers(node: ir.Invoke) -> list[str]:
    return [word for call in node.modifiers for word in (call.name, *_values(call.arguments))]
