"""The plant: commanded states go to CARLA, and measured states come back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from osc2tx_runtime.errors import SettingsError, SimulatorError
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.scene import Scene, Setpoint
from osc2tx_runtime.world.protocol import EXTERNAL, FEATURES, ActorSpec, ControlMode, Feature
from osc2tx_shared.text import say

from .attendance import Attendance
from .cast import DISPLACED, KICKING, CastMember, Command
from .client_process import ClientProcess
from .ground import floating
from .sensors import SensorStacks
from .spawning import Spawning
from .surroundings import CarlaSurroundings

SETTLING = 2.0  # s within which vehicles have to come to rest on their wheels
AT_REST = 0.05  # m/s upwards
STILL, STILL_STEPS = 0.05, 2
"""Time (s, and steps) of standstill after which an actor is at rest: at the start of a fall, or at
the top of a bounce, it only stands for a moment."""
SAME_DT = 1e-5  # s: frames travel in single precision
DRIVABLE = ("vehicle", "person")


class CarlaPlant:
    """A plant whose actors are in CARLA.

    Args:
        client: A connected client, on the map of the run.
        version: Of the server.
        control: Control mode of an actor, by its id; `""` stands for all others.
        waiting: Seconds to wait for actors of other clients.
        sensors: Sensor stacks.
        ticks: Whether this run makes the steps of the simulator.
        dt: Length of a step (s).
        seed: Of the Traffic Manager.
        manager_port: Port of the Traffic Manager; None: a free one.
        gains: Gains of the controllers of driven vehicles, if they differ from those of the
            category.
        attendance: The attendance of the run.
    """

    def __init__(
        self,
        client: ClientProcess,
        version: str,
        control: Mapping[str, ControlMode],
        waiting: Mapping[str, float],
        sensors: SensorStacks,
        *,
        ticks: bool,
        dt: float,
        seed: int,
        manager_port: int | None,
        gains: Mapping[str, float],
        attendance: Attendance,
    ) -> None:
        self.name = f"carla {version}"
        self._client, self._wanted, self._sensors = client, control, sensors
        self._spawning = Spawning(client, waiting, gains)
        self._ticks, self._dt, self._seed = ticks, dt, seed
        self._manager_port, self._attendance = manager_port, attendance
        self._specs: dict[str, ActorSpec] = {}
        self._members: dict[str, CastMember] = {}
        self._surroundings = CarlaSurroundings(client)
        self._start = 0.0  # s of the episode at step 0
        self._displaced: set[str] = set()
        self._struck: set[str] = set()  # actors with a contact
        self._default = self._default_control(sensors)

    # --- capabilities -------------------------------------------------------------------------

    def control(self, actor: str) -> ControlMode:
        """The control mode of an actor; objects that cannot move are exact."""
        spec = self._specs.get(actor)
        drives = spec is None or (spec.movable and spec.kind in DRIVABLE)
        wanted = self._wanted.get(actor)
        if wanted is None:
            wanted = "external" if self._spawning.awaited(actor) else self._default
            return wanted if drives else "exact"
        if not drives and wanted != "exact":
            raise SettingsError(f"--control {actor}={wanted}: {actor} cannot drive")
        return wanted

    def _default_control(self, sensors: SensorStacks) -> ControlMode:
        """With physics if other clients read velocities of the actors, or may hit them."""
        others = any(each in EXTERNAL for each in self._wanted.values()) or self._spawning.waits
        default: ControlMode = "exact-physics" if others or sensors.see_velocities else "exact"
        return self._wanted.get("", default)

    def capabilities(self) -> frozenset[Feature]:
        """All but one: software under test spawns its cars; see `capabilities`."""
        return FEATURES - {"driver_starts"}

    def shape(self, spec: ActorSpec) -> Shape | None:
        """The shape of the scenario; sizes of CARLA are known after spawning."""
        self._specs[spec.id] = spec
        return None

    # --- run ----------------------------------------------------------------------------------

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Spawn the actors, let them come to rest, and set their speeds."""
        setpoints = scene.setpoints
        foreign = {
            actor: self._spawning.wait(setpoint, self.control(actor))
            for actor, setpoint in setpoints.items()
            if self._spawning.awaited(actor)
        }
        if self._ticks:
            self._client.ask("own_time", self._dt)
        for actor, setpoint in setpoints.items():
            member = foreign.get(actor) or self._spawning.spawn(setpoint, self.control(actor))
            self._members[actor] = member
            if member.is_measured and member.other_size:
                length, width, height = (round(each, 3) for each in member.size)
                scene.note("simulator_size", actor=actor, length=length, width=width, height=height)
        self._sensors.attach(self._client, self._members)
        self._report(scene)
        members = self._members.items()
        first = [each for actor, member in members for each in member.first(setpoints[actor])]
        self._attendance.take_camera(self._client, list(self._members))
        looked = self._at_rest(self._client.ask("step", [*first, *self._view(setpoints)]))
        self._attendance.wait_for_control(
            self._client,
            [each.actor for each in self._members.values() if each.control == "external"],
            ticks=self._ticks,
        )
        looked = self._run_up(looked, setpoints)
        self._attendance.start()
        self._begin_autopilot()
        for member in self._members.values():
            if member.is_measured:
                self._client.ask("watch_collisions", member.actor)
        kicks = [each for actor, member in members for each in member.kick(setpoints[actor])]
        self._client.ask("apply", kicks)
        self._surroundings.begin(scene, ticks=self._ticks)
        self._start = looked["time"]
        return {
            actor: found if self._members[actor].foreign else found._replace(velocity=(v, 0.0, 0.0))
            for actor, found in self._measured(looked, scene).items()
            for v in (setpoints[actor].state.v,)
        }

    def _report(self, scene: Scene) -> None:
        """Report unsupported requests, and the topics of sensors."""
        for problem in self._spawning.problems:
            scene.warn(problem)
        members = self._members
        placed = {a: s for a, s in scene.setpoints.items() if not members[a].is_measured}
        for problem in floating(self._client, placed, scene.map):
            scene.warn(problem)
        roles = {actor: each.spec.role or actor for actor, each in scene.setpoints.items()}
        for line in self._sensors.table(roles):
            say(line)

    def _at_rest(self, looked: Mapping[str, Any]) -> Mapping[str, Any]:
        """Wait until vehicles and walkers are at rest on the ground."""
        falling = {m.actor for m in self._members.values() if m.is_measured}
        still, enough = 0, max(STILL_STEPS, math.ceil(STILL / self._dt))
        for _ in range(math.ceil(SETTLING / self._dt) if self._ticks else 1):
            states = dict(looked["actors"])
            rests = all(abs(states[each][8]) < AT_REST for each in falling if states[each])
            still = still + 1 if rests else 0
            if still == enough or not falling:
                break
            looked = self._client.ask("step", [])
        return looked

    def _run_up(
        self, looked: Mapping[str, Any], setpoints: Mapping[str, Setpoint]
    ) -> Mapping[str, Any]:
        """Accelerate actors that other clients control to their speed, at their start."""
        states, members = dict(looked["actors"]), self._members.items()
        batch = [
            each
            for actor, member in members
            if states.get(member.actor)
            for each in member.run_up(setpoints[actor], states[member.actor], self._dt)
        ]
        for _ in range(math.ceil(KICKING / self._dt) if batch and self._ticks else 0):
            looked = self._client.ask("step", batch)
        return looked

    def _begin_autopilot(self) -> None:
        numbers = [m.actor for m in self._members.values() if m.control == "autopilot"]
        if numbers:
            port = self._client.ask("begin_autopilot", self._manager_port, self._seed)
            self._client.ask("apply", [("autopilot", number, True, port) for number in numbers])

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Go one step on, and measure."""
        setpoints = scene.setpoints
        batch: list[Command] = [
            each
            for actor, member in self._members.items()
            for each in member.commands(setpoints[actor], self._dt)
        ]
        batch += self._surroundings.commands(scene, self._members)
        batch += self._view(setpoints)
        self._attendance.pause(self._dt)
        looked = self._client.ask("step", batch)
        if looked["skipped"]:
            raise SimulatorError(
                "another client ticks CARLA as well: only one client can (--no-tick leaves it to"
                " the other)"
                if self._ticks
                else f"CARLA advanced {looked['skipped'] + 1} steps at once: this run is too slow"
                " for the client that ticks"
            )
        if abs(looked["dt"] - self._dt) > SAME_DT:
            raise SimulatorError(
                f"a step of CARLA was {looked['dt']:g} s long, and those of this run are"
                f" {self._dt:g} s: another client has changed its settings"
            )
        self._surroundings.observe(scene, looked["lights"])
        self._note_collisions(scene, looked)
        return self._measured(looked, scene)

    def _view(self, setpoints: Mapping[str, Setpoint]) -> list[Command]:
        viewed = self._attendance.viewed
        if viewed is None:
            return []
        return self._attendance.view(self._members[viewed].pose(setpoints[viewed].state))

    def _measured(self, looked: Mapping[str, Any], scene: Scene) -> Mapping[str, Measurement]:
        states, dormant = dict(looked["actors"]), looked["dormant"]
        found = {}
        for actor, setpoint in scene.setpoints.items():
            member = self._members[actor]
            state = states.get(member.actor)
            if member.actor in dormant:
                raise SimulatorError(
                    f"{actor} is dormant in CARLA: this level is large, and what is far from its"
                    ' camera and from actors named "hero" stands still'
                    f" (--carla-view {actor} takes the camera along)"
                )
            if state is None:
                self._removed(actor, scene)
                if member.now is not None:
                    found[actor] = member.now._replace(velocity=(0.0, 0.0, 0.0))
            elif setpoint.towed or not member.is_measured:
                self._check_place(actor, member, state, scene)
            else:
                found[actor] = member.measured(state)
        return found

    def _removed(self, actor: str, scene: Scene) -> None:
        """Handle removed actors: CARLA only removes walkers some time after a collision.

        Raises:
            SimulatorError: It was not such a walker.
        """
        if actor not in self._struck or self._members[actor].is_vehicle:
            raise SimulatorError(f"{actor} is not in CARLA any more: another client removed it")
        if not self._members[actor].removed:
            self._members[actor].removed = True
            scene.note("simulator_removed", actor=actor)

    def _check_place(
        self, actor: str, member: CastMember, state: list[float], scene: Scene
    ) -> None:
        off = member.deviation(state)
        if off <= DISPLACED:
            self._displaced.discard(actor)
        elif member.control == "exact-physics":  # it was pushed: it is set back
            if actor not in self._displaced:
                scene.note("simulator_displaced", actor=actor, distance=round(off, 3))
            self._displaced.add(actor)
        else:
            raise SimulatorError(
                f"{actor} is not at the position that was set in CARLA: another client moves it"
                f" (--control {actor}=external leaves it to it)"
            )

    def _note_collisions(self, scene: Scene, looked: Mapping[str, Any]) -> None:
        """Contacts reported by the simulator; the trace's own test decides."""
        names = {member.actor: actor for actor, member in self._members.items()}
        for time, number, other, blueprint in looked["collisions"]:
            self._struck.update(names[each] for each in (number, other) if each in names)
            scene.note(
                "simulator_collision",
                at=round(time - self._start, 3),
                actor=names[number],
                other=names.get(other, blueprint),
            )

    def close(self) -> None:
        """Restore CARLA."""
        self._client.close()
