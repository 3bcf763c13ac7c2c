"""Modifier applications (§7.3.12)."""

from __future__ import annotations

from osc2tx.semantics.bodies.binding import bind_behavior, type_arguments
from osc2tx.semantics.builtins import OVERRIDE
from osc2tx.semantics.declarations.resolve_types import choose
from osc2tx.semantics.expressions.methods import call_by_statement
from osc2tx.semantics.names.colloquial_names import MODIFIERS, NO_MODIFIERS, plain_word
from osc2tx.semantics.names.other_dialects import advise
from osc2tx.semantics.names.stray_modifiers import modifiers_of
from osc2tx.semantics.names.unknown_names import report_unimported
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import CallableBehavior, is_subtype
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    FieldSymbol,
    ModifierSymbol,
    ScenarioSymbol,
    Symbol,
    TypeSymbol,
)
from osc2tx.semantics.types import ERROR, OBJECT, ActorType, BehaviorType, ErrorType
from osc2tx.syntax import ast


def check_modifier(
    r: Resolution,
    node: ast.ModifierApplication,
    env: Environment,
    invoked: CallableBehavior | None,
    actor: ActorSymbol | None,
    *,
    is_open: bool = False,
    is_member: bool = False,
) -> None:
    """Check a modifier application in a `with` block or a body.

    Args:
        r: The state of the pass.
        node: The application.
        env: Its environment.
        invoked: The behavior that is modified; `None` where that is unknown or a composition.
        actor: The actor that may be left out.
        is_open: The modified behavior is known only where the surrounding modifier is applied.
        is_member: It is a member of a scenario: it modifies all behaviors of the actor there.
    """
    if call_by_statement(r, node, env):
        return
    if node.actor is not None:
        type_ = r.type_of(node.actor, env, OBJECT)
        if not isinstance(type_, ActorType):
            if type_ != ERROR:
                what = f"`{type_}` is not an actor; it has no modifiers"
                r.report("OSC301", node.actor.span, what)
            if r.scope.modifiers_named(node.modifier.text):
                type_arguments(r, node.arguments, env)
                return
        actor = type_.symbol if isinstance(type_, ActorType) else None
    of_actor = actor if is_member else None
    modifier = _find_modifier(r, node, env, invoked, actor, is_open=is_open, of_actor=of_actor)
    if modifier is None:
        type_arguments(r, node.arguments, env)
        return
    r.references[node.modifier] = modifier
    if modifier.origin == "prelude":
        r.relaxes(
            "OSC611",
            node.modifier.span,
            f"modifier `{modifier.qualified_name}` belongs to dialect "
            f"`{r.relaxations.dialect.name}`, not to the standard library",
            key=modifier.qualified_name,
        )
    bind_behavior(r, node, modifier, env)
    if modifier is OVERRIDE:
        _check_override(r, node)


def _check_override(r: Resolution, node: ast.ModifierApplication) -> None:
    """Check that `override` names two invocations (§7.3.12.1.1)."""
    arguments = r.bindings[node].arguments
    given = {parameter.name for parameter, _ in arguments}
    for name in ("overridden", "by"):
        if name not in given and not _has_unknown_names(r, node):
            r.report("OSC404", node.modifier.span, f"`override` lacks its argument `{name}`")
    for parameter, value in arguments:
        type_ = r.types.get(value, ERROR)
        if parameter.name in ("overridden", "by") and not isinstance(
            type_, BehaviorType | ErrorType
        ):
            r.report(
                "OSC301",
                value.span,
                f"`{parameter.name}` must be an invocation, not `{type_}`",
                help="give the invocation a label, and name that",
            )


def _has_unknown_names(r: Resolution, node: ast.ModifierApplication) -> bool:
    """Whether an argument has a name that no parameter has; the missing one may be meant."""
    return any(a.name is not None and a.name not in r.references for a in node.arguments)


def _find_modifier(
    r: Resolution,
    node: ast.ModifierApplication,
    env: Environment,
    invoked: CallableBehavior | None,
    actor: ActorSymbol | None,
    *,
    is_open: bool,
    of_actor: ActorSymbol | None,
) -> ModifierSymbol | None:
    name = node.modifier
    candidates = r.scope.modifiers_named(name.text)
    if not candidates:
        if name.text == OVERRIDE.name:
            return OVERRIDE
        if not report_unimported(r, name):
            _report_unknown(r, name, invoked)
        return None
    quiet = env.it == ERROR
    fitting = (
        candidates
        if quiet
        else [
            m
            for m in candidates
            if _fits(m, invoked, actor)
            or (is_open and _may_fit(m, actor))
            or _fits_actions(m, of_actor)
        ]
    )
    if not fitting:
        _report_misfit(r, node, candidates[0], invoked, actor, env.owner)
        return None
    visible = r.scope.select(fitting, name, env.context)
    if not visible:
        return choose(r, fitting, name, env.context)
    return min(visible, key=lambda m: _distance(m, actor))


def _fits(
    modifier: ModifierSymbol, invoked: CallableBehavior | None, actor: ActorSymbol | None
) -> bool:
    of_actor = modifier.actor is None or (actor is not None and is_subtype(actor, modifier.actor))
    if modifier.target is None:
        return of_actor and (modifier.node.behavior is None or invoked is None)
    return of_actor and invoked is not None and is_subtype(invoked, modifier.target)


def _fits_actions(modifier: ModifierSymbol, actor: ActorSymbol | None) -> bool:
    """Whether a modifier is one of actions of an actor (§7.3.12.4)."""
    owner = None if modifier.target is None else modifier.target.actor
    return actor is not None and owner is not None and is_subtype(actor, owner)


def _may_fit(modifier: ModifierSymbol, actor: ActorSymbol | None) -> bool:
    """Whether a modifier fits some behavior of the actor, or of any."""
    return (
        actor is None
        or modifier.actor is None
        or is_subtype(actor, modifier.actor)
        or is_subtype(modifier.actor, actor)
    )


def _distance(modifier: ModifierSymbol, actor: ActorSymbol | None) -> int:
    """How far up the actor's ancestry a modifier is declared; the nearest wins."""
    if modifier.actor is None or actor is None:
        return 1000
    depth = 0
    current: ActorSymbol | None = actor
    while current is not None and current is not modifier.actor:
        depth += 1
        current = current.base
    return depth


def _report_unknown(r: Resolution, name: ast.Name, invoked: CallableBehavior | None) -> None:
    known = {n for layer in r.scope.layers() for n in layer.modifiers}
    behaviors = r.scope.behaviors_named(name.text)
    if behaviors:
        kind = "an action" if isinstance(behaviors[0], ActionSymbol) else "a scenario"
        r.report(
            "OSC212",
            name.span,
            f"`{name}` is {kind}, not a modifier",
            help="invoke it inside `do`",
            labels=declared_here(behaviors[0]),
        )
        return
    if name.text in NO_MODIFIERS:
        help_ = NO_MODIFIERS[name.text]
        r.report("OSC212", name.span, f"`{name}` is not a modifier", help=help_)
        return
    advice = advise(r, "modifier", name, sorted(known))
    if meant := plain_word(name.span, MODIFIERS):
        advice["help"] = meant
    advice["help"] = advice["help"] or modifiers_of(invoked)
    r.report("OSC212", name.span, f"no modifier `{name}`", **advice)


def instead_of_scenario(invoked: Symbol | None, name: str, written: str) -> str | None:
    """State how a modifier of actions (§8.9.1) is applied to all that a scenario does.

    Args:
        invoked: The behavior that is invoked; an action gets no advice.
        name: Name of the modifier.
        written: Its application.
    """
    if not isinstance(invoked, ScenarioSymbol):
        return None
    inside = "apply it in the `with` of the actions in it (§8.9.1)"
    if invoked.actor is None:
        return inside
    member = written[max(written.find(f"{name}("), 0) :]
    derived = f"{invoked.qualified_name}_with_{name}"
    return (
        f"{inside}, or write `{member}` into a `scenario {derived} inherits"
        f" {invoked.qualified_name}:` and invoke that"
    )


def _receiver(wanted: ActorSymbol, name: ast.Name, owner: TypeSymbol | None) -> str:
    """State the actor to which a modifier may be applied."""
    fields = [
        member.name
        for member in (() if owner is None else owner.members.values())
        if isinstance(member, FieldSymbol)
        and isinstance(member.type, ActorType)
        and is_subtype(member.type.symbol, wanted)
    ]
    if fields:
        return "write " + " or ".join(f"`{field}.{name}(…)`" for field in fields)
    field = wanted.name.lower()
    return f"declare `{field}: {wanted.name}`, and write `{field}.{name}(…)`"


def _report_misfit(
    r: Resolution,
    node: ast.ModifierApplication,
    modifier: ModifierSymbol,
    invoked: CallableBehavior | None,
    actor: ActorSymbol | None,
    owner: TypeSymbol | None,
) -> None:
    name = node.modifier
    if modifier.target is not None:
        wanted = f"it modifies `{modifier.target.qualified_name}`"
        if invoked is None or not is_subtype(invoked, modifier.target):
            here = f"`{invoked.qualified_name}`" if invoked else "this place"
            r.report(
                "OSC406",
                name.span,
                f"modifier `{name}` does not apply to {here}",
                notes=[wanted],
                help=instead_of_scenario(invoked, name.text, node.span.text),
                labels=declared_here(modifier),
            )
            return
    if modifier.actor is None:  # the modified behavior is unknown, which is reported already
        return
    if actor is None:
        r.report(
            "OSC407",
            name.span,
            f"modifier `{modifier.qualified_name}` needs an actor",
            help=_receiver(modifier.actor, name, owner),
        )
        return
    r.report(
        "OSC406",
        name.span,
        f"modifier `{name}` belongs to `{modifier.actor.name}`, not to `{actor.name}`",
        labels=declared_here(modifier),
    )
