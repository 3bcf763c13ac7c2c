"""The modifiers by the names of the standard, as generated modules import them."""

from osc2tx_runtime.domain.modifiers import *  # noqa: F403
from osc2tx_runtime.domain.modifiers import __all__ as __all__
