"""Lists the actions, modifiers and objects of this runtime, for the tables of the compiler.

The compiler rejects everything else before a run.
"""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable, Iterable, Sequence
from types import FunctionType
from typing import Any, get_args, get_type_hints

from osc2tx_runtime import enums, units
from osc2tx_runtime.domain.actions.movement.modifiable import ModifiableAction
from osc2tx_runtime.domain.actors import Actor
from osc2tx_runtime.domain.capability_tables import FIELDS, MANDATORY, METHODS, OBJECTS, UNKNOWN
from osc2tx_runtime.domain.modifiers import MODIFIERS, MapModifier, Modifier, MovementModifier
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.registry import RegisteredMethod, methods
from osc2tx_runtime.language.declared import DeclaredObject
from osc2tx_shared.rules import Rule


def actions() -> dict[str, dict[str, Any]]:
    """List the registered actions of actors, `vehicle.drive`, in sorted order.

    Returns:
        For each its `arguments` and the `required` ones; the `modifiers` that it accepts, and those
        only accepted `modifiers_with` values of a parameter; its `slots`; how it `ends`; whether it
        `moves` as its modifiers state, and whether the motion has to be `physical`; whether it
        `places` and `paces`; what it `needs` of a world; the `rules` of its arguments; why it is
        `undeclared`.
    """
    return {
        method.qualified_name: _action(method, method.factory)
        for method in methods.all()
        if issubclass(method.factory, Action)
    }


def modifiers() -> dict[str, dict[str, Any]]:
    """List the modifiers that have an effect, by name, in sorted order.

    Returns:
        For each its `parameters` and the `required` ones, the base of its `shape`, the `rules` of
        its parameters, and the facts of its registration.
    """
    return {name: _modifier(MODIFIERS[name]) for name in sorted(MODIFIERS)}


def objects() -> dict[str, Any]:
    """List the readable and constructible objects, by kind and name, in sorted order.

    Returns:
        `methods`: `physical_object.object_distance` to its parameters; `fields`: name to type;
        `objects`: actor or value type to the parameters of its constructor; `needed`: the required
        ones; `unknown`: members of actors that only the scenario can state; `reserved`: attributes
        of actors besides actions; `declared`: structs that are objects as actors are, to their
        attributes; `lane_bound`: actors that follow lanes; `enums`: types of the library's enums;
        `units`: names of its units.
    """
    return {
        "methods": {name: _arguments(METHODS[name]) for name in sorted(METHODS)},
        "fields": dict(sorted(FIELDS.items())),
        "objects": {name: _keywords(OBJECTS[name]) for name in sorted(OBJECTS)},
        "needed": {name: _needed(name) for name in sorted(OBJECTS)},
        "unknown": sorted(UNKNOWN),
        "reserved": sorted({name for kind in _declared(Actor) for name in _members(kind)}),
        "declared": {
            name: _members(kind)
            for name, kind in sorted(OBJECTS.items())
            if kind in _declared(DeclaredObject) and kind not in _declared(Actor)
        },
        "enums": sorted(enums.__all__),
        "units": sorted(name for name, unit in vars(units).items() if _is_unit(name, unit)),
        "lane_bound": sorted(
            name for name, kind in OBJECTS.items() if getattr(kind, "lane_bound", False)
        ),
    }


def _is_unit(name: str, value: object) -> bool:
    """Whether a name of the module of units is a unit: a factor, or a scale with an offset."""
    return isinstance(value, float | FunctionType) and not name.startswith("_")


def _action(method: RegisteredMethod, factory: type[Action]) -> dict[str, Any]:
    return {
        "arguments": _arguments(factory.__init__),
        "required": _required(factory.__init__),
        "modifiers": _names(factory.accepts),
        "modifiers_with": {
            parameter: {value: _names(kinds) for value, kinds in values.items()}
            for parameter, values in factory.accepts_with.items()
        },
        "moves": issubclass(factory, ModifiableAction) and not factory.stands,
        "physical": factory.physical,
        "slots": list(method.slots),
        "ends": method.ends,
        "places": method.places,
        "paces": method.paces,
        "needs": list(method.needs),
        "rules": _rules(factory.rules),
        "undeclared": method.undeclared,
    }


def _names(kinds: Iterable[type]) -> list[str]:
    """Return modifiers by name, without duplicates."""
    return sorted({kind.name for kind in kinds if issubclass(kind, Modifier)})


def _modifier(kind: type[Modifier]) -> dict[str, Any]:
    facts = dataclasses.asdict(kind.facts)
    combining = facts.pop("rules")
    combining["while_moving"] = _rules(kind.facts.rules.while_moving)
    shape = kind.shaped_by if issubclass(kind, MovementModifier) else None
    return {
        "parameters": [field.name for field in dataclasses.fields(kind)],
        "required": _mandatory(kind),
        "shape": None if shape is None else shape.kind,
        "rules": _rules(kind.rules),
        "combining": combining,
        **facts,
        "placement": kind.facts.placement or issubclass(kind, MapModifier),
    }


def _declared(base: type[DeclaredObject]) -> list[type[DeclaredObject]]:
    """Classes of objects that a scenario declares."""
    kinds = [kind for kind in OBJECTS.values() if isinstance(kind, type)]
    return [kind for kind in kinds if issubclass(kind, base)]


def _members(kind: type[DeclaredObject]) -> list[str]:
    """Public attributes of an object: an action or a field of such a name would hide them."""
    members = [*dir(kind), *_keywords(kind)] if _required(kind) else dir(kind())
    return sorted({name for name in members if not name.startswith("_")})


def _arguments(function: Callable[..., Any]) -> list[str]:
    """Names of the parameters in their order, without the actor and the common options."""
    return [
        parameter.name
        for parameter in inspect.signature(function).parameters.values()
        if parameter.name not in ("self", "actor", "duration", "label")
        and parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]


def _required(function: Callable[..., Any]) -> list[str]:
    """Names of the parameters without default."""
    parameters = inspect.signature(function).parameters
    names = _arguments(function)
    return [name for name in names if parameters[name].default is inspect.Parameter.empty]


def _keywords(kind: Callable[..., Any]) -> list[str]:
    """Names of all parameters of a constructor and its bases."""
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
    """Rules as plain data, without empty parts."""
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
