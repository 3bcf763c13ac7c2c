"""What this runtime carries out, as plain data: for the compiler and for the documentation.

What is not listed is not there; the compiler refuses it before anything runs.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Sequence
from typing import Any, get_args, get_type_hints

from osc2tx_runtime import enums
from osc2tx_runtime.domain.actions.combinations import (
    CONFLICTS,
    CONTRADICTIONS,
    EXCLUSIVE,
    MOVING,
    NO_START,
    ON_LANES,
    SORTS,
    STARTING,
)
from osc2tx_runtime.domain.actions.modifiable import ShapedAction
from osc2tx_runtime.domain.actors import Actor
from osc2tx_runtime.domain.capability_tables import FIELDS, MANDATORY, METHODS, OBJECTS, UNKNOWN
from osc2tx_runtime.domain.modifiers import MAP_MODIFIERS, MODIFIERS, Modifier
from osc2tx_runtime.domain.placing.initializer import PLACEMENT_MODIFIERS
from osc2tx_runtime.language.argument_rules import Rule
from osc2tx_runtime.language.registry import Method, methods

__all__ = ["capabilities"]


def capabilities() -> dict[str, Any]:
    """Lists what there is, by kind and name, in sorted order.

    Returns:
        `actions`: `vehicle.drive` to its `arguments`, which of them are `required`, `modifiers`,
        `slots` and how it `ends`, whether it `moves` as its modifiers say and whether that has to
        be `physical`;
        `modifiers`: name to parameters; `asked`: those they cannot do without; `placement`: the
        same as `modifiers` for those an actor can start with; `methods`:
        `physical_object.object_distance` to parameters; `fields`: name to type; `exclusive`: groups
        of modifiers of which an action takes one;
        `objects`: actor or value type to what its constructor takes; `needed`: what it cannot do
        without; `reserved`: what actors have besides actions; `enums`: types of the library's
        enums; `rules`: which arguments of a modifier or action go together, as written in
        `argument_rules`; `unknown`: members of actors that only the scenario can say;
        `conflicts`: modifiers to those that they leave no room for;
        `no_start`: modifiers that say nothing of a start; `on_lanes`: those for actors that follow
        lanes, which are `lane_bound`; `sorts` of modifiers, under which `conflicts` lists them as
        well; `contradictions`: pairs of an argument and its value; `shapes`: modifiers to the base
        of their shapes.
    """
    return {
        "actions": {f"{m.kind}.{m.name}": _action(m) for m in methods.all()},
        "modifiers": {name: _parameters(MODIFIERS[name]) for name in sorted(MODIFIERS)},
        "placement": {
            kind.name: _parameters(kind)
            for kind in sorted((*PLACEMENT_MODIFIERS, *MAP_MODIFIERS), key=lambda each: each.name)
        },
        "exclusive": [[kind.name for kind in kinds] for kinds in EXCLUSIVE],
        "methods": {name: _arguments(METHODS[name]) for name in sorted(METHODS)},
        "fields": dict(sorted(FIELDS.items())),
        "objects": {name: _keywords(OBJECTS[name]) for name in sorted(OBJECTS)},
        "needed": {name: _needed(name) for name in sorted(OBJECTS)},
        "asked": {name: _mandatory(MODIFIERS[name]) for name in sorted(MODIFIERS)},
        "unknown": sorted(UNKNOWN),
        "reserved": sorted(_members()),
        "enums": sorted(enums.__all__),
        "conflicts": {
            name: [kind.name for kind in kinds] for name, kinds in sorted(CONFLICTS.items())
        },
        "no_start": sorted(kind.name for kind in NO_START),
        "lane_bound": sorted(
            name for name, kind in OBJECTS.items() if getattr(kind, "lane_bound", False)
        ),
        "on_lanes": sorted(kind.name for kind in ON_LANES),
        "sorts": [dataclasses.asdict(sort) for sort in SORTS],
        "contradictions": [[list(said) for said in pair] for pair in CONTRADICTIONS],
        "shapes": {
            name: kind.shaped_by.kind
            for name, kind in sorted(MODIFIERS.items())
            if kind.shaped_by is not None
        },
        "rules": {
            "a start": _rules(STARTING),
            **{f"{name} while moving": _rules(MOVING[name]) for name in sorted(MOVING)},
            **{name: _rules(MODIFIERS[name].rules) for name in sorted(MODIFIERS)},
            **{f"{m.kind}.{m.name}": _rules(m.factory.rules) for m in methods.all()},
        },
    }


def _members() -> set[str]:
    """Public attributes of actors: an action of such a name would never be looked up."""
    kinds = [kind for kind in OBJECTS.values() if isinstance(kind, type)]
    actors = [kind() for kind in kinds if issubclass(kind, Actor)]
    return {name for actor in actors for name in (*dir(actor),) if not name.startswith("_")}


def _action(method: Method) -> dict[str, Any]:
    accepted = [kind.name for kind in method.factory.accepts if issubclass(kind, Modifier)]
    return {
        "arguments": _arguments(method.factory.__init__),
        "required": _required(method.factory.__init__),
        "modifiers": sorted(accepted),
        "moves": issubclass(method.factory, ShapedAction) and not method.factory.stands,
        "physical": method.factory.physical,
        "slots": list(method.slots),
        "ends": method.ends,
    }


def _arguments(function: Callable[..., Any]) -> list[str]:
    """Names of the parameters in their order, without the actor and what all have."""
    return [
        parameter.name
        for parameter in inspect.signature(function).parameters.values()
        if parameter.name not in ("self", "actor", "duration", "label")
        and parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]


def _required(function: Callable[..., Any]) -> list[str]:
    """Names of those that have no default."""
    parameters = inspect.signature(function).parameters
    names = _arguments(function)
    return [name for name in names if parameters[name].default is inspect.Parameter.empty]


def _keywords(kind: Callable[..., Any]) -> list[str]:
    """Names of all that a constructor takes, those of its bases as well."""
    names: list[str] = []
    for parameter in inspect.signature(kind).parameters.values():
        if parameter.kind is parameter.VAR_KEYWORD:
            hint = get_type_hints(kind.__init__)[parameter.name]
            (fields,) = get_args(hint)
            names += get_type_hints(fields)
        else:
            names.append(parameter.name)
    return names


def _rules(rules: Sequence[Rule]) -> list[dict[str, Any]]:
    """Rules as plain data, without what is not said."""
    written = (dataclasses.asdict(rule) for rule in rules)
    return [{name: value for name, value in rule.items() if value} for rule in written]


def _needed(name: str) -> list[str]:
    parameters = inspect.signature(OBJECTS[name]).parameters.values()
    single = (p for p in parameters if p.kind is not p.VAR_KEYWORD)
    without = (p.name for p in single if p.default is inspect.Parameter.empty)
    return [*without, *MANDATORY.get(name, ())]


def _mandatory(kind: type[Modifier]) -> list[str]:
    fields = (f for f in dataclasses.fields(kind) if f.init and f.default is dataclasses.MISSING)
    return [field.name for field in fields if field.default_factory is dataclasses.MISSING]


def _parameters(kind: type[Modifier]) -> list[str]:
    return [field.name for field in dataclasses.fields(kind)]
