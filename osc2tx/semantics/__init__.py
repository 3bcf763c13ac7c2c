"""Semantic analysis: from syntax trees to a checked program.

Input: an `ast.File`, and a callable that loads the files it imports. Output: a `SemanticModel`
(`model`, over `symbols` and `types`) and diagnostics OSC2xx - OSC4xx, and OSC6xx for relaxations of
a dialect. `dump` prints a model.

Order of events, with the modules that do the work; `builder` runs them:

1. Imports (`imports`): files in their order, and the required parts of the library. `library`
   builds those once per process, with the `prelude` of the dialect (`dialects`); programs are
   layered on them (`scope`). A program with extensions gets its own copy of the library.
2. Definition pass (`collect`, `members`): a symbol for each declaration.
3. Resolution pass, first half (`resolve`): exports (`exports`), actors and bases (`resolve_types`,
   `inheritance`), physical types and units (`physical`), extensions (`extensions`), enum values
   (`enums`), signatures.
4. Resolution pass, second half (`check`): bodies. Statements: `behaviors`, `modifiers`, `events`,
   `constraints`, `inheritance_conditions`, `coverage` (with `coverage_items`).
   Expressions: the package `expressions`. Arguments: `binding`.
   Names: `member_lookup`, `builtins`, `unknown_names`. Types: `assignability`, `conversions`. All
   share a `Resolution` (`resolution`) and get the position of the text as an `Environment`.

`units` converts authored values to SI, for the next stage.

Invariants: no input raises; each mistake is reported once, its consequences have the error type and
are not reported; every expression of the user's files has a type; a shared library is never changed
after it is built.
"""

from osc2tx.semantics.builder import ModelBuilder
from osc2tx.semantics.dialects import ASAM, CARLA, DIALECTS, Dialect
from osc2tx.semantics.model import Binding, SemanticModel
from osc2tx.semantics.units import to_si

__all__ = [
    "ASAM",
    "CARLA",
    "DIALECTS",
    "Binding",
    "Dialect",
    "ModelBuilder",
    "SemanticModel",
    "to_si",
]
