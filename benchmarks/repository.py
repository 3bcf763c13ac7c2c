"""A repository of scenarios as a team keeps it: bases, libraries, and what derives from them.

    python benchmarks/repository.py FOLDER [--scenarios 1000]

Writes `osc2tx.toml`, eight libraries in two folders of sources, and scenarios by topic, each with a
requirement, parameters in ranges, and moves of the libraries. The same number makes the same files.
"""

import argparse
from pathlib import Path

HEAD = """import osc.standard.all
{imports}
namespace null use std, stdtypes

"""

SETTINGS = """\
sources = ["scenarios", "shared"]
out = "generated"

[files."jam/**"]
ignore = ["OSC437"]
"""

IGNORED = """\
*.map.json
*.coverage.json
*.xosc.report.json
"""

LIBRARIES = {
    "shared/oem/fleet.osc": """\
# The vehicles of the project, with the sizes of the data sheet.
import osc.standard.all

namespace null use std, stdtypes

enum powertrain: [combustion, hybrid, electric]

# The car under test
actor test_car inherits vehicle:
    power: powertrain = electric
    keep(vehicle_category == car)

actor delivery_van inherits vehicle:
    power: powertrain = combustion
    keep(vehicle_category == car)

actor semi_trailer inherits vehicle:
    payload: mass = 12000kg
    keep(vehicle_category == truck)
""",
    "shared/oem/limits.osc": """\
# Bounds of comfort and of the drivetrain.
import osc.standard.all

namespace null use std, stdtypes

struct comfort_limits:
    acceleration: acceleration = 2.0mpss
    deceleration: acceleration = 3.0mpss
    lane_change: time = 4s
""",
    "scenarios/lib/about.osc": """\
# What a scenario is for: the requirement, who owns it, how urgent a failure is.
import osc.standard.all

namespace null use std, stdtypes

enum priority: [low, medium, high]
enum domain: [longitudinal, lateral, both_axes]

struct test_case:
    requirement: string = "none"
    owner: string = "nobody"
    priority: priority = medium
    domain: domain = both_axes
""",
    "scenarios/lib/weather.osc": """\
# Weather of the campaigns; the friction of the road follows from it.
import osc.standard.all

namespace null use std, stdtypes

scenario environment.clear_noon:
    do serial:
        actor.assign_celestial_position(light_source: actor.sun, azimuth: 180deg, elevation: 55deg)

scenario environment.low_sun:
    do serial:
        actor.assign_celestial_position(light_source: actor.sun, azimuth: 265deg, elevation: 8deg)

scenario environment.fog_patch:
    range: length = 120m
    do serial:
        actor.fog(visual_range: range)
""",
    "scenarios/lib/styles.osc": """\
# Styles of driving, as modifiers that bases and scenarios share.
import osc.standard.all

namespace null use std, stdtypes

struct style:
    pace: speed = 80kph
    room: length = 25m

modifier vehicle.brisk of vehicle.drive:
    acceleration([0.0mpss..3.0mpss])

modifier vehicle.calm of vehicle.drive:
    acceleration([0.0mpss..1.5mpss])
""",
    "scenarios/lib/moves.osc": """\
# Moves that many scenarios are made of.
import osc.standard.all

namespace null use std, stdtypes

# Leaves the lane to the left and keeps the pace
scenario vehicle.leave_left:
    pace: speed = 100kph
    hold: time = 3s
    do serial:
        actor.change_lane(num_of_lanes: 1, side: left)
        actor.drive(duration: hold) with:
            speed(pace)

# Takes the lane to the right and settles there
scenario vehicle.take_right:
    pace: speed = 95kph
    hold: time = 3s
    do serial:
        actor.change_lane(num_of_lanes: 1, side: right)
        actor.drive(duration: hold) with:
            speed(pace)

scenario vehicle.brake_to:
    target: speed = 40kph
    hold: time = 3s
    do serial:
        actor.change_speed(target: target, rate_profile: smooth)
        actor.drive(duration: hold) with:
            speed(target)
""",
    "scenarios/lib/highway_base.osc": """\
# The measured stretch of the highway, with the car under test in the middle lane.
import osc.standard.all
import oem.fleet
import lib.about
import lib.styles

namespace null use std, stdtypes

scenario measured_highway:
    about: test_case
    road: map with:
        keep(it.map_file == "highway.xodr")
    env: environment
    ego: test_car
    habit: style
    # Bounds of the speed for which the function is released
    v_ego: speed with:
        keep(it in [60kph..130kph])
    start: length = 200m

scenario three_lanes inherits measured_highway:
    other: vehicle
    v_other: speed with:
        keep(it in [50kph..140kph])

scenario with_truck inherits measured_highway:
    truck: semi_trailer
    v_truck: speed with:
        keep(it in [50kph..90kph])
""",
    "scenarios/lib/slow_base.osc": """\
# The same stretch at speeds of a traffic jam, and behind a van that delivers.
import osc.standard.all
import oem.fleet
import oem.limits
import lib.about

namespace null use std, stdtypes

scenario slow_traffic:
    about: test_case
    comfort: comfort_limits
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: test_car
    lead: vehicle
    v_ego: speed with:
        keep(it in [10kph..60kph])
    v_lead: speed with:
        keep(it in [5kph..60kph])

scenario behind_van:
    about: test_case
    road: map with:
        keep(it.map_file == "curve.xodr")
    ego: test_car
    van: delivery_van
    v_ego: speed with:
        keep(it in [20kph..70kph])
    v_van: speed with:
        keep(it in [20kph..60kph])
""",
}

ABOUT = """\
    keep(about.requirement == "{requirement}")
    keep(about.owner == "{owner}")
    keep(about.priority == priority!{priority})
"""

# Folder, kind -> imports, text. Four bases share the scenarios equally.
FAMILIES = {
    ("highway/cut_in", "cut_in"): (
        "import lib.about\nimport lib.highway_base\nimport lib.moves\n",
        """\
# A car from the left lane takes the lane of the ego vehicle with a gap of {gap} m.
scenario {name} inherits three_lanes:
{about}    keep(v_ego == {ego}kph)
    keep(v_other in [{low}kph..{high}kph])
    gap: length = {gap}m

    do parallel:
        ego.drive() with:
            lane(2, at: start)
            position({start}m, at: start)
            speed(v_ego)
        serial:
            overtake: other.drive() with:
                lane(side_of: ego, side: left, at: start)
                position({behind}m, behind: ego, at: start)
                speed(v_other)
                until rise(other.space_gap(reference: ego, direction: longitudinal) > gap)
            other.take_right(pace: v_ego, hold: {hold}s)
""",
    ),
    ("highway/braking", "brake"): (
        "import lib.about\nimport lib.highway_base\nimport lib.moves\nimport lib.weather\n",
        """\
# The car ahead brakes to {target} km/h under a low sun; the ego vehicle keeps {hold} s.
scenario {name} inherits three_lanes:
{about}    keep(v_ego == {ego}kph)
    keep(v_other == v_ego)

    do parallel(duration: {duration}s):
        env.low_sun()
        serial:
            other.drive(duration: 2s) with:
                lane(2, at: start)
                position({start}m, at: start)
                speed(v_other)
            other.brake_to(target: {target}kph, hold: {hold}s)
            other.drive() with:
                speed({target}kph)
        ego.drive() with:
            lane(same_as: other, at: start)
            position({behind}m, behind: other, at: start)
            speed(v_ego)
""",
    ),
    ("highway/trucks", "truck"): (
        "import lib.about\nimport lib.highway_base\nimport lib.moves\nimport oem.fleet\n",
        """\
# The ego vehicle passes a truck in the right lane, at {gap} m.
scenario {name} inherits with_truck:
{about}    keep(v_ego in [{low}kph..{high}kph])
    keep(v_truck == {target}kph)
    event is_close is rise(truck.space_gap(reference: ego, direction: longitudinal) < {gap}m)

    do parallel:
        truck.drive() with:
            lane(2, at: start)
            position({ahead}m, at: start)
            speed(v_truck)
        serial:
            approach: ego.drive() with:
                lane(same_as: truck, at: start)
                position({behind}m, behind: truck, at: start)
                speed(v_ego)
                until @is_close
            ego.leave_left(pace: v_ego, hold: {hold}s)
            ego.drive(duration: {duration}s) with:
                speed(v_ego)
""",
    ),
    ("jam/queue", "queue"): (
        "import lib.about\nimport lib.slow_base\nimport lib.moves\n",
        """\
# Stop and go: the lead vehicle halts {hold} s, and the ego vehicle closes up to {gap} m.
scenario {name} inherits slow_traffic:
{about}    keep(v_lead == {slow}kph)
    keep(v_ego == v_lead + 5kph)

    do parallel(duration: {duration}s):
        serial:
            lead.drive(duration: 3s) with:
                lane(1, at: start)
                position({start}m, at: start)
                speed(v_lead)
            lead.brake_to(target: 5kph, hold: {hold}s)
            lead.change_speed(target: v_lead, rate_profile: smooth)
            lead.drive() with:
                speed(v_lead)
        serial:
            ego.drive() with:
                lane(same_as: lead, at: start)
                position({behind}m, behind: lead, at: start)
                speed(v_ego)
                until fall(ego.space_gap(reference: lead, direction: longitudinal) > {gap}m)
            ego.drive() with:
                speed(5kph)
""",
    ),
}
OWNERS = ("planning", "perception", "control", "safety")
PRIORITIES = ("low", "medium", "high")


def make_repository(folder: Path, scenarios: int) -> None:
    """Write the repository."""
    _write(folder / "osc2tx.toml", SETTINGS)
    _write(folder / ".gitignore", IGNORED)
    for name, text in LIBRARIES.items():
        _write(folder / name, text)
    families = list(FAMILIES.items())
    for number in range(scenarios):
        (place, kind), (imports, text) = families[number % len(families)]
        n = number // len(families)
        name = f"{kind}_{n:04}"
        about = ABOUT.format(
            requirement=f"REQ-{kind.upper()}-{n // 5:03}",
            owner=OWNERS[n % len(OWNERS)],
            priority=PRIORITIES[n % len(PRIORITIES)],
        )
        values = {
            "ego": 70 + n % 30,
            "low": 100 + n % 9,
            "high": 112 + n % 14,
            "gap": 8 + n % 9,
            "start": 150 + n % 60,
            "ahead": 260 + n % 60,
            "behind": 30 + n % 15,
            "hold": 2 + n % 4,
            "target": 55 + n % 30,
            "slow": 20 + n % 20,
            "duration": 12 + n % 6,
        }
        body = text.format(name=name, about=about, **values)
        _write(folder / f"scenarios/{place}/{name}.osc", HEAD.format(imports=imports) + body)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")


def main() -> None:
    """Write the repository that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--scenarios", type=int, default=1000)
    arguments = parser.parse_args()
    make_repository(arguments.folder, arguments.scenarios)


if __name__ == "__main__":
    main()
