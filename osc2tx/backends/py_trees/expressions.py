"""Expressions of the IR as Python expressions."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import assert_never

from osc2tx import ir
from osc2tx.backends.py_trees.code import (
    Level,
    PyExpr,
    PyName,
    literal,
    name_expression,
    self_attribute,
)
from osc2tx.backends.py_trees.list_operations import element_name, list_operation
from osc2tx.backends.py_trees.modifier_calls import parameter_name
from osc2tx.backends.py_trees.naming import NameTable, event_parameter, identifier
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.catalogue.constructors import (
    ACTOR_CLASSES,
)
from osc2tx_shared.classes import replace

COMPARISONS = {"==": "==", "!=": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
ARITHMETIC = {"+": Level.SUM, "-": Level.SUM, "*": Level.TERM, "/": Level.TERM, "%": Level.TERM}
INVERSES = {"==": "!=", "!=": "=="}
LOGICAL = {"and": Level.AND, "or": Level.OR}


# Methods of strings and ranges: how they are written, the object and the arguments in their places.
PLAIN_METHODS = {
    ("string", "length"): ("len({object})", Level.ATOM),
    ("string", "contains"): ("{first} in {object}", Level.COMPARISON),
    ("string", "substring"): ("{object}[{first}:{second}]", Level.ATOM),
    ("string", "split"): ("{object}.split({first})", Level.ATOM),
    ("string", "join"): ("{object}.join({first})", Level.ATOM),
    ("string", "replace"): ("{object}.replace({first}, {second})", Level.ATOM),
    ("string", "trim"): ("{object}.strip()", Level.ATOM),
    ("range", "lower"): ("{object}.low", Level.ATOM),
    ("range", "upper"): ("{object}.high", Level.ATOM),
}


class ExpressionWriter:
    """Writes expressions and remembers which units and runtime names they need.

    Args:
        fields: Python names of the scenario's fields.
        use_unit: Called with each unit that is written; returns its name.
        use_name: Called with each name that must be imported from the runtime library.
        class_of: Gives the class of an actor type.
        methods: The scenario's methods; their parameters must not hide names that their bodies use.
        member: Names a member of an object of some type.
        type_methods: The methods of types that are in their classes.
        receiver: The parameter that is `self`, in a method of a class.
        hidden: Names that no parameter of a function may have.
        event_class: Gives the class of an event with parameters that another scenario has.
    """

    def __init__(
        self,
        fields: NameTable,
        use_unit: Callable[[ir.Unit], PyName],
        use_name: Callable[[str], PyName],
        class_of: Callable[[str], PyName] | None = None,
        methods: tuple[ir.Method, ...] = (),
        member: Callable[[str, str], PyName] | None = None,
        type_methods: TypeMethods | None = None,
        receiver: str | None = None,
        hidden: Iterable[str] = (),
        event_class: Callable[[str, str], PyExpr] | None = None,
    ) -> None:
        self._event_class = event_class or _no_event_class
        self._type_methods = type_methods or TypeMethods()
        self._receiver = receiver
        bodies = (method.expression for method in methods)
        parts = (part for body in bodies if body is not None for part in ir.walk(body))
        units = (part.unit.name for part in parts if isinstance(part, ir.Quantity))
        self._hidden = frozenset({"self", "within", *map(identifier, units), *hidden})
        self._fields = fields
        self._use_unit = use_unit
        self._use_name = use_name
        self._member = member or (lambda _, name: PyName(identifier(name)))
        self._class_of = class_of or (lambda type_: use_name(ACTOR_CLASSES[type_]))

    def value(self, expression: ir.Expression) -> PyExpr:
        """Write an argument: late, as a lambda, if it depends on the state of the world."""
        written = self.write(expression)
        return self.late(written) if ir.is_live(expression) else written

    def unit(self, unit: ir.Unit) -> PyName:
        """Use a unit; return its name."""
        return self._use_unit(unit)

    def field(self, name: str) -> PyExpr:
        """Write a field of the scenario."""
        return self_attribute(self._fields[name])

    def parameter(self, name: str) -> PyName:
        """Name a parameter of a method or function."""
        return PyName("self") if name == self._receiver else parameter_name(name, self._hidden)

    def late(self, expression: PyExpr) -> PyExpr:
        """Write `lambda: expression`."""
        return PyExpr(f"lambda: {expression.within(Level.CONDITIONAL)}", Level.LAMBDA)

    def write(self, expression: ir.Expression) -> PyExpr:
        """Write an expression."""
        match expression:
            case ir.Literal(value=value):
                return literal(value)
            case ir.Quantity():
                return self._quantity(expression)
            case ir.EnumValue(member=member):
                return literal(member)
            case ir.FieldRef(name=name):
                return self.field(name)
            case ir.ParameterRef(name=name):
                return name_expression(self.parameter(name))
            case ir.ScenarioSelf():
                return PyExpr("self", Level.ATOM)
            case ir.EventArgument(event=event, parameter=parameter, owner=owner):
                read = f"{self._event(event, owner)}.{event_parameter(parameter)}"
                return PyExpr(read, Level.ATOM)
            case ir.InvokedValue(label=label, name=name):
                field = PyName(identifier(name))
                return PyExpr(f"self.invoked({literal(label)}).{field}", Level.ATOM)
            case ir.Attribute(base=base, owner=owner, name=name):
                return PyExpr(f"{self._atom(base)}.{self._member(owner, name)}", Level.ATOM)
            case ir.MethodCall():
                return self._method_call(expression)
            case ir.Unary():
                return self._unary(expression)
            case ir.Binary():
                return self._binary(expression)
            case ir.Conditional():
                return self._conditional(expression)
            case ir.ListValue(elements=elements):
                inner = ", ".join(
                    (
                        f"*{self._atom(e)}"
                        if e.type.kind is ir.Kind.LIST
                        else self.write(e).within(Level.CONDITIONAL)
                    )
                    for e in elements
                )
                return PyExpr(f"[{inner}]", Level.ATOM)
            case ir.RangeValue(lower=lower, upper=upper):
                bounds = f"{self.write(lower)}, {self.write(upper)}"
                return PyExpr(f"{self._use_name('within')}({bounds})", Level.ATOM)
            case ir.Element(depth=depth):
                return name_expression(element_name(depth))
            case ir.ListOperation():
                return list_operation(expression, self.write)
            case ir.Index(base=base, index=ir.Literal() as index):
                return PyExpr(f"{self._atom(base)}[{self.write(index)}]", Level.ATOM)
            case ir.Index(base=base, index=index):
                # Python counts negative indices from the end.
                inner = f"{self.write(base)}, {self.write(index)}"
                return PyExpr(f"{self._use_name('member_at')}({inner})", Level.ATOM)
            case ir.Conversion(operand=operand):
                function = "int" if expression.type.kind is ir.Kind.INTEGER else "float"
                return PyExpr(f"{function}({self.write(operand)})", Level.ATOM)
            case ir.Lookup(operand=operand, table=table):
                entries = ", ".join(f"{literal(key)}: {literal(value)}" for key, value in table)
                return PyExpr(f"{{{entries}}}[{self.write(operand)}]", Level.ATOM)
            case ir.TypeTest(operand=operand, tested=tested):
                class_ = self._class_of(tested)
                return PyExpr(f"isinstance({self.write(operand)}, {class_})", Level.ATOM)
            case ir.Downcast(operand=operand, type=type_):
                class_ = self._class_of(type_.name)
                as_type = self._use_name("as_type")
                return PyExpr(f"{as_type}({self.write(operand)}, {class_})", Level.ATOM)
            case ir.UserShape(operand=operand, compute=compute, duration=duration):
                object_ = self.write(operand)
                methods = [name for name in (compute, duration) if name is not None]
                if all(method in self._type_methods for method in methods):
                    return object_
                functions = (self._function(method, object_) for method in methods)
                inner = ", ".join(map(str, (object_, *functions)))
                return PyExpr(f"{self._use_name('OwnShape')}({inner})", Level.ATOM)
            case ir.Undefined(method=method):
                return PyExpr(f"{self._use_name('undefined')}({literal(method)})", Level.ATOM)
            case ir.HalfRange(bound=bound, is_lower=is_lower):
                half = self._use_name("at_least" if is_lower else "at_most")
                return PyExpr(f"{half}({self.write(bound)})", Level.ATOM)
            case ir.Choices(elements=elements):
                inner = ", ".join(map(self._choice, elements))
                return PyExpr(f"{self._use_name('any_of')}({inner})", Level.ATOM)
            case _:
                assert_never(expression)

    def _choice(self, element: ir.Expression) -> str:
        """Write a value of a set; a list as its elements."""
        written = self.write(element)
        is_list = element.type.kind is ir.Kind.LIST
        return f"*{written.within(Level.ATOM)}" if is_list else written.within(Level.CONDITIONAL)

    def _event(self, path: str, owner: str | None) -> PyExpr:
        """Write an event of the scenario, or `label.event` of one that it invokes."""
        if owner is None:
            return self.field(path)
        class_ = self._event_class(owner, path.rpartition(".")[2])
        return PyExpr(f"self.event({literal(path)}, {class_})", Level.ATOM)

    def _atom(self, expression: ir.Expression) -> str:
        return self.write(expression).within(Level.ATOM)

    def _quantity(self, quantity: ir.Quantity) -> PyExpr:
        unit = self._use_unit(quantity.unit)
        number = literal(quantity.value)
        offset = quantity.unit.offset
        if offset and quantity.unit.is_standard:
            return PyExpr(f"{unit}({number})", Level.ATOM)
        if offset:
            product = f"{number.within(Level.TERM)} * {unit}"
            return PyExpr(f"{product} + {literal(offset).within(Level.TERM)}", Level.SUM)
        return PyExpr(f"{number.within(Level.TERM)} * {unit}", Level.TERM)

    def _method_call(self, call: ir.MethodCall) -> PyExpr:
        own = isinstance(call.base, ir.ScenarioSelf)
        if (call.owner, call.method) in PLAIN_METHODS:
            return self._plain_method(call)
        if own and call.method in self._type_methods:
            return self._type_method(call)
        arguments = ", ".join(self._argument(argument, own) for argument in call.arguments)
        method = self._fields[call.method] if own else PyName(identifier(call.method))
        object_ = self._class_of(call.owner) if call.needs_no_object else self._atom(call.base)
        return PyExpr(f"{object_}.{method}({arguments})", Level.ATOM)

    def _type_method(self, call: ir.MethodCall) -> PyExpr:
        """Write a method of a class of the module: the first argument is the object."""
        owner, _, name = call.method.rpartition(".")
        object_, *others = call.arguments
        arguments = ", ".join(self._argument(argument, own=True) for argument in others)
        method = self._member(owner, name)
        return PyExpr(f"{self._atom(object_.value)}.{method}({arguments})", Level.ATOM)

    def _function(self, method: str, object_: PyExpr) -> PyExpr:
        """Write a method of a type as a function that takes the object."""
        if method not in self._type_methods:
            return self.field(method)
        owner, _, name = method.rpartition(".")
        is_overridden = self._type_methods.is_overridden(method)
        class_ = f"type({object_})" if is_overridden else self._class_of(owner)
        return PyExpr(f"{class_}.{self._member(owner, name)}", Level.ATOM)

    def _plain_method(self, call: ir.MethodCall) -> PyExpr:
        """Write a method of a string or range (2.2)."""
        form, level = PLAIN_METHODS[call.owner, call.method]
        first, second, *_ = [
            *(self.write(a.value).within(Level.SUM) for a in call.arguments),
            "",
            "",
        ]
        text = form.format(object=self._atom(call.base), first=first, second=second)
        return PyExpr(text, level)

    def _argument(self, argument: ir.Argument, own: bool) -> str:
        value = self.write(argument.value).within(Level.CONDITIONAL)
        if argument.is_positional:
            return value
        name = argument.parameter
        return f"{self.parameter(name) if own else PyName(identifier(name))}={value}"

    def _unary(self, unary: ir.Unary) -> PyExpr:
        if unary.operator == "-" and isinstance(unary.operand, ir.Quantity):
            inner = unary.operand
            if not inner.unit.offset:  # `-1 * m` reads better than `-(1 * m)`
                return self._quantity(replace(inner, value=-inner.value))
        operand = self.write(unary.operand)
        if unary.operator == "not":
            return self._negated(unary.operand, operand)
        return PyExpr(f"-{operand.within(Level.UNARY)}", Level.UNARY)

    def _binary(self, binary: ir.Binary) -> PyExpr:
        """Write a chain of operators; its left spine may be long, so it is walked in a loop."""
        spine = [binary]
        while isinstance(spine[-1].left, ir.Binary):
            spine.append(spine[-1].left)
        left = self.write(spine[-1].left)
        for node in reversed(spine):
            left = self._combine(node, left)
        return left

    def _combine(self, node: ir.Binary, left: PyExpr) -> PyExpr:
        operator = node.operator
        is_value = node.left.type.kind is not ir.Kind.RANGE
        if operator == "in" and is_value and isinstance(node.right, ir.RangeValue):
            return self._in_range(left, node.right)
        if operator == "in" and node.left.type.kind is ir.Kind.LIST:
            every = f"all(it in {self.write(node.right).within(Level.SUM)} for it in {left})"
            return PyExpr(every, Level.ATOM)
        if operator in INVERSES and _is_truth_value(node.right):
            return self._truth_comparison(
                node.left, left, holds=_is_true(node.right) == (operator == "==")
            )
        right = self.write(node.right)
        if operator in INVERSES and _is_truth_value(node.left):
            return self._truth_comparison(
                node.right, right, holds=_is_true(node.left) == (operator == "==")
            )
        if operator in COMPARISONS or operator == "in":
            # Python would read a chain `a < b < c` differently: both sides bind tighter.
            text = f"{left.within(Level.SUM)} {operator} {right.within(Level.SUM)}"
            return PyExpr(text, Level.COMPARISON)
        if operator in ARITHMETIC:
            level = ARITHMETIC[operator]
            spelled = "//" if _is_integer_division(node) else operator
            return PyExpr(f"{left.within(level)} {spelled} {right.within(level + 1)}", level)
        if operator in LOGICAL:
            level = LOGICAL[operator]
            return PyExpr(f"{left.within(level)} {operator} {right.within(level + 1)}", level)
        # a => b; a chain of them stays flat, for `or` is associative
        negated = self._negated(node.left, left)
        return PyExpr(f"{negated.within(Level.OR)} or {right.within(Level.OR)}", Level.OR)

    def _negated(self, operand: ir.Expression, written: PyExpr) -> PyExpr:
        inverse = INVERSES.get(operand.operator) if isinstance(operand, ir.Binary) else None
        if inverse is not None and isinstance(operand, ir.Binary):
            return self._binary(replace(operand, operator=inverse))
        return PyExpr(f"not {written.within(Level.NOT)}", Level.NOT)

    def _truth_comparison(self, operand: ir.Expression, written: PyExpr, *, holds: bool) -> PyExpr:
        """Write a truth value that is compared with `true` or `false`."""
        return written if holds else self._negated(operand, written)

    def _in_range(self, left: PyExpr, bounds: ir.RangeValue) -> PyExpr:
        if None in (ir.constant(bounds.lower), ir.constant(bounds.upper)):
            # Only the run tells which of them is the lower one.
            text = f"{left.within(Level.SUM)} in {self.write(bounds)}"
            return PyExpr(text, Level.COMPARISON)
        lower, upper = self.write(bounds.lower), self.write(bounds.upper)
        text = f"{lower.within(Level.SUM)} <= {left.within(Level.SUM)} <= {upper.within(Level.SUM)}"
        return PyExpr(text, Level.COMPARISON)

    def _conditional(self, node: ir.Conditional) -> PyExpr:
        condition = self.write(node.condition).within(Level.OR)
        when_true = self.write(node.when_true).within(Level.OR)
        when_false = self.write(node.when_false).within(Level.CONDITIONAL)
        return PyExpr(f"{when_true} if {condition} else {when_false}", Level.CONDITIONAL)


def _is_truth_value(node: ir.Expression) -> bool:
    return isinstance(node, ir.Literal) and isinstance(node.value, bool)


def _is_true(node: ir.Expression) -> bool:
    return isinstance(node, ir.Literal) and node.value is True


def _is_integer_division(node: ir.Binary) -> bool:
    return node.operator == "/" and node.type.kind is ir.Kind.INTEGER


def _no_event_class(scenario: str, event: str) -> PyExpr:
    raise AssertionError(f"{event} of {scenario} is read outside of a scenario")
