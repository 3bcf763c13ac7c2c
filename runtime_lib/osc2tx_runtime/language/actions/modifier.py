"""The base class of all modifiers."""

from __future__ import annotations

from dataclasses import field, fields
from typing import Any, ClassVar

from osc2tx_runtime.language.actions.argument_rules import check_arguments
from osc2tx_runtime.world.protocol import Feature
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.rules import ModifierRules, Rule

COURSE = "course along the road"
LANE = "lane"
SIDE = "place across the lane"
"""Topics: an action takes one modifier of each."""


@dataclass(frozen=True, slots=True)
class ModifierFacts:
    """The facts about a modifier.

    Attributes:
        rules: Its effect on other modifiers of the same action.
        slots: Slots of the actor that it controls: LONGITUDINAL, LATERAL, both or none.
        places: Whether it states the position of the actor.
        paces: Whether it states the speed of the actor, or its position at each time.
        bounds: Whether an open-ended action ends when the state of the modifier is reached.
        placement: Whether an actor can start with it.
        orders: Parameters that only state an order, such as `faster_than`,
        amounts: whose amount is given by one of these, or is open.
        needs: Capabilities of the world that it requires.
        undeclared: Why the library does not declare it, if it does not.
    """

    rules: ModifierRules = field(default_factory=ModifierRules)
    slots: tuple[str, ...] = ()
    places: bool = False
    paces: bool = False
    bounds: bool = False
    placement: bool = False
    orders: tuple[str, ...] = ()
    amounts: tuple[str, ...] = ()
    needs: tuple[Feature, ...] = ()
    undeclared: str = ""


@dataclass(frozen=True, slots=True)
class Modifier:
    """Base of all modifiers.

    Attributes:
        name: Name in the DSL.
        facts: Facts stated at its registration.
        rules: Rules for its parameters; the compiler applies them as well.
    """

    name: ClassVar[str] = ""
    facts: ClassVar[ModifierFacts] = ModifierFacts()
    rules: ClassVar[tuple[Rule, ...]] = ()

    def __post_init__(self) -> None:
        """Checks the rules. With slots, subclasses cannot reach it by `super()`."""
        check_arguments(self.name, self.rules, self.given())
        self.check()

    def check(self) -> None:
        """Checks what rules cannot express."""

    @property
    def is_start(self) -> bool:
        """Whether it only constrains the start."""
        return getattr(self, "at", "all") == "start" and self.facts.rules.starts

    def at_start(self) -> Modifier:
        """Return it as a constraint of the start only, if possible."""
        options: dict[str, Any] = {"at": "start"} if self.facts.rules.starts else {}
        return replace(self, **options)

    def given(self) -> dict[str, Any]:
        """Parameters with values other than those of a modifier without arguments."""
        kind = type(self)
        if kind not in _DEFAULTS:
            _DEFAULTS[kind] = tuple((field.name, field.default) for field in fields(kind))
        values = ((name, default, getattr(self, name)) for name, default in _DEFAULTS[kind])
        return {
            name: value for name, default, value in values if value is not None and value != default
        }


_DEFAULTS: dict[type[Modifier], tuple[tuple[str, object], ...]] = {}
"""Cache: parameters of modifiers without arguments, by class."""
