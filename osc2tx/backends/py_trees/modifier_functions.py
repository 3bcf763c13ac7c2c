"""User-defined modifiers, as functions of the module.

An application is a call of the function if its result is exactly the meaning of the program there.
Otherwise the modifiers of the library are written out: some of them may state the start of the
actor, which is written in `placement`, and a function takes no values that change during the run. A
function that its own file never calls is not written.

The type of a function names the modifiers that it returns, so that a type checker knows which
actions take them.
"""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.backends.py_trees.calls import CallWriter
from osc2tx.backends.py_trees.code import Level, PyDocLine, PyExpr
from osc2tx.backends.py_trees.comments import beside, comments
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.modifier_calls import ModifierCalls
from osc2tx.backends.py_trees.naming import NameTable, identifier
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import ArgumentView, CallView, ParameterView, UserModifierView


def write_modifiers(
    modifiers: Iterable[ir.UserModifier],
    functions: ModifierCalls,
    names: NameTable,
    types: TypeTable,
    methods: TypeMethods,
    uses: Uses,
) -> tuple[UserModifierView, ...]:
    """Return the view models of the functions that a module defines, in their order.

    Args:
        modifiers: Those modifiers.
        functions: Calls of them, and of those that the module imports.
        names: Names of the module.
        types: All types that the module knows.
        methods: The methods that are in classes.
        uses: Collects the imports of the module.
    """

    def write(modifier: ir.UserModifier) -> UserModifierView:
        expressions = ExpressionWriter(
            NameTable(),
            uses.unit,
            uses.name,
            lambda type_: types.class_of((type_,)),
            member=types.member,
            type_methods=methods,
            hidden=functions.hidden(modifier),
        )
        calls = CallWriter(expressions, uses.name, uses.modifier, functions)
        parameters = tuple(
            _commented(p, _parameter(p, expressions, types)) for p in modifier.parameters
        )
        about = ("", *modifier.comments) if modifier.comments else ()
        written = tuple(calls.modifiers(modifier.calls))
        kinds = dict.fromkeys(uses.modifier(identifier(call.name)) for call in modifier.calls)
        return UserModifierView(
            name=names[modifier.key],
            parameters=parameters,
            result=PyExpr(f"list[{' | '.join(map(str, kinds))}]", Level.ATOM),
            keeps=comments(modifier.keeps),
            docstring=tuple(map(PyDocLine.of, (f"Modifier `{modifier.name}`.", *about))),
            value=ArgumentView(call=CallView(None, written, exploded=True)),
        )

    return tuple(map(write, modifiers))


def _commented(parameter: ir.MethodParameter, written: PyExpr) -> ParameterView:
    return ParameterView(written, **beside(parameter.comments, f"    {written},"))


def _parameter(
    parameter: ir.MethodParameter, expressions: ExpressionWriter, types: TypeTable
) -> PyExpr:
    name = expressions.parameter(parameter.name)
    text = f"{name}: {types.annotation(parameter.type)}"
    if parameter.default is not None:
        text = f"{text} = {expressions.write(parameter.default)}"
    return PyExpr(text, Level.ATOM)
