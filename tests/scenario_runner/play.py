"""Run by ScenarioRunner's Python: plays a document as its command line does, and says what happens.

`play.py CHECKOUT PORT FILE.xosc`: a line of JSON for the start and the end of each event, as its
tree notes them, one for each actor and step, with its place in the coordinates of OpenDRIVE, and
one for the end of the run. Ends with exit code 0 if the tree came to its end.
"""

import json
import sys

checkout, port, path = sys.argv[1:4]
sys.path.insert(0, checkout)

import carla
import py_trees
import scenario_runner
from srunner.scenariomanager.carla_data_provider import CarlaDataProvider
from srunner.scenariomanager.scenario_manager import ScenarioManager
from srunner.scenariomanager.timer import GameTime

EVENT = "(EVENT)"
told = {}


def tell(*said: object) -> None:
    """Print what happened, the time first."""
    print(json.dumps(said), flush=True)


class TellingManager(ScenarioManager):
    """Looks after each tick at what the tree has noted on its blackboard."""

    def _tick_scenario(self, timestamp):
        super()._tick_scenario(timestamp)
        for actor in CarlaDataProvider.get_all_actors():
            name, place = actor.attributes.get("role_name"), CarlaDataProvider.get_location(actor)
            if name and place is not None:
                tell(GameTime.get_time(), "AT", name, place.x, -place.y)
        for key, time in vars(py_trees.blackboard.Blackboard()).items():
            if key.startswith(EVENT) and key not in told:
                told[key] = time
                name, _, what = key.removeprefix(EVENT).rpartition("-")
                tell(time, what, name)
        if not self._running and self.scenario_tree.status == py_trees.common.Status.SUCCESS:
            told["end"] = GameTime.get_time()
            tell(told["end"], "END", "")


scenario_runner.ScenarioManager = TellingManager
# It drives nobody here, and a step that waits for its own may wait forever.
carla.TrafficManager.set_synchronous_mode = lambda manager, is_synchronous: None
sys.argv = ["scenario_runner.py", "--openscenario", path, "--sync", "--port", port]
scenario_runner.main()
sys.stdout.flush()
sys.exit(0 if "end" in told else 1)
