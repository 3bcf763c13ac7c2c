"""IR module in, text of the Python module and its source map out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeVar

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyComment, PyDocLine, PyExpr, PyName, literal
from osc2tx.backends.py_trees.comments import beside
from osc2tx.backends.py_trees.coverage import render_coverage_model
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.formatting import format_module
from osc2tx.backends.py_trees.layout import environment
from osc2tx.backends.py_trees.members import members_of
from osc2tx.backends.py_trees.modifier_calls import ModifierCalls, never_called
from osc2tx.backends.py_trees.modifier_functions import write_modifiers
from osc2tx.backends.py_trees.naming import NameTable, identifier, module_name
from osc2tx.backends.py_trees.own_names import (
    Declared,
    add_name,
    declarations,
    is_own,
    key_of,
    own_names,
)
from osc2tx.backends.py_trees.own_types import write_types
from osc2tx.backends.py_trees.runtime_api import API_LEVEL
from osc2tx.backends.py_trees.scenarios import ScenarioWriter, is_first_come
from osc2tx.backends.py_trees.sharing import Sharing, sibling_imports
from osc2tx.backends.py_trees.source_map import render_source_map
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.user_actions import write_actions
from osc2tx.backends.py_trees.uses import LIBRARY, Uses
from osc2tx.backends.py_trees.view import (
    EnumMemberView,
    EnumView,
    ModuleView,
    ScenarioView,
    TypeView,
    UnitView,
    UserActionView,
    UserModifierView,
)
from osc2tx_shared.classes import dataclass, replace

DefinitionT = TypeVar("DefinitionT", TypeView, UserActionView, UserModifierView, ScenarioView)

ONE_OF_POLICIES = {
    "race": "`one_of` is a race",
    "first": "`one_of` takes its first member",
    "seeded": "`one_of` chooses by the seed",
}


@dataclass(frozen=True, slots=True)
class GeneratedModule:
    """The outputs of the backend for one source file.

    Attributes:
        source: Name of the source.
        stem: File name of the module without `.py`.
        python: Text of the module.
        source_map: Text of the sidecar map, JSON.
        coverage_model: Text of the coverage model, JSON; None if its scenarios sample nothing.
    """

    source: str
    stem: str
    python: str
    source_map: str
    coverage_model: str | None = None


NAMES_OF_MAIN = ("top", "main")


def emit(
    module: ir.Module, sharing: Sharing | None = None, *, is_formatted: bool = True
) -> GeneratedModule:
    """Write the module for one source file.

    Args:
        module: Its IR.
        sharing: Where it has the classes of imported files from; all are copies if left out.
        is_formatted: Whether people will read it; a module that is only executed needs no style.
    """
    sharing = sharing or Sharing()
    names = _all_names(module, sharing)
    uses = Uses(names)
    defined = [each for each in declarations(module) if key_of(each) not in sharing.homes]
    types = [each for each in defined if isinstance(each, ir.UserType)]
    actions = [each for each in defined if isinstance(each, ir.UserAction)]
    scenarios = [each for each in defined if isinstance(each, ir.AbstractScenario)]
    table = TypeTable(module.types, names, uses, sharing.homes.keys())
    enums = [each for each in defined if isinstance(each, ir.UserEnum)]
    for enum in enums:  # those that nothing here uses as well: others may
        table.annotation(ir.ValueType(ir.Kind.ENUM, enum.name, members=enum.members))
    every = (*module.bases, *module.scenarios)
    type_methods = TypeMethods(module.types, every)
    type_views = write_types(types, table, type_methods, uses)
    plain = ExpressionWriter(NameTable(), uses.unit, uses.name)
    action_views = write_actions(actions, names, table, uses, plain.write)
    unwritten = never_called(module)
    modifiers = [
        each for each in defined if isinstance(each, ir.UserModifier) and each.key not in unwritten
    ]
    functions = ModifierCalls(module.modifiers, names)
    modifier_views = write_modifiers(modifiers, functions, names, table, type_methods, uses)
    complete = [each for each in scenarios if isinstance(each, ir.Scenario)]
    main = main_scenario(module) if len(complete) > 1 else None
    members = members_of(module, type_methods)
    writers = [
        ScenarioWriter(
            scenario,
            members,
            module.one_of,
            is_first_come(module),
            scenario is main,
            names,
            table,
            type_methods,
            functions,
            uses,
            module.actions,
        )
        for scenario in scenarios
    ]
    scenario_views = [writer.write() for writer in writers]
    siblings, shown = sibling_imports(sharing, names), shown_scenario(module)
    if any(view.methods for view in scenario_views) or shown is not None:
        uses.name("Behaviour")
    if any(not view.is_derived for view in scenario_views):
        uses.name("Scenario")
    if shown is not None:
        uses.name("main")
    view = ModuleView(
        docstring=_docstring(module),
        library=PyName(LIBRARY) if uses.needs_library else None,
        imports=uses.imports(),
        siblings=siblings,
        root=_root(module) if siblings else None,
        api_level=API_LEVEL,
        units=_comments_of_units(uses.units(), module),
        enums=_explained_enums(uses.enums(), names, sharing, module),
        scenarios=_explained(scenario_views, scenarios, sharing),
        mains=tuple(names[scenario.key] for scenario in module.own_scenarios),
        shown=None if shown is None else names[shown.key],
        standard_imports=uses.standard_imports(),
        types=_explained(type_views, types, sharing),
        actions=_explained(action_views, actions, sharing),
        modifiers=_explained(modifier_views, modifiers, sharing),
    )
    text = environment().get_template("module.py.j2").render(module=view)
    maps = {s.name: w.source_map for s, w in zip(scenarios, writers, strict=True)}
    stem = module_name(module.source)
    model = render_coverage_model(module.source, complete)
    python = format_module(text) if is_formatted else text
    return GeneratedModule(module.source, stem, python, render_source_map(maps), model)


def _all_names(module: ir.Module, sharing: Sharing) -> NameTable:
    """Name the definitions and imports of a module; those of its own file are named first."""
    names = own_names(module)
    for key, home in sharing.homes.items():
        names.add(key, home.name)
    for declared in declarations(module):
        if key_of(declared) not in names:
            add_name(names, declared)
    return names


def _explained(
    views: Sequence[DefinitionT], parts: Sequence[Declared], sharing: Sharing
) -> tuple[DefinitionT, ...]:
    """Return views; those of copies state why they are copied."""
    reasons = (sharing.copies.get(key_of(part)) for part in parts)
    return tuple(
        view if reason is None else replace(view, copied=PyComment.of(reason))
        for view, reason in zip(views, reasons, strict=True)
    )


def _explained_enums(
    views: Sequence[EnumView], names: NameTable, sharing: Sharing, module: ir.Module
) -> tuple[EnumView, ...]:
    """Return the same of enums: a module also defines those of the library that it extends."""
    reasons = {names[key]: PyComment.of(reason) for key, reason in sharing.copies.items()}
    declared = {names[key_of(each)]: each for each in module.enums if key_of(each) in names}
    return tuple(
        replace(_comments_of_enum(view, declared.get(view.name)), copied=reasons.get(view.name))
        for view in views
    )


def _comments_of_enum(view: EnumView, declared: ir.UserEnum | None) -> EnumView:
    """Return an enum with the comments of its declaration."""
    if declared is None:
        return view
    told = dict(declared.told)
    members = tuple(
        EnumMemberView(literal(each), **beside(told.get(each, ()), f"    {literal(each)},"))
        for each in declared.members
    )
    line = f"{view.name}: TypeAlias = Literal[{', '.join(str(each.value) for each in members)}]"
    about = beside(declared.comments, "" if told else line)
    return replace(view, **about, members=members, is_long=bool(told))


def _comments_of_units(views: Sequence[UnitView], module: ir.Module) -> tuple[UnitView, ...]:
    """Return units with the comments of their declarations."""
    told = {identifier(each.name): each.comments for each in module.units}
    return tuple(
        replace(view, **beside(told.get(view.name.text, ()), f"{view.name} = {view.factor}"))
        for view in views
    )


def _root(module: ir.Module) -> PyExpr | None:
    """Write the folder of the outputs, for a module that lies in a folder below it."""
    depth = module.source.count("/")
    return PyExpr(f"pathlib.Path(__file__).parents[{depth}]", Level.ATOM) if depth else None


def main_scenario(module: ir.Module) -> ir.Scenario | None:
    """Return the only scenario of the file that no other one of it invokes, if there is one.

    One that is called `top` or `main` needs no such sign.
    """
    own = module.own_scenarios
    found = [each for each in own if each.is_runnable]
    is_named = any(each.name in NAMES_OF_MAIN for each in own)
    return found[0] if len(found) == 1 and not is_named else None


def shown_scenario(module: ir.Module) -> ir.Scenario | None:
    """Return the scenario whose tree viewers get: the one to run, else the last that can."""
    own = module.own_scenarios
    by_name = {scenario.name: scenario for scenario in own}
    wanted = next((name for name in NAMES_OF_MAIN if name in by_name), None)
    if wanted:
        return by_name[wanted]
    able = [scenario for scenario in own if not any(map(_is_given, scenario.declarations))]
    main = main_scenario(module)
    return main if main in able else next(reversed(able or own), None)


def _is_given(declaration: ir.Declaration) -> bool:
    """Whether only the invoker decides the type of an object."""
    return isinstance(declaration, ir.Actor) and declaration.is_given


def _policies(module: ir.Module) -> Iterator[str]:
    """Yield the settings that decide the meaning of its trees, where they have such members."""
    own = (each for each in module.scenarios if not each.is_imported)
    nodes = [node for each in own for node in ir.walk_behaviors(each.body)]
    if any(isinstance(node, ir.OneOf) for node in nodes):
        yield ONE_OF_POLICIES[module.one_of]
    if is_first_come(module):
        yield "a duration only ends its member early"


def _docstring(module: ir.Module) -> tuple[PyDocLine, ...]:
    own = [each for each in declarations(module) if is_own(each, module)]
    composed = [each for each in own if isinstance(each, ir.AbstractScenario)]
    kinds: dict[str, Sequence[Declared]] = {
        "Scenario": [each for each in composed if not each.is_action],
        "Action": [each for each in composed if each.is_action],
        "Type": [each for each in own if isinstance(each, ir.UserType | ir.UserEnum)],
        "Modifier": [each for each in own if isinstance(each, ir.UserModifier)],
    }
    word = next((kind for kind, found in kinds.items() if found), "Scenario")
    named = kinds[word]
    names = ", ".join(f"`{each.name}`" for each in named)
    about = ("", *module.comments) if module.comments else ()
    settings = (f"OpenSCENARIO DSL {module.standard}, dialect {module.dialect}", *_policies(module))
    lines = (
        f"{word}{'s' * (len(named) > 1)} {names}.",
        *about,
        "",
        f"Made by osc2tx from {module.source}: edit the scenario, not this module.",
        f"{'; '.join(settings)}.",
    )
    return tuple(PyDocLine.of(line) for line in lines)
