"""Methods of the module's own types, as methods of their classes.

The IR has a method of a type as one of the scenario that takes the object first. It becomes one of
the class if its body reads nothing of the scenario. Python finds the method of the most special
class itself, so the tests of the object that the IR has for that are left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from osc2tx import ir
from osc2tx.backends.py_trees.support import has_support
from osc2tx_shared.classes import replace

OF_THE_SCENARIO = (ir.FieldRef, ir.InvokedValue, ir.EventArgument, ir.UserShape)


class TypeMethods:
    """The methods that are in classes.

    Args:
        types: The module's own types.
        scenarios: Its scenarios.
    """

    def __init__(
        self, types: Iterable[ir.UserType] = (), scenarios: Iterable[ir.AbstractScenario] = ()
    ) -> None:
        types = tuple(types)
        own = {each.name for each in types}
        found = [each for type_ in types for each in type_.methods if has_support(each, types)]
        found += [each for scenario in scenarios for each in scenario.methods]
        self._methods = {
            method.name: method
            for method in found
            if method.name.rpartition(".")[0] in own and method.expression is not None
        }
        while wrong := [name for name in self._methods if self._reads_more(name)]:
            for name in wrong:
                del self._methods[name]

    def __contains__(self, name: str) -> bool:
        """Return whether a method of a type, `limits.middle`, is in its class."""
        return name in self._methods

    def of(self, type_: str) -> Iterator[tuple[str, ir.Method]]:
        """Yield the methods of a type, each with its plain name."""
        for name, method in self._methods.items():
            owner, _, plain = name.rpartition(".")
            if owner == type_:
                yield plain, replace(method, expression=self._own_body(method))

    def is_overridden(self, name: str) -> bool:
        """Whether a more special class has a method in the place of one."""
        method = self._methods[name]
        return self._own_body(method) is not method.expression

    def _own_body(self, method: ir.Method) -> ir.Expression | None:
        """Return the body of a method for objects of its own type."""
        body = method.expression
        while (
            isinstance(body, ir.Conditional)
            and isinstance(body.condition, ir.TypeTest)
            and isinstance(body.when_true, ir.MethodCall)
            and body.when_true.method in self
            and body.when_true.method == f"{body.condition.tested}.{_plain(method.name)}"
        ):
            body = body.when_false
        return body

    def _reads_more(self, name: str) -> bool:
        body = self._methods[name].expression
        parts = () if body is None else ir.walk(body)
        return any(
            isinstance(part, OF_THE_SCENARIO)
            or (
                isinstance(part, ir.MethodCall)
                and isinstance(part.base, ir.ScenarioSelf)
                and part.method not in self
            )
            for part in parts
        )


def _plain(name: str) -> str:
    return name.rpartition(".")[2]
