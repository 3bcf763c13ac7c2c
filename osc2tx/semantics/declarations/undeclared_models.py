"""Models of CARLA that a scenario takes for types, `ego: Mercedes`.

ScenarioRunner knows some of them; scenarios written for its forks use others.
"""

from __future__ import annotations

from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.symbols import ActorSymbol
from osc2tx.syntax import ast

# Kinds of actors by names of models; others are vehicles. Props and animals are walked.
KINDS = {
    "person": ("Barrier", "Cone", "Cow", "Girl", "Man", "Pedestrian", "Walker", "Woman"),
}


def undeclared_model(r: Resolution, name: ast.Name) -> ActorSymbol | None:
    """Return the actor type of a name that the dialect reads as a model."""
    word = name.text
    if name.namespace is not None or not word[:1].isupper():
        return None
    kinds = (kind for kind, parts in KINDS.items() if any(part in word for part in parts))
    kind = next(kinds, "vehicle")
    base = next((s for s in r.scope.types_named(kind) if isinstance(s, ActorSymbol)), None)
    if base is None or not r.relaxes(
        "OSC624",
        name.span,
        f"model `{word}` is not declared; it is taken as a `{kind}`",
        key=word,
        help=f"declare it: `actor {word} inherits {kind}`",
    ):
        return None
    symbol = ActorSymbol(name=word, namespace="null", span=name.span, base=base)
    r.scope.types.setdefault(word, []).append(symbol)
    return symbol
