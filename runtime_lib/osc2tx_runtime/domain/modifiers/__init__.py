"""Modifiers: how an action is to be carried out, where an actor starts, what roads are like.

Each is a small value with the parameters of the DSL in their order. Numbers are SI floats, or
functions that are called when the action starts. Each registers itself in `registry` by its name in
the DSL; `osc2tx_runtime.modifiers` has them by these names, as scenarios import them.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

from .base import Modifier as Modifier
from .base import MovementModifier as MovementModifier
from .base import Value as Value
from .base import value_of as value_of
from .conduct import *  # noqa: F403
from .lane import *  # noqa: F403
from .map_base import MapModifier as MapModifier
from .map_crossings import *  # noqa: F403
from .map_files import *  # noqa: F403
from .map_lanes import *  # noqa: F403
from .map_routes import *  # noqa: F403
from .orientation import *  # noqa: F403
from .position import *  # noqa: F403
from .registry import MODIFIERS as MODIFIERS
from .speed import *  # noqa: F403

for _module in iter_modules(__path__):  # noqa: F405 (they register their modifiers)
    import_module(f"{__name__}.{_module.name}")
