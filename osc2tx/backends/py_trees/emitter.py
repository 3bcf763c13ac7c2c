"""IR module in, text of the Python module and its source map out."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import PurePosixPath

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyDocLine, PyName
from osc2tx.backends.py_trees.environment import environment
from osc2tx.backends.py_trees.formatting import format_module
from osc2tx.backends.py_trees.naming import NameTable, class_name, identifier
from osc2tx.backends.py_trees.own_types import write_types
from osc2tx.backends.py_trees.runtime_api import (
    ACTOR_CLASSES,
    API_LEVEL,
    PHYSICAL_TYPES,
    STRUCT_CLASSES,
)
from osc2tx.backends.py_trees.scenarios import ScenarioWriter
from osc2tx.backends.py_trees.source_map import render_source_map
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.type_table import TypeTable, class_key
from osc2tx.backends.py_trees.user_actions import write_actions
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import ModuleView
from osc2tx.catalogue import object_tables
from osc2tx.support.portable_names import is_portable

# Names a module may import; a scenario class must not hide them.
RUNTIME_CLASSES = frozenset(
    {*ACTOR_CLASSES.values(), *STRUCT_CLASSES.values(), *PHYSICAL_TYPES.values()}
    | {
        "Actor",
        "Behaviour",
        "Call",
        "Duration",
        "Emit",
        "End",
        "Event",
        "Fail",
        "Late",
        "Modifier",
        "On",
        "OneOf",
        "OwnShape",
        "Parallel",
        "Range",
        "Rgb",
    }
    | {"Any", "Protocol", "Scenario", "Serial", "Unit", "Until", "Wait"}
)

ONE_OF_POLICIES = {
    "race": "`one_of` is a race",
    "first": "`one_of` takes its first member",
    "seeded": "`one_of` chooses by the seed",
}


@dataclass(frozen=True, slots=True)
class GeneratedModule:
    """What the backend makes of one source file.

    Attributes:
        stem: File name of the module without `.py`.
        python: Text of the module.
        source_map: Text of the sidecar map, JSON.
    """

    stem: str
    python: str
    source_map: str


def emit(module: ir.Module) -> GeneratedModule:
    """Write the module for one source file with at least one scenario."""
    written = draft(module)
    return replace(written, python=format_module(written.python))


def draft(module: ir.Module) -> GeneratedModule:
    """Write a module in the layout of the templates: it does the same, but is not for readers."""
    uses = Uses()
    classes = NameTable(RUNTIME_CLASSES | object_tables().enums)
    for scenario in module.scenarios:
        plain = scenario.name.rpartition(".")[2]
        classes.add(scenario.key, class_name(plain), "Scenario")
    for own in module.types:
        classes.add(class_key(own.name), class_name(own.name), "Type")
    table = TypeTable(module.types, classes, uses)
    type_methods = TypeMethods(module.types, module.scenarios)
    types = write_types(module.types, table, type_methods, uses)
    actions = write_actions(module.actions, classes, table, uses)
    writers = [
        ScenarioWriter(scenario, module.one_of, classes, table, type_methods, uses)
        for scenario in module.scenarios
    ]
    scenarios = tuple(writer.write() for writer in writers)
    view = ModuleView(
        docstring=_docstring(module),
        imports=uses.imports(),
        api_level=API_LEVEL,
        units=uses.units(),
        enums=uses.enums(),
        scenarios=scenarios,
        mains=tuple(classes[scenario.key] for scenario in own_scenarios(module)),
        shown=classes[shown_scenario(module).key],
        standard_imports=uses.standard_imports(),
        types=types,
        actions=actions,
    )
    text = environment().get_template("module.py.j2").render(module=view)
    maps = {s.name: w.source_map for s, w in zip(module.scenarios, writers, strict=True)}
    return GeneratedModule(module_stem(module.source), text, render_source_map(maps))


def module_stem(source: str) -> str:
    """Return the module name for a source file: importable, as close to its name as can be."""
    stem = identifier(PurePosixPath(source).stem)
    return PyName(stem if is_portable(stem) else f"{stem}_").text


def own_scenarios(module: ir.Module) -> list[ir.Scenario]:
    """Return the scenarios of the file itself, without imported ones."""
    return [scenario for scenario in module.scenarios if not scenario.is_imported]


def shown_scenario(module: ir.Module) -> ir.Scenario:
    """Return the scenario whose tree viewers get: `top`, `main`, else the last that can run."""
    own = own_scenarios(module)
    by_name = {scenario.name: scenario for scenario in own}
    wanted = next((name for name in ("top", "main") if name in by_name), None)
    if wanted:
        return by_name[wanted]
    able = [scenario for scenario in own if not any(map(_is_given, scenario.declarations))]
    return (able or own)[-1]


def _is_given(declaration: ir.Declaration) -> bool:
    """Whether only an invoker can say what an object is."""
    return isinstance(declaration, ir.Actor) and declaration.is_given


def _docstring(module: ir.Module) -> tuple[PyDocLine, ...]:
    own = own_scenarios(module)
    names = ", ".join(f"`{scenario.name}`" for scenario in own)
    word = "Scenario" if len(own) == 1 else "Scenarios"
    about = ("", *module.comments) if module.comments else ()
    lines = (
        f"{word} {names}.",
        *about,
        "",
        f"Made by osc2tx from {module.source}: edit the scenario, not this module.",
        f"OpenSCENARIO DSL {module.standard}, dialect {module.dialect}; "
        f"{ONE_OF_POLICIES[module.one_of]}.",
    )
    return tuple(PyDocLine.of(line) for line in lines)
