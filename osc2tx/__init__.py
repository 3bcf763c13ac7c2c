"""osc2tx: compiles OpenSCENARIO DSL 2.1/2.2 into readable py_trees modules.

`compile_file` and `compile_text` are the compiler as a library, `check_text` and `apply_fixes`
check and correct a text; `osc2tx.testing` helps test scenarios with pytest.
"""

from __future__ import annotations

from osc2tx.version import __version__

# As in `typing`, which takes longer to load than all else here; Ctrl-C is not quiet before `start`.
TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import Any

    from osc2tx.api import (
        CheckResult,
        CompileResult,
        apply_fixes,
        check_text,
        compile_file,
        compile_text,
    )
    from osc2tx.diagnostics import Diagnostic

__all__ = [
    "CheckResult",
    "CompileResult",
    "Diagnostic",
    "__version__",
    "apply_fixes",
    "check_text",
    "compile_file",
    "compile_text",
]

# Loaded on demand: the command line starts without them.
_HOMES = {
    "CheckResult": "osc2tx.api",
    "CompileResult": "osc2tx.api",
    "Diagnostic": "osc2tx.diagnostics",
    "apply_fixes": "osc2tx.api",
    "check_text": "osc2tx.api",
    "compile_file": "osc2tx.api",
    "compile_text": "osc2tx.api",
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
