"""The base classes of all actions, with and without an actor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import repeat
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, TypedDict

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.actions.base_action import BaseAction, registered_as, with_blame
from osc2tx_runtime.language.actions.method import Method
from osc2tx_runtime.language.tree.duration_limits import Duration

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.modifier import Modifier
    from osc2tx_runtime.language.declared import BaseActor
    from osc2tx_runtime.world.commands import Command
    from osc2tx_runtime.world.measuring.deviation import Deviation


class ActionOptions(TypedDict, total=False):
    """Keywords that every action takes: `**options: Unpack[ActionOptions]`."""

    duration: Duration | None
    label: str | None


class GlobalAction(BaseAction):
    """One action that is not associated with an actor (DSL 7.3.8.3): `log("here")`.

    Its constructor takes the arguments, `duration` and `label`.
    """


class Action(BaseAction):
    """One action of one actor.

    It issues commands with `self.command`, which act from this instant to the next.

    Attributes:
        accepts: Types of modifiers that the action accepts; others are an `UnsupportedError` at
            setup.
        accepts_with: Those accepted only with a value of a parameter; `""`: without a value.
        physical: Whether it moves the actor physically, so that `prefer_non_physical` is
            impossible.
        actor: The actor.
        modifiers: As given.
        modifier_sources: Their source positions; empty without a source map.
        slots: The slots that it claims while it runs; `__init__` of a subclass may narrow them.
    """

    accepts: ClassVar[tuple[type, ...]] = ()
    accepts_with: ClassVar[Mapping[str, Mapping[str, tuple[type, ...]]]] = MappingProxyType({})
    physical: ClassVar[bool] = False

    def __init__(
        self,
        actor: BaseActor,
        *modifiers: Modifier,
        duration: Duration | None = None,
        label: str | None = None,
    ) -> None:
        self.actor = actor
        self.modifiers = modifiers
        self.modifier_sources: tuple[str, ...] = ()
        self.slots = registered_as(type(self)).slots
        super().__init__(duration=duration, label=label)

    @property
    def actor_id(self) -> str:
        """The actor."""
        return self.actor.id

    def become(self, method: Method) -> None:
        """Take name, slots and ending of the method of the action."""
        if self.slots is self.registered.slots:  # not narrowed by a subclass
            self.slots = method.slots
        super().become(method)

    @property
    def jumps_if_it_must(self) -> bool:
        """Whether it can begin at another state of its actor, which is then set to its start."""
        return False

    def state_at_start(self, modifiers: Sequence[Modifier], source: str) -> None:
        """Add modifiers that hold at its start; call it before setup.

        Args:
            modifiers: The modifiers.
            source: Their position in the scenario.
        """
        own = [place for _, place in self.with_sources()]
        self.modifiers = (*modifiers, *self.modifiers)
        self.modifier_sources = (*(source for _ in modifiers), *own)

    def with_sources(self) -> Iterator[tuple[Modifier, str]]:
        """Yield the modifiers with their source positions; by default that of the action."""
        return zip(self.modifiers, self.modifier_sources or repeat(self.source), strict=False)

    def states_itself(self) -> tuple[Modifier, ...]:
        """Return what the action states about its start besides its modifiers."""
        return ()

    def takes(self, modifier: Modifier) -> bool:
        """Return whether the action can execute a modifier."""
        return isinstance(modifier, self.accepts)

    def command(self, slot: str, command: Command) -> None:
        """Command the actor in a claimed slot until the next call or the end of the action."""
        self.context.command(self.actor.id, slot, self, command)

    def setup(self, **kwargs: Any) -> None:
        """Check the modifiers, then take the context."""
        super().setup(**kwargs)
        wrong = [m for m in self.modifiers if not with_blame(self, partial(self.takes, m))]
        if wrong:
            names = ", ".join(dict.fromkeys(f"{type(modifier).__name__}" for modifier in wrong))
            raise UnsupportedError(
                f"{self.action_name} does not take the modifier {names}", self.source or None
            )

    def _claim(self) -> None:
        for slot in self.slots:
            self.context.claim(self.actor.id, slot, self)

    def _release(self, momentary: bool) -> None:
        for slot in self.slots:
            self.context.release(self.actor.id, slot, self, momentary)

    def _deviation(self) -> Deviation | None:
        if not self.slots:
            return None
        return self.context.world.deviation(self.actor.id, self.slots)
