"""The base class of scenarios: members that generated classes write and call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar, overload

from osc2tx_runtime.errors import NO_RESULT, ScenarioError
from osc2tx_runtime.language.actions.modifier import Modifier
from osc2tx_runtime.language.actions.placement import Placement
from osc2tx_runtime.language.declared import BaseActor
from osc2tx_runtime.language.scenario_members import check_arguments, check_settings, name_members
from osc2tx_runtime.language.scenario_parts import Caller, ScenarioParts
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.tree.assembly import assemble, invoked_placements, number_nodes
from osc2tx_runtime.language.tree.base import Behaviour, split_label
from osc2tx_runtime.language.tree.duration_limits import Duration
from osc2tx_runtime.language.tree.events import Event, Guard, Trigger
from osc2tx_runtime.language.tree.invocation import (
    Invocation,
    draw_key,
    unique_name,
)
from osc2tx_runtime.language.tree.late_invocation import (
    LateInvocation,
    is_recursive,
    late_arguments,
)
from osc2tx_runtime.language.tree.override import Mode
from osc2tx_runtime.language.tree.special import Special, choice
from osc2tx_runtime.language.tree.variables import MISSING, Boundary, Sampled
from osc2tx_runtime.language.values.broken_values import not_computed
from osc2tx_shared.classes import replace

AnyT = TypeVar("AnyT")
ActorT = TypeVar("ActorT", bound=BaseActor)
EventT = TypeVar("EventT", bound=Event)


class BaseScenario(ScenarioParts):
    """A scenario, independent of its actor types.

    Args:
        settings: Of the run.
        caller: The scenario that invokes this one; `invoke` gives it.
        **arguments: Values of parameters, before those of the settings; for an invoked scenario
            also the actors that replace the declared ones.
    """

    def __init__(
        self,
        settings: RunSettings | None = None,
        *,
        caller: Caller | None = None,
        **arguments: Any,
    ) -> None:
        super().__init__(settings or RunSettings(), caller, arguments)
        self._declare_values(self.declare)
        name_members(self)
        check_arguments(self)
        self._computed(self.placement)
        self._own_placements = len(self.placements)

    # --- written by generated classes ---

    def declare(self) -> None:
        """Set the cast, events and values as attributes."""

    def placement(self) -> None:
        """Call `place` for actors with constraints on their start."""

    def behavior(self) -> Behaviour:
        """Return the tree."""
        message = f"scenario {self.name} has no behavior: run one that inherits it"
        raise ScenarioError(message, self.source)

    @classmethod
    def is_abstract(cls) -> bool:
        """Whether a scenario only serves as a base: it has no behavior."""
        return cls.behavior is BaseScenario.behavior

    # --- used by generated classes ---

    def cast(self, name: str, declared: ActorT) -> ActorT:
        """Return the actor of a role: that of the invoker, else the declared one.

        All scenarios of a run share one map and one environment.

        Args:
            name: Name of the role.
            declared: The actor as declared.
        """
        declared = self._fixed(name, declared)
        given = None if self._caller is None else self._caller.cast(name, declared)
        if given is not None:
            return given
        self._roles[id(declared)] = name
        return self._only(declared) if declared.one_per_run else declared

    def global_object(self, name: str, declared: AnyT) -> AnyT:
        """Return a global actor or struct: that of the first scenario of the run.

        Args:
            name: Name of the global parameter.
            declared: The object as declared.
        """
        declared = self._fixed(name, declared)
        if isinstance(declared, BaseActor) and declared.one_per_run:
            declared = self._only(declared)
        shared: AnyT = self._shared_objects.setdefault(name, declared)
        return shared

    def place(
        self,
        actor: BaseActor,
        *modifiers: Modifier,
        throughout: bool = False,
        implied: bool = False,
    ) -> None:
        """State the start of an actor.

        Args:
            actor: The actor.
            *modifiers: Conditions at the start.
            throughout: The first action also establishes it: if the scenario is invoked during a
                run, no actor is placed.
            implied: It is not stated, but implied by the first action of the actor. Ignored if the
                start is stated otherwise, or if the actor is already placed.
        """
        source = self._source_map.of_placement(len(self.placements))
        self.placements.append(Placement(actor, modifiers, source, throughout, implied))

    def sample(
        self,
        expression: Callable[[], AnyT],
        trigger: Trigger | Boundary,
        default: Any = MISSING,
        *,
        condition: Guard | None = None,
        name: str = "",
    ) -> AnyT:
        """Create a variable: `self.v = self.sample(lambda: self.ego.speed, self.near, 0 * mps)`.

        Read later, `self.v` is its latest value: `default`, and from the pass after an occurrence
        the value of `expression` at that occurrence.

        Args:
            expression: Gives the new value.
            trigger: When: an event, a condition or a boolean function; `"start"` and `"end"` refer
                to this scenario.
            default: Value before the first sample; without it, earlier reads are an error.
            condition: With an event: only an occurrence at which this is true counts.
            name: Name in the scenario, if an attribute cannot have it (`from`).
        """
        variable: Any = Sampled(expression, trigger, default, condition, name)
        return variable  # type: ignore[no-any-return]

    @overload
    def invoke(
        self,
        scenario: type[BaseScenario],
        /,
        *specials: Special[BaseScenario],
        actor: BaseActor | None = None,
        duration: Duration | None = None,
        known_as: str | None = None,
        times: Mapping[str, float] | None = None,
        **arguments: Any,
    ) -> Behaviour: ...
    @overload
    def invoke(
        self,
        label: str,
        scenario: type[BaseScenario],
        /,
        *specials: Special[BaseScenario],
        actor: BaseActor | None = None,
        duration: Duration | None = None,
        known_as: str | None = None,
        times: Mapping[str, float] | None = None,
        **arguments: Any,
    ) -> Behaviour: ...
    def invoke(
        self,
        /,
        *label_and_scenarios: Any,
        actor: BaseActor | None = None,
        duration: Duration | None = None,
        known_as: str | None = None,
        times: Mapping[str, float] | None = None,
        **arguments: Any,
    ) -> Behaviour:
        """Invoke another scenario: `self.invoke("p1", Approach, actor=self.ego, lead=self.car1)`.

        Its random values depend on the seed and on the label; without a label, on its name and the
        names of the actors; not on the order of invocations.

        Args:
            *label_and_scenarios: Its class, and conditional ones that run instead if the arguments
                match: `Phase, SlowPhase.when(fast=False)`. The label is optional; it is the name
                for `@label.end`, for settings (`--set label.gap=12`) and in the trace.
            actor: Its `actor`, for a scenario of an actor.
            duration: Its duration: seconds, or (least, most) seconds.
            known_as: Its name in settings and in the trace if it has no label; else the name of the
                scenario, numbered in the order of the calls.
            times: Seconds that it and what it invokes would draw, by path, `{"p1.wait time": 2.0}`.
            **arguments: Its parameters (drawn from ranges) and actors. Functions are evaluated when
                the invocation starts, and it is created then.

        Raises:
            ScenarioError: The arguments do not match.
        """
        label, (scenario, *specials) = split_label(label_and_scenarios)
        given = arguments if actor is None else {"actor": actor, **arguments}
        name = unique_name(label or known_as or scenario.name.rpartition(".")[2], self._invoked)
        path = f"{self._path}.{name}" if self._path else name
        who = label or (f"{actor.id} {name}" if actor is not None else name)
        key = label or draw_key(self, scenario, actor, arguments)
        key = unique_name(key if self._caller is None else f"{self._caller.key}/{key}", self._keys)
        self._keys[key] = None

        handed_in = {**self._times_below(name), **(times or {})}
        caller = Caller(self, path, key, given, handed_in)

        late = late_arguments(given)

        def made() -> Invocation:
            values = {name: each() if name in late else each for name, each in given.items()}
            chosen, values = choice(scenario, specials, values)
            by = replace(caller, arguments=values)
            invoked = chosen(self.settings, caller=by, **values)
            self._invoked[name] = invoked
            return Invocation(who, invoked, invoked.create_tree(), duration)

        classes = (scenario, *(special.scenario for special in specials))
        if late or any(is_recursive(self, each) for each in classes):
            return LateInvocation(who, self, classes, made)
        return made()

    @classmethod
    def when(cls, **values: Any) -> Special[BaseScenario]:
        """Return this scenario as a variant of its base: `SlowPhase.when(fast=False)`.

        Args:
            **values: The arguments of the base for which it runs.
        """
        return Special(cls, values)

    def override(self, overridden: str, by: str, mode: Mode = "on_start") -> None:
        """Let the start of a behavior end another; call it in `behavior`.

        Args:
            overridden: Label of the overridden behavior.
            by: Label of the behavior that overrides it.
            mode: `when_active`: it also does not start while the other behavior runs.
        """
        self._overrides.append((overridden, by, mode))

    def started(self, label: str) -> Event:
        """Return the event at which the node with this label starts."""
        return self._label_event(label, "start")

    def ended(self, label: str) -> Event:
        """Return the event at which the node with this label ends."""
        return self._label_event(label, "end")

    def failed(self, label: str) -> Event:
        """Return the event at which the node with this label fails."""
        return self._label_event(label, "fail")

    @overload
    def event(self, path: str, /) -> Event: ...
    @overload
    def event(self, path: str, kind: type[EventT], /) -> EventT: ...
    def event(self, path: str, kind: type[Event] = Event, /) -> Event:
        """Return an event of an invoked scenario: `self.event("p1.near")`, `"p1.cut.end"`.

        Args:
            path: Its name below the labels of invocations.
            kind: Its class, to read its parameters: `self.event("p1.near", Approach.Near).gap`.
        """
        found = self._inner_events.setdefault(path, kind())
        found.name = path
        if isinstance(found, kind):
            return found
        read = kind(name=path)
        read.alias = found
        return read

    # --- used by the runtime ---

    def create_tree(self) -> Behaviour:
        """Return the tree, each node with its source position."""
        self._invoked, self._keys, self._overrides = {}, {}, []
        tree = assemble(self, self._computed(self.behavior))
        if self._caller is None:
            # Stable: the actors of each scenario in their order, the scenarios by path.
            self.actors = dict(
                sorted(self.actors.items(), key=lambda item: item[0].rpartition(".")[0])
            )
            self.placements[self._own_placements :] = invoked_placements(self, tree)
            tree = self.completed(tree)
            number_nodes(self, tree)
            check_settings(self)
        return tree

    def completed(self, tree: Behaviour) -> Behaviour:
        """Return the whole tree of a run with the nodes of the domain."""
        return tree

    def _computed(self, method: Callable[[], AnyT]) -> AnyT:
        """Call a method of the generated class.

        A value without result is an error of the scenario.
        """
        try:
            return method()
        except NO_RESULT as error:
            raise not_computed(error, self._source_map, 0) from error

    if not TYPE_CHECKING:  # so that type checkers still know the attributes

        def __setattr__(self, name: str, value: Any) -> None:
            if isinstance(value, Sampled):
                known_as = value.name or name
                value.name = f"{self._path}.{known_as}" if self._path else known_as
                self._variables[name] = value
                return
            object.__setattr__(self, name, value)

        def __getattr__(self, name: str) -> Any:
            variables = self.__dict__.get("_variables", {})
            if name in variables:
                return variables[name].read()
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
