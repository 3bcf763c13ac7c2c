"""Names of the definitions of a module, and keys for them.

Definitions of its own file are named first, by its text alone: its classes have the same names with
any imports.
"""

from __future__ import annotations

from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.py_trees.naming import NameTable, class_name, identifier
from osc2tx.backends.py_trees.runtime_api import ACTOR_FIELDS, PHYSICAL_TYPES
from osc2tx.backends.py_trees.type_table import class_key, enum_key
from osc2tx.backends.py_trees.user_actions import action_key, has_function, protocol_key
from osc2tx.backends.py_trees.uses import LIBRARY
from osc2tx.catalogue import catalogue, object_tables
from osc2tx.catalogue.constructors import (
    ACTOR_CLASSES,
    STRUCT_CLASSES,
)

Declared: TypeAlias = (
    ir.AbstractScenario | ir.UserType | ir.UserEnum | ir.UserAction | ir.UserModifier
)

# Names from the runtime, from Python and of the module; the names of definitions must not hide
# them.
RUNTIME_CLASSES = frozenset(
    {
        *ACTOR_CLASSES.values(),
        *ACTOR_FIELDS.values(),
        *STRUCT_CLASSES.values(),
        *PHYSICAL_TYPES.values(),
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
        "Scenario",
        "Serial",
        "Unit",
        "Until",
        "Wait",
    }
)
RUNTIME_FUNCTIONS = frozenset(
    {
        "any_of",
        "as_type",
        "at_least",
        "at_most",
        "bounded",
        "elapsed",
        "every",
        "fall",
        "fixed",
        "global_action",
        "inf",
        "main",
        "member_at",
        "not_given",
        "require_api",
        "rise",
        "undefined",
        "user_action",
        "within",
    }
)
PYTHON_NAMES = frozenset(
    {
        "Any",
        "Literal",
        "Protocol",
        "SystemExit",
        "TypeAlias",
        "Unpack",
        "all",
        "any",
        "bool",
        "dataclass",
        "enumerate",
        "float",
        "int",
        "isinstance",
        "len",
        "list",
        "next",
        "object",
        "pathlib",
        "str",
        "sum",
        "super",
        "sys",
        "type",
    }
)
ROOT_FUNCTION = "create_root"


def key_of(declared: Declared) -> str:
    """Return the key of a declaration, which is unique in a module."""
    match declared:
        case ir.AbstractScenario() | ir.UserModifier():
            return declared.key
        case ir.UserType():
            return class_key(declared.name)
        case ir.UserEnum():
            return enum_key(declared.name, declared.members)
        case ir.UserAction():
            return action_key(declared.qualified_name)


def is_own(declared: Declared, module: ir.Module) -> bool:
    """Return whether the file of a module declares something itself."""
    return declared.span.source.name == module.source


def declarations(module: ir.Module) -> tuple[Declared, ...]:
    """Return all that a module has a name for."""
    actions = (each for each in module.actions if has_function(each.qualified_name))
    scenarios = (*module.bases, *module.scenarios)
    return (*scenarios, *module.types, *module.enums, *actions, *module.modifiers)


def has_module(module: ir.Module) -> bool:
    """Return whether a file makes a module: one that declares anything else than units does.

    One that declares actions for a package to carry out needs scenarios for it: the package may
    have the name of the file, and the module would hide it.
    """
    own = [each for each in declarations(module) if is_own(each, module)]
    of_package = any(isinstance(each, ir.UserAction) for each in own)
    scenarios = (each for each in own if isinstance(each, ir.AbstractScenario))
    return any(not each.is_action for each in scenarios) or (bool(own) and not of_package)


def own_names(module: ir.Module) -> NameTable:
    """Return the names of the definitions in the file of a module."""
    library = object_tables().enums | object_tables().units | catalogue().modifiers.keys()
    runtime = RUNTIME_CLASSES | RUNTIME_FUNCTIONS
    extended = {class_name(each.name) for each in module.types if each.is_of_library}
    names = NameTable((runtime - extended) | library | PYTHON_NAMES | {ROOT_FUNCTION, LIBRARY})
    for declared in declarations(module):
        if is_own(declared, module):
            add_name(names, declared)
    return names


def add_name(names: NameTable, declared: Declared) -> None:
    """Name the definitions of a module."""
    key = key_of(declared)
    match declared:
        case ir.AbstractScenario():
            names.add(key, class_name(declared.name.rpartition(".")[2]), "Scenario")
        case ir.UserType():
            names.add(key, class_name(declared.name), "Type")
        case ir.UserEnum():
            names.add(key, class_name(declared.name), "Enum")
        case ir.UserModifier():
            names.add(key, identifier(declared.name.rpartition(".")[2]), "_modifier")
        case ir.UserAction():
            names.add(key, identifier(declared.name), "_action")
            names.add(protocol_key(key), class_name(declared.name), "Action")
