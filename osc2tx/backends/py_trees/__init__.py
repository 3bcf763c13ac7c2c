"""Backend for py_trees: IR in, readable Python modules out.

`support` rejects constructs that the runtime does not have; `emitter` is the entry for the rest.
`sharing` decides which classes come from the modules of imported files, `own_names` names the
others. `scenarios`, `behaviors`, `calls` and `expressions` turn the IR into the view models of
`view`, with names from `naming` and fragments from `code`, which escape scenario text;
`uses` collects imports, `runtime_api` has the facts about the runtime. The templates only place
view models, in black's `layout`; where black may differ, `formatting` calls it. `source_map` holds
the lines that the module does not cite itself.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx.backends.py_trees.support import check_support

if TYPE_CHECKING:
    from osc2tx import ir
    from osc2tx.backends.py_trees.emitter import GeneratedModule
    from osc2tx.backends.py_trees.sharing import Sharing

__all__ = ["check_support", "emit"]


def emit(
    module: ir.Module, sharing: Sharing | None = None, *, is_formatted: bool = True
) -> GeneratedModule:
    """Write the module for one source file.

    The writers are loaded when something is written: checking a file does not need them.

    Args:
        module: Its IR.
        sharing: Where it has the classes of imported files from; all are copies if left out.
        is_formatted: Whether people will read it; a module that is only executed needs no style.
    """
    from osc2tx.backends.py_trees.emitter import emit as emit_module

    return emit_module(module, sharing, is_formatted=is_formatted)
