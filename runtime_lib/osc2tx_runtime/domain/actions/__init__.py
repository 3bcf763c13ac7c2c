"""The actions of the domain model; importing this package registers them.

`movement` has the actions that move an actor, `lights` those for vehicle lights and traffic
lights, `environment` those for weather and light. An action reads the snapshot when it starts,
gives the world one command per slot (`planning` computes it from the modifiers), and ends when the
world reports that the goal is reached.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import walk_packages

for _module in walk_packages(__path__, f"{__name__}."):  # they register their actions
    import_module(_module.name)
