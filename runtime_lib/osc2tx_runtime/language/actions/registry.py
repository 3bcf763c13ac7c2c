"""The registry of actions: DSL name to class; creates the nodes of calls."""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from osc2tx_runtime.errors import (
    NoActionError,
    OwnCode,
    ScenarioError,
    is_own,
    name_of,
)
from osc2tx_runtime.language.actions.argument_rules import check_arguments
from osc2tx_runtime.language.actions.base_action import BaseAction, RefusedAction, full_name
from osc2tx_runtime.language.actions.method import LATERAL, LONGITUDINAL, Ends, Method
from osc2tx_runtime.language.declared import BaseActor
from osc2tx_runtime.language.tree.base import split_label
from osc2tx_runtime.language.tree.module_text import call_arguments
from osc2tx_runtime.world.protocol import Feature
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

__all__ = [
    "ENTRY_POINTS",
    "LATERAL",
    "LONGITUDINAL",
    "MethodRegistry",
    "RegisteredMethod",
    "action",
    "carried_out",
    "global_action",
    "methods",
    "user_action",
]

ENTRY_POINTS = "osc2tx.methods"
"""Group of entry points; each names a module that registers actions. See docs/extending.md."""

_OPTIONS = ("duration",)  # of all actions

ActionT = TypeVar("ActionT", bound="type[BaseAction]")
ClassT = TypeVar("ClassT")


@dataclass(frozen=True, slots=True, kw_only=True)
class RegisteredMethod(Method):
    """An action with the class that executes it.

    Attributes:
        factory: The class.
    """

    factory: type[BaseAction]

    def signature(self) -> str:
        """Return the form of a call: `change_lane(*modifiers, num_of_lanes=1, ...)`."""
        parameters = list(inspect.signature(self.factory).parameters.values())
        written = parameters if self.kind is None else parameters[1:]  # not `actor`
        return f"{self.name}({', '.join(str(parameter) for parameter in written)})"


class MethodRegistry:
    """Finds action classes by actor kind and method name."""

    def __init__(self) -> None:
        self._methods: dict[tuple[str | None, str], RegisteredMethod] = {}
        self._extended = False

    def extend(self) -> None:
        """Import the modules that installed packages name in the entry point group.

        This happens once, when an unregistered method is requested, because it takes time.

        Raises:
            ScenarioError: Such a module cannot be imported.
        """
        if self._extended:
            return
        self._extended = True
        for entry in _installed():
            package = "" if entry.dist is None else f" of {entry.dist.name}"
            with OwnCode(f"the actions in {entry.value}{package} cannot be loaded:"):
                entry.load()

    def is_extensible(self) -> bool:
        """Whether a package has provided an action, or is installed and may provide one."""
        return any(is_own(each.factory) for each in self._methods.values()) or bool(_installed())

    def action(
        self,
        kind: str | None,
        name: str,
        *,
        slots: Iterable[str] = (),
        ends: Ends = "goal",
        places: bool = False,
        paces: bool | None = None,
        needs: Iterable[Feature] = (),
        undeclared: str = "",
        replace: bool = False,
    ) -> Callable[[ActionT], ActionT]:
        """Register the decorated class as method `name` of actors of `kind`.

        Args:
            kind: Actor kind of the DSL, such as `vehicle`, for an `Action`; None for a
                `GlobalAction`.
            name: Method name.
            slots: Slots that the action claims while it runs.
            ends: When it ends.
            places: Whether its arguments state the position of the actor.
            paces: Whether it sets or holds the speed; default: whether it claims the longitudinal
                slot.
            needs: Capabilities of the world that it requires.
            undeclared: Why the library does not declare a built-in action.
            replace: Replace a registered class instead of reporting it.

        Raises:
            ValueError: The method is already registered.
        """

        def register(factory: ActionT) -> ActionT:
            known = self._methods.get((kind, name))
            if known is not None and not replace:
                raise ValueError(
                    f"{known.qualified_name} is registered already, by"
                    f" {known.factory.__qualname__}; pass replace=True to take its place"
                )
            claimed = tuple(slots)
            method = RegisteredMethod(
                kind,
                name,
                claimed,
                ends,
                places=places,
                paces=LONGITUDINAL in claimed if paces is None else paces,
                needs=tuple(needs),
                undeclared=undeclared,
                factory=factory,
            )
            self._methods[kind, name] = method
            if "method" not in vars(factory):  # for instances created without the registry
                factory.method = method
            return factory

        return register

    def find(self, kinds: Iterable[str | None], name: str) -> RegisteredMethod | None:
        """Return the method of the first of `kinds` (most derived first) that has it."""
        for kind in kinds:
            method = self._methods.get((kind, name))
            if method is not None:
                return method
        return None

    def names(self, kinds: Iterable[str | None]) -> tuple[str, ...]:
        """Return the sorted method names of an actor with these kinds."""
        wanted = tuple(kinds)
        return tuple(sorted({name for kind, name in self._methods if kind in wanted}))

    def near(self, kinds: Iterable[str | None], name: str) -> tuple[str, ...]:
        """Return up to three method names that are similar to `name`."""
        from difflib import get_close_matches  # only needed where something is wrong

        return tuple(get_close_matches(name, self.names(kinds), n=3))

    def bind(self, actor: BaseActor | None, name: str) -> Callable[..., BaseAction]:
        """Return the constructor of the action `name`, for one actor or without one.

        An invalid call, of an unregistered action or with unknown arguments, rejects the run at its
        line before the first step.
        """
        kinds: tuple[str | None, ...] = (None,) if actor is None else type(actor).kinds
        actor_id, acting = (None, ()) if actor is None else (actor.id, (actor,))
        if self.find(kinds, name) is None:
            self.extend()
        found = self.find(kinds, name)

        def create(*args: Any, **kwargs: Any) -> BaseAction:
            label, modifiers = split_label(args)
            try:
                if found is None:
                    raise self._missing(kinds, name)
                positional = (*acting, *modifiers)
                _check_arguments(found, full_name(actor_id, name), positional, kwargs)
                labelled = kwargs if label is None else {**kwargs, "label": label}
                node = make(found, full_name(actor_id, name), positional, labelled)
            except ScenarioError as error:
                return RefusedAction(full_name(actor_id, name), error, label)
            node.become(found)
            node.name = label or called(actor_id, name, call_arguments())
            return node

        return create

    def has(self, actor: BaseActor, name: str) -> bool:
        """Whether an action of an actor is registered, or a package registers it."""
        kinds = type(actor).kinds
        if self.find(kinds, name) is None:
            self.extend()
        return self.find(kinds, name) is not None

    def known_to(self, actor: BaseActor, name: str, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return the arguments that an action of an actor takes."""
        found = self.find(type(actor).kinds, name)
        known = () if found is None else (*_signature(found.factory).parameters, *_OPTIONS)
        return {key: value for key, value in given.items() if key in known}

    def _missing(self, kinds: tuple[str | None, ...], name: str) -> NoActionError:
        near = self.near(kinds, name)
        hint = f"; did you mean {' or '.join(near)}?" if near else ""
        what = f"{kinds[0]} has no action" if kinds[0] else "there is no global action"
        return NoActionError(
            f"{what} `{name}`, and no installed package brings one by the entry"
            f" point group {ENTRY_POINTS}{hint}"
        )

    def signature(self, kind: str, name: str) -> str:
        """Return how a method is called, as text."""
        return self._methods[kind, name].signature()

    def all(self) -> tuple[RegisteredMethod, ...]:
        """Return every method, sorted by kind and name."""
        return tuple(sorted(self._methods.values(), key=lambda each: (each.kind or "", each.name)))


def _installed() -> list[EntryPoint]:
    from importlib.metadata import entry_points

    return sorted(entry_points(group=ENTRY_POINTS), key=lambda found: found.name)


def called(actor_id: str | None, name: str, arguments: str) -> str:
    """Return a call as written in the scenario, `ego.drive(...)`, as the name of its node."""
    return f"{name}{arguments}" if actor_id is None else f"{actor_id}.{name}{arguments}"


def make(
    method: RegisteredMethod, what: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> BaseAction:
    """Make an action.

    Raises:
        ScenarioError: A user-defined class raises an exception.
    """
    if not is_own(method.factory):
        return method.factory(*args, **kwargs)
    with OwnCode(f"{what}: {name_of(method.factory)} raised"):
        made: object = method.factory(*args, **kwargs)
    if not isinstance(made, BaseAction):
        kind = type(made).__name__
        raise ScenarioError(f"{name_of(method.factory)} makes a {kind}, no Action")
    return made


_signature = functools.cache(inspect.signature)


def _check_arguments(
    method: RegisteredMethod, what: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> None:
    """Compare a call with the signature and the rules of the class.

    Raises:
        ScenarioError: They do not match.
    """
    signature = _signature(method.factory)
    unknown = [name for name in kwargs if name not in (*signature.parameters, *_OPTIONS)]
    try:
        if unknown:  # `**options` would pass them on
            raise TypeError(f"unknown argument '{unknown[0]}'")
        signature.bind(*args, **kwargs)
    except TypeError as error:
        raise ScenarioError(f"{what}: {error}; it is {method.signature()}") from error
    given = {name: value for name, value in kwargs.items() if value is not None}
    modifiers = args if method.kind is None else args[1:]  # the actor precedes them
    given.update({"with": modifiers} if modifiers else {})
    check_arguments(what, method.factory.rules, given)


methods = MethodRegistry()
"""The registry of all actors; user-defined actions are registered here as well."""

action = methods.action


def carried_out(declared: type[ClassT]) -> type[ClassT]:
    """Let the registry execute the methods that a class declares: `self.ego.drive(...)`.

    They exist for their types and docstrings; the class that is registered for the actor receives
    and checks their arguments.
    """
    for name, method in vars(declared).copy().items():
        if not name.startswith("_"):
            setattr(declared, name, functools.wraps(method)(_caller(name)))
    return declared


def user_action(name: str, declared: type | None = None) -> Any:
    """Return the function `name(actor, ...)` of an action that a user's package registers.

    Args:
        name: Its name in the registry.
        declared: Its declared type: the defaults are those of its `__call__`. Its `base`, if it has
            one, names the action that carries it out where no package registers it.
    """
    defaults = _defaults(declared)
    base: str | None = getattr(declared, "base", None)

    def call(actor: BaseActor, *args: Any, **kwargs: Any) -> BaseAction:
        given = {**defaults, **kwargs}
        if base is None or methods.has(actor, name):
            node = methods.bind(actor, name)(*args, **given)
        else:
            node = methods.bind(actor, base)(*args, **methods.known_to(actor, base, given))
        written = re.sub(r"^\([^,)]*(, )?", "(", call_arguments())  # the actor precedes it
        node.name = node.label or called(actor.id, name, written)
        return node

    return call


def global_action(name: str, declared: type | None = None) -> Any:
    """Return the function `name(...)` of an action without an actor, which a package registers.

    Args:
        name: Its name in the registry.
        declared: See `user_action`.
    """
    defaults = _defaults(declared)

    def call(*args: Any, **kwargs: Any) -> BaseAction:
        return methods.bind(None, name)(*args, **{**defaults, **kwargs})

    return call


def _defaults(declared: type | None) -> dict[str, Any]:
    """Return the defaults that the type of an action states; `...` stands for an unknown one."""
    if declared is None:
        return {}
    parameters = inspect.signature(declared.__call__).parameters.values()
    defaults = {each.name: each.default for each in parameters}
    left_out = (inspect.Parameter.empty, ..., None)
    return {name: value for name, value in defaults.items() if value not in left_out}


def _caller(name: str) -> Callable[..., BaseAction]:
    def call(actor: BaseActor, *args: Any, **kwargs: Any) -> BaseAction:
        return methods.bind(actor, name)(*args, **kwargs)

    return call
