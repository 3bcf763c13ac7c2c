"""View models: the data that the templates place, every decision already taken."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx.backends.py_trees.code import Level, PyComment, PyDocLine, PyExpr, PyName
from osc2tx.backends.py_trees.formatting import LINE_LENGTH
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class ArgumentView:
    """An argument of a call: code, or a nested call, with the comments around it."""

    code: PyExpr | None = None
    call: CallView | None = None
    keyword: PyName | None = None
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None
    below: tuple[PyComment, ...] = ()


@dataclass(frozen=True, slots=True)
class CallView:
    """A call, without `callee` a list; `exploded` ones get a line for each argument."""

    callee: PyExpr | None
    arguments: tuple[ArgumentView, ...] = ()
    exploded: bool = False
    end_comments: tuple[PyComment, ...] = ()


@dataclass(frozen=True, slots=True)
class StatementView:
    """`target: annotation = value`, or the value alone."""

    target: PyExpr | None
    value: ArgumentView
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None
    below: tuple[PyComment, ...] = ()
    blank_before: bool = False
    annotation: PyExpr | None = None


def signature(name: PyName, parameters: Iterable[str], result: PyExpr) -> PyExpr:
    """Return the signature of a method with written parameters."""
    return PyExpr(f"{name}({', '.join(('self', *parameters))}) -> {result}", Level.ATOM)


@dataclass(frozen=True, slots=True)
class FunctionView:
    """A method that computes a value; one that is bounded has a budget of calls."""

    signature: PyExpr
    value: PyExpr
    is_bounded: bool
    comments: tuple[PyComment, ...] = ()


@dataclass(frozen=True, slots=True)
class MethodView:
    """A method that returns one piece of the behavior tree."""

    signature: PyExpr
    value: ArgumentView
    docstring: tuple[PyDocLine, ...] = ()
    comments: tuple[PyComment, ...] = ()
    statements: tuple[StatementView, ...] = ()


@dataclass(frozen=True, slots=True)
class ImportView:
    """`from module import names`.

    Attributes:
        module: Of the names.
        names: In order, each a name or `name as other`.
        is_long: Whether each name has a line, so that one more changes no other line.
    """

    module: str
    names: tuple[PyName | PyExpr, ...]
    is_long: bool = False

    @property
    def has_lines(self) -> bool:
        """Whether each name has a line, as one has where there are too many."""
        line = f"from {self.module} import {', '.join(map(str, self.names))}"
        return (self.is_long and len(self.names) > 1) or len(line) > LINE_LENGTH


@dataclass(frozen=True, slots=True)
class UnitView:
    """A unit that the scenario's own files declare, as a constant of the module."""

    name: PyName
    factor: PyExpr
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None


@dataclass(frozen=True, slots=True)
class EnumMemberView:
    """A member of an enum.

    Attributes:
        value: Its literal.
        comments: Those above it.
        trailing: The one behind it.
    """

    value: PyExpr
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None


@dataclass(frozen=True, slots=True)
class EnumView:
    """An enum that the scenario's own files declare or extend, as a type of the module.

    Attributes:
        name: Its name.
        members: Its members.
        is_long: Each member has its own line, since some have comments.
        copied: Why it is a copy, if it is one.
    """

    name: PyName
    members: tuple[EnumMemberView, ...]
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None
    is_long: bool = False
    copied: PyComment | None = None


@dataclass(frozen=True, slots=True)
class FieldView:
    """A field of a class."""

    name: PyName
    annotation: PyExpr
    default: PyExpr | None = None
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None


@dataclass(frozen=True, slots=True)
class ParameterView:
    """A parameter of a function, with the comments above and behind it."""

    code: PyExpr
    comments: tuple[PyComment, ...] = ()
    trailing: PyComment | None = None


@dataclass(frozen=True, slots=True)
class EventView:
    """The class of an event with parameters."""

    class_name: PyName
    docstring: tuple[PyDocLine, ...]
    parameters: tuple[FieldView, ...]


@dataclass(frozen=True, slots=True)
class TypeView:
    """A class for an actor or struct of the scenario's own files.

    Attributes:
        class_name: Its name.
        bases: Its base classes.
        kinds: Name of an actor in the source; of a combination also the names of its parts.
        above: The class whose kinds follow; a struct has none.
        is_object: An object takes its fields by its constructor, a struct of values is a dataclass.
        docstring: Lines of its docstring.
        fields: Its own fields.
        methods: Its own methods.
        has_constructor: Whether a declared object has a constructor.
        others: The type of the keywords that its bases take.
        inherited: The fields that its bases of the scenario's files add to those.
        keeps: Its constraints, as comments.
        copied: Why it is a copy, if it is one.
    """

    class_name: PyName
    bases: tuple[PyName | PyExpr, ...]
    kinds: tuple[PyExpr, ...]
    above: PyName | PyExpr | None
    is_object: bool
    docstring: tuple[PyDocLine, ...]
    fields: tuple[FieldView, ...]
    methods: tuple[FunctionView, ...]
    has_constructor: bool = False
    others: PyName = PyName("Any")
    inherited: tuple[FieldView, ...] = ()
    keeps: tuple[PyComment, ...] = ()
    copied: PyComment | None = None


@dataclass(frozen=True, slots=True)
class UserActionView:
    """A user-defined action, as a function with its type.

    Attributes:
        function: Its name in the module.
        protocol: Name of its type.
        action: Its name in the registry.
        binder: The function that creates it.
        docstring: Lines of its docstring.
        parameters: As they are written, the actor first.
        copied: Why it is a copy, if it is one.
        base: The inherited action of the library, if there is one.
    """

    function: PyName
    protocol: PyName
    action: PyExpr
    binder: PyName
    docstring: tuple[PyDocLine, ...]
    parameters: tuple[ParameterView, ...]
    copied: PyComment | None = None
    base: PyExpr | None = None


@dataclass(frozen=True, slots=True)
class UserModifierView:
    """A user-defined modifier, as a function.

    Attributes:
        name: Its name.
        parameters: As they are written.
        result: Type of its result.
        keeps: Its constraints, as comments.
        copied: Why it is a copy, if it is one.
    """

    name: PyName
    parameters: tuple[ParameterView, ...]
    result: PyExpr
    keeps: tuple[PyComment, ...]
    docstring: tuple[PyDocLine, ...]
    value: ArgumentView
    copied: PyComment | None = None

    @property
    def is_long(self) -> bool:
        """Whether each parameter has a line, since some have comments."""
        return any(each.comments or each.trailing for each in self.parameters)


@dataclass(frozen=True, slots=True)
class ScenarioView:
    """A scenario class.

    Attributes:
        class_name: Its name.
        base: The class that it inherits from.
        is_derived: That is one of another scenario, not of the runtime.
        docstring: Lines of its docstring.
        attributes: Its name, its source and its policies.
        events: Classes of its events with parameters.
        ahead: Its declarations before those of its base.
        declarations: Its declarations.
        functions: Its methods that compute a value.
        places_besides: It adds placements to those of its base.
        placements: Its placements.
        methods: Its behavior, and the phases of it.
        end_comments: Those below its last member.
        copied: Why it is a copy, if it is one.
    """

    class_name: PyName
    base: PyName
    is_derived: bool
    docstring: tuple[PyDocLine, ...]
    attributes: tuple[StatementView, ...]
    events: tuple[EventView, ...]
    ahead: tuple[StatementView, ...]
    declarations: tuple[StatementView, ...]
    functions: tuple[FunctionView, ...]
    places_besides: bool
    placements: tuple[StatementView, ...]
    methods: tuple[MethodView, ...]
    end_comments: tuple[PyComment, ...] = ()
    copied: PyComment | None = None


@dataclass(frozen=True, slots=True)
class ModuleView:
    """A module.

    Attributes:
        docstring: Lines of its docstring.
        library: Its name for the whole of the runtime, if it needs one.
        imports: Its imports from the runtime.
        siblings: Its imports from the modules of imported files.
        root: The folder where those are found, if it is not that of the module.
        api_level: Level of the runtime it is made for.
        units: Units it defines.
        enums: Enums it defines.
        standard_imports: Its imports from Python's standard library.
        types: Classes for the types of its objects.
        actions: User-defined actions.
        modifiers: User-defined modifiers.
        scenarios: Its classes.
        mains: The classes that it can run as a script.
        shown: The class whose tree viewers get, if there is any.
    """

    docstring: tuple[PyDocLine, ...]
    imports: tuple[ImportView, ...]
    siblings: tuple[ImportView, ...]
    root: PyExpr | None
    api_level: int
    units: tuple[UnitView, ...]
    enums: tuple[EnumView, ...]
    scenarios: tuple[ScenarioView, ...]
    mains: tuple[PyName, ...]
    shown: PyName | None
    standard_imports: tuple[ImportView, ...] = ()
    library: PyName | None = None
    types: tuple[TypeView, ...] = ()
    actions: tuple[UserActionView, ...] = ()
    modifiers: tuple[UserModifierView, ...] = ()
