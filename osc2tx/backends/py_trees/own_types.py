"""Actors and structs of the scenario's own files, as classes of the module."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyDocLine, PyName, literal, name_expression
from osc2tx.backends.py_trees.comments import beside, comments
from osc2tx.backends.py_trees.expressions import ExpressionWriter
from osc2tx.backends.py_trees.naming import NameTable
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import FieldView, FunctionView, TypeView, signature


def write_types(
    own: Sequence[ir.UserType], table: TypeTable, methods: TypeMethods, uses: Uses
) -> tuple[TypeView, ...]:
    """Return the view models of the types that a module defines, in their order.

    Args:
        own: Those types, bases first.
        table: All types that the module knows.
        methods: The methods that are in classes.
        uses: Collects the imports of the module.
    """
    names = [each.name for each in own]
    return tuple(
        _TypeWriter(each, frozenset(names[index:]), table, methods, uses).write()
        for index, each in enumerate(own)
    )


class _TypeWriter:
    """Writes a type; `later` are the types with classes below it."""

    def __init__(
        self,
        own: ir.UserType,
        later: frozenset[str],
        table: TypeTable,
        methods: TypeMethods,
        uses: Uses,
    ) -> None:
        self._own = own
        self._later = later
        self._table = table
        self._methods = methods
        self._uses = uses

    def write(self) -> TypeView:
        own = self._own
        is_object = self._table.is_object(own)
        if not is_object:
            self._uses.standard("dataclasses", "dataclass")
        others, inherited = PyName("Any"), tuple[FieldView, ...]()
        several = is_object and own.is_of_library and bool(own.bases)
        if several:  # each base takes its own keywords, and passes the others on
            self._uses.standard("typing", "Any")
        elif is_object and own.all_fields:
            others, inherited = self._other_fields()
        word = "Actor" if own.is_actor else "Struct"
        kinds, above = self._table.kinds_of(own) if own.is_actor else ((), None)
        what = f"{word} `{own.name}`{' with what `extend` adds' if own.is_of_library else ''}."
        about = [what, *(["", *own.comments] if own.comments else [])]
        return TypeView(
            class_name=self._table.class_of((own.name,)),
            bases=self._table.bases_of(own),
            kinds=tuple(map(literal, kinds)),
            above=above,
            is_object=is_object,
            has_constructor=bool(own.all_fields) or several,
            docstring=tuple(PyDocLine.of(line) for line in about),
            fields=tuple(map(self._field, own.all_fields)),
            methods=tuple(self._method(name, m) for name, m in self._methods.of(own.name)),
            others=others,
            keeps=comments(own.keeps),
            inherited=inherited,
        )

    def _other_fields(self) -> tuple[PyName, tuple[FieldView, ...]]:
        """Return the types of the keywords of the bases: a type of the runtime, and own fields."""
        lineage = self._table.lineage(self._own.name)
        known = self._table.fields_type(lineage)
        if known is None:
            self._uses.standard("typing", "Any")
            return PyName("Any"), ()
        above = tuple(self._table.all_fields_above(lineage))
        return known, tuple(self._field(field, owner) for owner, field in above)

    def _field(self, field: ir.UserField, owner: str | None = None) -> FieldView:
        default = None if field.default is None else self._writer().write(field.default)
        if default is None and field.is_optional:
            default = name_expression(self._uses.name("not_given"))
        name = self._table.member(owner or self._own.name, field.name)
        annotation = self._table.annotation(field.type, self._later)
        line = f"        self.{name} = {name}  {annotation} = {default}"  # the longer one of both
        return FieldView(
            name=name, annotation=annotation, default=default, **beside(field.comments, line)
        )

    def _method(self, name: str, method: ir.Method) -> FunctionView:
        object_, *others = method.parameters
        writer = self._writer((method,), object_.name)
        body = method.expression
        assert body is not None, "one that has none stands in the scenario"
        parameters = [self._parameter(writer, parameter) for parameter in others]
        result = self._table.annotation(method.result, self._later)
        return FunctionView(
            signature=signature(self._table.member(self._own.name, name), parameters, result),
            value=writer.write(body),
            is_bounded=self._uses.bounded(body),
            comments=comments(method.comments),
        )

    def _parameter(self, writer: ExpressionWriter, parameter: ir.MethodParameter) -> str:
        name = writer.parameter(parameter.name)
        text = f"{name}: {self._table.annotation(parameter.type, self._later)}"
        return text if parameter.default is None else f"{text} = {writer.write(parameter.default)}"

    def _writer(
        self, methods: tuple[ir.Method, ...] = (), receiver: str | None = None
    ) -> ExpressionWriter:
        return ExpressionWriter(
            NameTable(),
            self._uses.unit,
            self._uses.name,
            lambda type_: self._table.class_of((type_,)),
            methods,
            self._table.member,
            self._methods,
            receiver,
        )
