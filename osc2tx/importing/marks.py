"""Variables as events: one is emitted where a variable is set, and waited for by conditions on it.

Where it matters that an event has come before, a `bool` keeps it.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document
from osc2tx.importing.names import Names, snake
from osc2tx.importing.program import Declared
from osc2tx.importing.report import ImportReport


class Marks:
    """The events that stand for variables with values, and for parameters that are set in the run.

    A variable that is compared otherwise than for equality has one event for all values.
    """

    def __init__(self, document: Document, names: Names, report: ImportReport) -> None:
        self._names, self._report = names, report
        self._measured = {
            node.get("variableRef") or node.get("parameterRef")
            for node in document.tagged("VariableCondition", "ParameterCondition")
            if node.get("rule") != "equalTo"
        }
        self._initial = {
            node.get("name") or "": _plain(node.get("value") or "")
            for node in document.tagged("VariableDeclaration")
        }
        self._set: dict[str, set[str]] = {}
        self._modified: set[str] = set()
        for action in document.resolved_tagged("VariableAction"):
            for each in action.children:
                said = action.get("variableRef") or ""
                self._set.setdefault(said, set()).add(_plain(each.get("value") or ""))
                self._modified |= {said} if each.tag == "ModifyAction" else set()
        self._now = {**document.parameters, **self._initial}
        self._events: dict[tuple[str, str], str] = {}
        self._kept: dict[str, str] = {}

    def event(self, name: str, value: str) -> str:
        """Return the event that stands for a variable with a value."""
        key = (name, "" if name in self._measured else value)
        value = key[1]
        if key not in self._events:
            base = snake(name) if value.lower() in ("true", "1", "") else snake(f"{name}_{value}")
            self._events[key] = self._names.new("", kind="event", base=base)
            self._report.names[f"variable {name} = {value}"] = self._events[key]
        return self._events[key]

    def set_to(self, name: str, value: str) -> str:
        """Return the event with which a variable or parameter has a value."""
        self._now[name] = value
        return self.event(name, value)

    def changed(self, name: str, by: Node) -> str | None:
        """Return the event with which a variable or parameter is changed by an amount or a factor.

        The changes are taken to come in the order of the document. `None`: there is no number.

        Args:
            name: The variable or parameter.
            by: `AddValue` or `MultiplyByValue`.
        """
        try:
            now, value = float(self._now[name]), float(by.text("value") or "")
        except (KeyError, ValueError):
            return None
        return self.set_to(name, f"{now + value if by.tag == 'AddValue' else now * value:.12g}")

    def kept(self, event: str) -> str:
        """Return the `bool` that tells whether an event has come."""
        if event not in self._kept:
            self._kept[event] = self._names.new("", kind="variable", base=f"{event}_came")
        return self._kept[event]

    def change_from(self, name: str, value: str) -> str | None:
        """Return the event with which a variable loses the value that it has at the start.

        `None`: it does not have it then, or it may get it again, or there are several such events.
        """
        others = self._set.get(name, set())
        if name in self._measured | self._modified or self._initial.get(name) != _plain(value):
            return None
        if len(others) != 1 or _plain(value) in others:
            return None
        return self.event(name, next(iter(others)))

    def members(self, words: set[str]) -> Iterator[Declared]:
        """Yield the declarations of what some words name."""
        kept = {event: name for event, name in self._kept.items() if name in words}
        for event in self._events.values():
            if event in words or event in kept:
                yield Declared("", f"event {event}")
        for event, name in kept.items():
            yield Declared("", f"var {name}: bool = sample(true, @{event}, false)")


def _plain(value: str) -> str:
    """Return a value in the form in which values are compared."""
    lower = value.lower()
    return {"1": "true", "0": "false"}.get(lower, lower)
