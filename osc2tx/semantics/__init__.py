"""Semantic analysis: from syntax trees to a checked program.

Input: an `ast.File`, and a callable that loads imported files. Output: a `SemanticModel` and
diagnostics OSC2xx - OSC4xx, and OSC6xx for what a dialect lets pass.
"""

from osc2tx.semantics.builder import ModelBuilder
from osc2tx.semantics.dialects import ASAM, CARLA, DIALECTS, Dialect
from osc2tx.semantics.dump import dump_model
from osc2tx.semantics.model import Binding, SemanticModel

__all__ = [
    "ASAM",
    "CARLA",
    "DIALECTS",
    "Binding",
    "Dialect",
    "ModelBuilder",
    "SemanticModel",
    "dump_model",
]
