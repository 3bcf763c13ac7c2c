"""Modifiers: constraints on the execution of actions, on the start of actors, and on roads.

Each is a small value with the parameters of the DSL in their order. Numbers are SI floats, or
functions that are called when the action starts. Each registers itself in `registry` by its name in
the DSL; `osc2tx_runtime.modifiers` has them by these names, as scenarios import them.
"""

from __future__ import annotations

from osc2tx_runtime.domain.modifiers.map.base import MapModifier as MapModifier
from osc2tx_runtime.domain.modifiers.map.crossings import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.map.files import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.map.lanes import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.map.routes import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.movement.conduct import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.movement.lane import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.movement.orientation import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.movement.position import *  # noqa: F403
from osc2tx_runtime.domain.modifiers.movement.speed import *  # noqa: F403
from osc2tx_shared.registering import import_all

from .base import Modifier as Modifier
from .base import MovementModifier as MovementModifier
from .base import Value as Value
from .base import value_of as value_of
from .registry import MODIFIERS as MODIFIERS

import_all(__name__, __path__)  # noqa: F405 (they register)
