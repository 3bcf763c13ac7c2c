"""What a compilation makes, as files and as text for people."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from osc2tx.options import ProductName
from osc2tx.support.light_dataclass import dataclass
from osc2tx.support.output_names import LOSS_REPORT, MODULE, PARAMETERS, SOURCE_MAP, XML
from osc2tx.syntax import dump_ast

if TYPE_CHECKING:
    from osc2tx.backends.py_trees.emitter import GeneratedModule
    from osc2tx.backends.xosc.emitter import XmlScenario
    from osc2tx.compilation.driver import Compilation


@dataclass(frozen=True, slots=True)
class Output:
    """A file that a source makes: `stem` of its compilation, then `suffix`, holds `text`."""

    suffix: str
    text: str


def files_of_module(module: GeneratedModule) -> tuple[Output, ...]:
    """Return the Python module and its source map."""
    return Output(MODULE, module.python), Output(SOURCE_MAP, module.source_map)


def files_of_xml(scenarios: Sequence[XmlScenario]) -> tuple[Output, ...]:
    """Return scenarios as OpenSCENARIO XML, each with what goes with it."""
    return tuple(
        Output(f"{scenario.infix}{suffix}", text)
        for scenario in scenarios
        for suffix, text in (
            (XML, scenario.xml),
            (PARAMETERS, scenario.parameters),
            (LOSS_REPORT, scenario.report_json),
        )
        if text is not None
    )


def _dump_ast(compilation: Compilation) -> str | None:
    return None if compilation.ast is None else dump_ast(compilation.ast)


def _dump_model(compilation: Compilation) -> str | None:
    from osc2tx.semantics import dump_model

    return None if compilation.model is None else dump_model(compilation.model)


def _dump_ir(compilation: Compilation) -> str | None:
    from osc2tx.ir import dump_ir

    return None if compilation.ir is None else dump_ir(compilation.ir)


def _dump_module(compilation: Compilation) -> str | None:
    return None if compilation.module is None else compilation.module.python


def _dump_xml(compilation: Compilation) -> str | None:
    written = [scenario.xml for scenario in compilation.xml if scenario.xml is not None]
    return "\n".join(written) if written else None


DUMPS: Mapping[ProductName, Callable[[Compilation], str | None]] = {
    "ast": _dump_ast,
    "model": _dump_model,
    "ir": _dump_ir,
    "py": _dump_module,
    "xosc": _dump_xml,
}
"""How products are printed (`--emit`); `None` where one does not exist."""
