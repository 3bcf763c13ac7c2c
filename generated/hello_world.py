"""Scenario `hello_world`.

Made by osc2tx from hello_world.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect carla; `one_of` is a race.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Environment,
    Event,
    Map,
    OneOf,
    Parallel,
    Rgb,
    Scenario,
    Serial,
    StationaryObject,
    Vehicle,
    Wait,
    elapsed,
    fall,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import deg, kph, m, mph, rad, s

require_api(1)


class HelloWorld(Scenario):
    name = "hello_world"
    source = "hello_world.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        # --- DEFINITIONS ---
        self.carla_map = self.cast("carla_map", Map(map_file="Town06"))

        self.env = self.cast("env", Environment())

        self.hero = self.cast("hero", Vehicle(model="vehicle.tesla.model3", name="hero"))

        self.npc = self.cast(
            "npc",
            Vehicle(model="vehicle.carlamotors.european_hgv", name="npc", color=Rgb("0,128,0")),
        )

        self.obstacle = self.cast(
            "obstacle", StationaryObject(name="obstacle", model="static.prop.trafficwarning")
        )

        # --- GLOBAL VARIABLES ---
        self.v_hero = 35 * kph
        self.v_npc_fast = self.v_hero + 12.42 * mph
        self.v_npc_slow = self.v_hero - 10 * kph
        self.v_npc_catchup = self.v_hero * (10 * kph)

        self.lag = 5 * m
        self.gap = self.lag * 3
        self.safety_gap = self.gap - 3 * m

        # Events that the scenario uses without declaring them
        self.go_signal = Event()
        self.CRASH_AVOIDED = Event()
        self.OBSTACLE_DETECTED = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.hero, lane(1, from_="left"), speed(0 * kph))
        self.place(
            self.npc,
            lane(side="right", side_of=self.hero),
            position(distance=self.lag, behind=self.hero),
            speed(0 * kph),
        )
        self.place(self.obstacle, position(x=478.93, y=-14.07, z=0.0, h=-1.57 * rad, frame="carla"))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self._env_then_hero(),
            self._hero_and_npc(),
        )

    def _env_then_hero(self) -> Behaviour:
        return Serial(
            "do serial",
            # --- TWILIGHT SETTINGS ---
            self.env.assign_celestial_position(azimuth=270 * deg, elevation=12 * deg),
            self.hero.set_lights(mode="auto"),
        )

    def _hero_and_npc(self) -> Behaviour:
        return Parallel(
            "do parallel",
            self._hero_drive_then_change_lane(),
            self._npc_drive_then_change_lane(),
        )

    def _hero_drive_then_change_lane(self) -> Behaviour:
        """HERO LOGIC."""
        return Serial(
            "hero: serial",
            Wait(self.go_signal),
            # --- Phase 1: Cruise ---
            OneOf(
                "hero: drive or wait npc ahead_of",
                self.hero.drive(speed(self.v_hero)),
                Wait(fall(lambda: self.npc.position.ahead_of(self.hero) > self.safety_gap)),
            ),
            # --- Phase 2: Hazard Detected - Flash High Beams & Swerve ---
            Parallel(
                "hero: change_lane with set_lights",
                # Task A: The evasive physical maneuver
                Serial(
                    "hero: change_lane, emit CRASH_AVOIDED",
                    self.hero.change_lane(num_of_lanes=1, side="right"),
                    Emit(self.CRASH_AVOIDED),
                ),
                # Task B: The visual "Flash" effect
                Serial(
                    "hero: set_lights, wait",
                    self.hero.set_lights(mode="high_beam"),
                    Wait(elapsed(0.5 * s)),
                    self.hero.set_lights(mode="auto"),
                ),
            ),
            # --- Phase 3: Approach & Synchronize ---
            OneOf(
                "hero: drive or wait OBSTACLE_DETECTED",
                self.hero.drive(speed(self.v_hero)),
                Wait(self.OBSTACLE_DETECTED),
            ),
            # --- Phase 4: Approach NPC smoothly and pull alongside ---
            Serial(
                "hero: change_speed, drive",
                self.hero.change_speed(target=25 * kph, rate_profile="smooth"),
                OneOf(
                    "hero: drive or wait hero ahead_of",
                    self.hero.drive(speed(25 * kph)),
                    Serial(
                        "wait hero ahead_of",
                        Wait(rise(lambda: self.hero.position.ahead_of(self.npc) >= -1 * m)),
                    ),
                ),
            ),
            # --- Phase 5: Final Stop ---
            self.hero.change_speed(target=0 * kph, rate_profile="asap"),
            Wait(lambda: self.hero.speed < 0.1 * kph),
            Wait(elapsed(5 * s)),
        )

    def _npc_drive_then_change_lane(self) -> Behaviour:
        """NPC LOGIC."""
        return Serial(
            "npc: serial",
            Wait(self.go_signal),
            # --- Phase 1: Accelerate UNTIL ahead of Hero ---
            OneOf(
                "npc: drive or wait npc ahead_of",
                self.npc.drive(speed(self.v_npc_fast)),
                Serial(
                    "wait npc ahead_of",
                    Wait(rise(lambda: self.npc.position.ahead_of(self.hero) >= self.lag * 2)),
                ),
            ),
            # --- Phase 2: Cut In ---
            self.npc.change_lane(num_of_lanes=1, side="left"),
            # --- Phase 3: Brake Check UNTIL Ego swerves ---
            OneOf(
                "npc: drive or wait CRASH_AVOIDED",
                self.npc.drive(speed(self.v_npc_slow)),
                Wait(self.CRASH_AVOIDED),
            ),
            # --- Phase 4: Recover & Approach Obstacle ---
            OneOf(
                "npc: drive or wait npc object_distance",
                self.npc.drive(speed(self.v_npc_catchup, rate_profile="smooth")),
                Serial(
                    "wait npc object_distance",
                    Wait(
                        rise(
                            lambda: self.npc.object_distance(
                                reference=self.obstacle, direction="euclidean"
                            )
                            < 45 * m
                        )
                    ),
                ),
            ),
            # --- Phase 5: Emergency Stop & Emit Event ---
            self.npc.change_speed(target=0 * kph, rate_profile="asap"),
            Emit(self.OBSTACLE_DETECTED),
            # Phase 6: Parked
            Wait(elapsed(100 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return HelloWorld().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(HelloWorld))
