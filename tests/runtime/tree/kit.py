"""A fake world, fake actions, and a way to run a tree in them."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.method import Method
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import TraceWriter
from osc2tx_runtime.language.tree import Behaviour, Event, Status
from osc2tx_runtime.running.loop import Outcome, run_tree
from osc2tx_runtime.running.preparation import setup_tree
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.state import ActorState


class FakeActor:
    kinds = ("vehicle", "physical_object")

    def __init__(self, id: str) -> None:
        self.id = id


class FakeWorld:
    """Actors that drive at the commanded speed along x; remembers all commands."""

    name = "embedded"

    def __init__(self, ids: tuple[str, ...] = (), dt: float = 0.05) -> None:
        self.dt = dt
        self.map = SimpleNamespace(name="fake", remarks=(), seams=tuple)
        self.k = 0
        self.ids = ids
        self.x = dict.fromkeys(ids, 0.0)
        self.v = dict.fromkeys(ids, 0.0)
        self.commands: list[tuple[int, str, str, Any]] = []
        self.contacts: dict[int, list[tuple[str, str]]] = {}

    def actors(self) -> tuple[str, ...]:
        return self.ids

    def state(self, actor: str) -> Any:
        place = self.x[actor], 0.0, -0.0, 0.0
        return ActorState(*place, self.v[actor], 0.0, None, 0.0, Shape(4.5, 1.8, 1.5, 1.0))

    def command(self, actor: str, slot: str, command: Any) -> None:
        wanted = None if command is None else command.target
        self.commands.append((self.k, actor, slot, wanted))
        if slot == "longitudinal" and wanted is not None:
            self.v[actor] = wanted

    def step(self) -> None:
        self.k += 1
        for actor in self.ids:
            self.x[actor] += self.v[actor] * self.dt

    def collisions(self) -> list[tuple[str, str]]:
        return self.contacts.get(self.k, [])

    def control(self, actor: str) -> str:
        return "exact"

    def capabilities(self) -> frozenset[str]:
        return frozenset()

    def begin(self) -> None:
        self.begun = True

    def close(self) -> None:
        self.closed = True

    def deviation(self, actor: str, slots: Any) -> None:
        return None

    def warnings(self) -> tuple[()]:
        return ()

    def overloads(self) -> tuple[()]:
        return ()

    def take_notes(self) -> tuple[()]:
        return ()

    def changed(self) -> tuple[()]:
        return ()

    def unsteady(self) -> tuple[()]:
        return ()


class Drive(Action):
    """Open-ended, claims the longitudinal slot."""

    method = Method("vehicle", "drive", ("longitudinal",), "open")

    def __init__(self, actor: Any, speed: float = 10.0, **options: Any) -> None:
        super().__init__(actor, **options)
        self.speed = speed

    def on_start(self) -> None:
        self.command("longitudinal", SpeedChange(self.speed))


class Task(Action):
    """Succeeds, or fails, after a number of steps."""

    method = Method("vehicle", "task", (), "goal")

    def __init__(self, actor: Any, steps: int, fails: bool = False, **options: Any) -> None:
        super().__init__(actor, **options)
        self.steps, self.fails = steps, fails
        self.action_name = self.name = f"{actor.id} task"
        self.log: list[str] = []

    def on_start(self) -> None:
        self.log.append("start")

    def on_update(self) -> Status:
        if self.elapsed_steps < self.steps:
            return Status.RUNNING
        return self.fail("gave up") if self.fails else Status.SUCCESS

    def on_stop(self) -> None:
        self.log.append("stop")


class Switch(Action):
    """Changes a state at one instant."""

    method = Method("vehicle", "switch", (), "instant")

    def __init__(self, actor: Any, mode: str, **options: Any) -> None:
        super().__init__(actor, **options)
        self.mode = mode

    def on_start(self) -> None:
        self.effect("lights", self.mode, self.apply)

    def apply(self) -> None:
        self.context.trace.lights(self.actor.id, self.mode)

    def on_update(self) -> Status:
        return Status.SUCCESS


class Run:
    """A finished (or broken) run of a tree."""

    outcome: Outcome

    def __init__(
        self,
        tree: Behaviour | Callable[[], Behaviour],
        *,
        max_time: float = 20.0,
        dt: float = 0.05,
        ids: tuple[str, ...] = (),
        world: FakeWorld | None = None,
        events: dict[str, Event] | None = None,
        one_of: str = "race",
        label_events: Any = None,
        **settings: Any,
    ) -> None:
        self.root = tree if isinstance(tree, Behaviour) else tree()
        self.world = world or FakeWorld(ids, dt)
        self.lines: list[str] = []
        self.context = ExecutionContext(
            self.world,  # type: ignore[arg-type]
            RunSettings(dt=dt, max_time=max_time, **settings),
            {id: FakeActor(id) for id in self.world.ids},  # type: ignore[misc]
            events=events,
            trace=TraceWriter(self.lines.extend),
            one_of=one_of,
            label_events=label_events,
        )

    def go(self) -> Run:
        setup_tree(self.root, self.context)
        self.outcome = run_tree(self.root, self.context)
        return self


def event(name: str) -> Event:
    made = Event()
    made.name = name
    return made
