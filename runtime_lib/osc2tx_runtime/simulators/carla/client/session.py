"""A session with a server: what it changes it undoes in the end."""

from __future__ import annotations

import math
import socket
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import carla

from . import release_of
from .commands import command_of
from .snapshots import Collisions, actor_state, light_states

POLL = 0.1  # s between two looks for an actor of somebody else
GLANCE = 0.5  # s to wait for a step of somebody else before it is looked for
SUBSTEP, MOST_SUBSTEPS = 0.01, 16
"""s, and how many of them the server makes in a step at most."""

ROLLING = 0.1  # m/s of a vehicle that somebody controls
LISTENS = 2.0  # s that a port has to take a connection
TICKS = 2.0  # s without a step after which nobody makes them


class Session:
    """A session; its methods are the requests, with values that JSON knows."""

    def __init__(self) -> None:
        self._own: list[int] = []
        self._undo: list[Callable[[], object]] = []  # undone from the last one on
        self._ticks = False
        self._collisions = Collisions()
        self._lights: dict[str, Any] = {}
        self._weather: Any = None  # before the first change
        self._frame: int | None = None
        self._watched: list[int] = []

    # --- connection and map -------------------------------------------------------------------

    def connect(self, host: str, port: int, timeout: float) -> Mapping[str, Any]:
        """Return what a first contact finds, up to the first thing that is missing.

        Returns:
            `listens`: a port answers. `server`, `client`: versions; they have to be of one release,
            since others may not even have the same calls. `streams`: snapshots arrive; else
            `stream_port` says whether the port of the streams, the next one by default, answers.
            `synchronous`: steps wait for a client, which makes them if `ticks`; `dt` (s): theirs.
        """
        self._address, self._timeout = (host, port), timeout
        found: dict[str, Any] = {"listens": _listens(host, port)}
        if not found["listens"]:
            return found
        self._client = carla.Client(host, port)
        self._client.set_timeout(timeout)
        found["server"] = self._client.get_server_version()
        found["client"] = self._client.get_client_version()
        if release_of(found["server"]) != release_of(found["client"]):
            return found
        try:
            self._world = self._client.get_world()
        except RuntimeError as error:
            if "time-out" not in str(error):
                raise
            return {**found, "streams": False, "stream_port": _listens(host, port + 1)}
        settings = self._world.get_settings()
        found |= {"streams": True, "synchronous": settings.synchronous_mode}
        if settings.synchronous_mode:
            found |= {"dt": settings.fixed_delta_seconds, "ticks": self._is_ticked()}
        return found

    def _is_ticked(self) -> bool:
        """Return whether another client makes steps."""
        try:
            self._world.wait_for_tick(TICKS)
        except RuntimeError:  # none came
            return False
        return True

    def free_time(self) -> None:
        """End a synchronous mode that a client has left behind."""
        settings = self._world.get_settings()
        settings.synchronous_mode, settings.fixed_delta_seconds = False, None
        self._world.apply_settings(settings)

    def level(self) -> Mapping[str, Any]:
        """Return name, OpenDRIVE text and spawn points of the level, and which maps there are."""
        found = self._world.get_map()
        return {
            "name": found.name.rpartition("/")[2],
            "text": found.to_opendrive(),
            "spawn_points": [written(point) for point in found.get_spawn_points()],
        }

    def maps(self) -> Sequence[str]:
        """Return the names of the maps that the server has."""
        return [each.rpartition("/")[2] for each in self._client.get_available_maps()]

    def load(self, name: str, patience: float) -> None:
        """Load a map of the server, which may take so many seconds."""
        with self._patient(patience):
            self._world = self._client.load_world(name)

    def generate(self, text: str, patience: float) -> None:
        """Make a level from OpenDRIVE text, without walls beside the road; patience as in `load`.

        A mesh for pedestrians is left out: it takes long, and walkers are led without it.
        """
        parameters = carla.OpendriveGenerationParameters()
        parameters.wall_height = 0.0
        parameters.enable_pedestrian_navigation = False
        with self._patient(patience):
            self._world = self._client.generate_opendrive_world(text, parameters)

    @contextmanager
    def _patient(self, seconds: float) -> Iterator[None]:
        """Give calls more time: the library goes on trying for as long as one call may take."""
        self._client.set_timeout(max(seconds, self._timeout))
        try:
            yield
        finally:
            self._client.set_timeout(self._timeout)

    def blueprints(self) -> Mapping[str, Mapping[str, Sequence[str]]]:
        """Return recommended values of the attributes of all blueprints."""
        return {
            blueprint.id: {
                attribute.id: [str(value) for value in attribute.recommended_values]
                for attribute in blueprint
            }
            for blueprint in self._world.get_blueprint_library()
        }

    # --- time ---------------------------------------------------------------------------------

    def own_time(self, dt: float) -> None:
        """Take the time into our hands: steps of so many seconds, made by us."""
        before = self._world.get_settings()
        self._undo.append(lambda: self._world.apply_settings(before))
        settings = self._world.get_settings()
        settings.synchronous_mode, settings.fixed_delta_seconds = True, dt
        settings.max_substeps = min(MOST_SUBSTEPS, max(1, math.ceil(dt / SUBSTEP - 1e-9)))
        settings.max_substep_delta_time = max(SUBSTEP, dt / settings.max_substeps)
        self._ticks = True
        self._world.apply_settings(settings)

    def step(self, commands: Sequence[Sequence[Any]]) -> Mapping[str, Any]:
        """Carry out commands, go on by a step, and return how things are then."""
        if self._ticks:
            self.apply(commands)
            self._world.tick(self._timeout)
            return self.look()
        late = self._steps_since_look()
        self.apply(commands)
        self._wait_for_step()
        looked = self.look()
        return {**looked, "skipped": max(looked["skipped"], late)}

    def _steps_since_look(self) -> int:
        """How many steps the server has made since the last look."""
        frame = self._world.get_snapshot().frame
        if self._frame is None:
            self._frame = frame
        return int(frame - self._frame)

    def _wait_for_step(self) -> None:
        """Wait until the other client has made a step, be it before this side began to wait."""
        end = time.monotonic() + self._timeout
        while not self._steps_since_look():
            try:
                self._world.wait_for_tick(GLANCE)
            except RuntimeError:  # none came in so short a time
                if time.monotonic() > end:
                    raise

    def apply(self, commands: Sequence[Sequence[Any]]) -> None:
        """Carry out commands; one that the server refuses is an error."""
        batch = [command_of(each) for each in commands]
        answers = self._client.apply_batch_sync(batch, False) if batch else []
        refused = [
            f"{each[0]} of actor {each[1]}: {answer.error}"
            for each, answer in zip(commands, answers, strict=True)
            if answer.error
        ]
        if refused:
            raise RuntimeError(refused[0])

    def look(self) -> Mapping[str, Any]:
        """Return the latest snapshot: states of the watched actors, traffic lights, contacts."""
        snapshot = self._world.get_snapshot()
        skipped = 0 if self._frame is None else snapshot.frame - self._frame - 1
        self._frame = snapshot.frame
        actors = {}
        for actor in self._watched:
            found = snapshot.find(actor)
            actors[actor] = None if found is None else actor_state(found)
        return {
            "skipped": skipped,
            "dt": snapshot.timestamp.delta_seconds,
            "time": snapshot.timestamp.elapsed_seconds,
            "actors": list(actors.items()),
            "lights": light_states(self._lights),
            "collisions": self._collisions.take(),
        }

    # --- actors -------------------------------------------------------------------------------

    def spawn(
        self, blueprint: str, attributes: Mapping[str, str], pose: Sequence[float], parent: int = 0
    ) -> Mapping[str, Any]:
        """Make an actor that goes with the session, and return what it is like."""
        description = self._world.get_blueprint_library().find(blueprint)
        for name, value in attributes.items():
            description.set_attribute(name, value)
        holder = self._world.get_actor(parent) if parent else None
        actor = self._world.spawn_actor(description, transform(pose), attach_to=holder)
        self._owns(actor)
        return self._described(actor)

    def _owns(self, actor: Any) -> None:
        """Destroy an actor in the end."""
        if not self._own:
            self._undo.append(self._destroy)
        self._own.append(actor.id)

    def find(self, role: str, patience: float) -> Sequence[Mapping[str, Any]]:
        """Return vehicles and walkers of others by their role name; none if none comes in time."""
        end = time.monotonic() + patience
        while True:
            found = [
                actor
                for actor in self._world.get_actors()
                if actor.type_id.startswith(("vehicle.", "walker."))
                and actor.attributes.get("role_name") == role
                and actor.is_alive
            ]
            if found or time.monotonic() >= end:
                return [self._described(actor) for actor in found]
            time.sleep(POLL)

    def borrow(self, actor_id: int) -> None:
        """Take an actor of somebody else, which gets its physics and its pedals back in the end."""
        actor = self._world.get_actor(actor_id)
        control = actor.get_control() if isinstance(actor, carla.Vehicle) else None

        def give_back() -> None:
            actor.set_simulate_physics(True)
            actor.set_target_angular_velocity(carla.Vector3D())
            if control is not None:
                actor.apply_control(control)

        self._undo.append(give_back)

    def _described(self, actor: Any) -> Mapping[str, Any]:
        found: dict[str, Any] = {"id": actor.id, "type": actor.type_id}
        if isinstance(actor, carla.Vehicle | carla.Walker) or actor.type_id.startswith("static."):
            self._watched.append(actor.id)
            box = actor.bounding_box
            found["box"] = [box.location.x, box.extent.x, box.extent.y, box.extent.z]
        if isinstance(actor, carla.Vehicle):  # asked before physics is switched off
            wheels = actor.get_physics_control().wheels
            found["wheels"] = [
                [wheel.position.x, wheel.position.y, wheel.max_steer_angle] for wheel in wheels
            ]
            curve = actor.get_physics_control().steering_curve
            found["steering_curve"] = [[point.x, point.y] for point in curve]
        return found

    def controlled(self, actors: Sequence[int]) -> bool:
        """Return whether somebody has all these vehicles move."""
        return all(
            actor.get_control().throttle > 0.0 or actor.get_velocity().length() > ROLLING
            for actor in self._world.get_actors(list(actors))
            if isinstance(actor, carla.Vehicle)
        )

    def nearby(self, x: float, y: float, radius: float) -> Sequence[Sequence[Any]]:
        """Return id, blueprint and role name of the actors within a radius (m)."""
        here = carla.Location(x, y, 0.0)
        found = []
        for actor in self._world.get_actors():
            at = actor.get_location()
            at.z = 0.0
            if at.distance(here) <= radius and actor.type_id.startswith(("vehicle.", "walker.")):
                found.append([actor.id, actor.type_id, actor.attributes.get("role_name", "")])
        return found

    def watch_collisions(self, actor: int) -> None:
        """Note the contacts of an actor from now on."""
        description = self._world.get_blueprint_library().find("sensor.other.collision")
        holder = self._world.get_actor(actor)
        sensor = self._world.spawn_actor(description, carla.Transform(), attach_to=holder)
        self._owns(sensor)
        sensor.listen(self._collisions.add)
        self._undo.append(sensor.stop)

    def enable_for_ros(self, sensor: int) -> None:
        """Have the server publish what a sensor sees, by its native ROS 2."""
        self._world.get_actor(sensor).enable_for_ros()

    def begin_autopilot(self, port: int, seed: int) -> int:
        """Start the Traffic Manager, in step with the world; return its port."""
        manager = self._client.get_trafficmanager(port)
        self._undo.append(manager.shut_down)
        manager.set_synchronous_mode(True)
        manager.set_random_device_seed(seed)
        return int(manager.get_port())

    # --- surroundings -------------------------------------------------------------------------

    def set_weather(self, values: Mapping[str, float]) -> None:
        """Change the weather; what is not named stays."""
        if self._weather is None:
            self._weather = self._world.get_weather()
            self._undo.append(lambda: self._world.set_weather(self._weather))
        weather = self._world.get_weather()
        for name, value in values.items():
            setattr(weather, name, value)
        self._world.set_weather(weather)

    def set_friction(self, friction: float | None) -> None:
        """Have all tyres hold so much everywhere; None: as they do by themselves."""
        for actor in self._world.get_actors(self._own).filter("static.trigger.friction"):
            actor.destroy()
            self._own.remove(actor.id)
        if friction is not None:
            far = str(1e6)  # cm
            extents = {f"extent_{axis}": far for axis in "xyz"}
            attributes = {"friction": str(friction), **extents}
            self.spawn("static.trigger.friction", attributes, [0.0] * 6)

    def traffic_lights(self) -> Sequence[str]:
        """Return the OpenDRIVE ids of the lights; `look` has their states from now on."""
        lights = self._world.get_actors().filter("traffic.traffic_light*")
        self._lights = {each.get_opendrive_id(): each for each in lights}
        return [name for name in self._lights if name]

    def set_light(self, name: str, state: str) -> None:
        """Have a traffic light show a state; batches have no command for that."""
        self._lights[name].set_state(carla.TrafficLightState.names[state])

    def freeze_lights(self) -> None:
        """Stop the cycles of all lights; in the end each is as it was."""
        lights = self._world.get_actors().filter("traffic.traffic_light*")
        before = [(light, light.state, light.is_frozen()) for light in lights]

        def thaw() -> None:
            for light, state, _ in before:
                light.set_state(state)
            if not all(frozen for *_, frozen in before):
                self._world.freeze_all_traffic_lights(False)

        self._undo.append(thaw)
        self._world.freeze_all_traffic_lights(True)

    def spectator(self) -> int:
        """Return the camera of the server's window, which is put back in the end."""
        camera = self._world.get_spectator()
        before = camera.get_transform()
        self._undo.append(lambda: camera.set_transform(before))
        return int(camera.id)

    # --- end ----------------------------------------------------------------------------------

    def close(self) -> None:
        """Undo what the session changed.

        A server that does not answer may come to itself again: this goes on until somebody ends
        the process, or the server is gone.
        """
        while self._undo:
            try:
                self._undo[-1]()
            except RuntimeError as error:  # else it cannot be undone
                if "time-out" in str(error):
                    if _listens(*self._address):
                        continue
                    return
            self._undo.pop()

    def _destroy(self) -> None:
        destroy = [carla.command.DestroyActor(each) for each in reversed(self._own)]
        self._client.apply_batch_sync(destroy, False)
        if self._ticks:
            self._world.tick(self._timeout)  # the batch would tick with the interpreter locked


def _listens(host: str, port: int) -> bool:
    """Return whether a port takes connections."""
    try:
        with socket.create_connection((host, port), timeout=LISTENS):
            return True
    except OSError:
        return False


def transform(pose: Sequence[float]) -> Any:
    """Return x, y, z, pitch, yaw, roll as the library has it."""
    x, y, z, pitch, yaw, roll = pose
    return carla.Transform(carla.Location(x, y, z), carla.Rotation(pitch, yaw, roll))


def written(pose: Any) -> list[float]:
    """Return a transform as numbers."""
    at, turn = pose.location, pose.rotation
    return [at.x, at.y, at.z, turn.pitch, turn.yaw, turn.roll]
