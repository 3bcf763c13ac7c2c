"""External methods (§7.3.7): functions of user code, called only if allowed."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, Literal, get_args, get_origin

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError


def external_function(
    path: str, kind: type | None, allowed: tuple[str, ...], source: str
) -> Callable[..., Any]:
    """Return a user function that only raises errors of the scenario.

    Args:
        path: `module.function`.
        kind: Type of its result; None: any.
        allowed: The functions of `--allow-external`.
        source: Source position of the method.

    Raises:
        SettingsError: It is not allowed. Nothing is imported then.
        ScenarioError: It cannot be found.
    """
    if path not in allowed:
        raise SettingsError(
            f"the scenario calls external code, {path}: allow it with --allow-external {path}",
            source,
        )
    module, _, name = path.rpartition(".")
    with OwnCode(f"no function {path}:", source):
        function = getattr(import_module(module), name)
    if not callable(function):
        raise ScenarioError(f"{path} is not a function", source)

    def call(*arguments: Any) -> Any:
        with OwnCode(f"{path} raised", source):
            result = function(*arguments)
        return result if kind is None else as_kind(result, kind, path, source)

    call.__name__ = name
    return call


def as_kind(result: Any, kind: Any, path: str, source: str) -> Any:
    """Return a result converted to the declared type, a list member by member.

    Args:
        result: The result of the function.
        kind: A class, the `Literal` of an enumeration, or `list[…]` of one of these.
        path: `module.function`.
        source: Source position of the method.

    Raises:
        ScenarioError: It has another type.
    """
    arguments = get_args(kind)
    if get_origin(kind) is Literal:
        if not isinstance(result, str) or result not in arguments:
            raise ScenarioError(
                f"{path} returns {result!r}, which is not one of {', '.join(arguments)}", source
            )
        return result
    if get_origin(kind) is list:
        members = as_kind(result, list, path, source)
        return [as_kind(each, arguments[0], path, source) for each in members]
    kind = get_origin(kind) or kind
    if kind is float and isinstance(result, int) and not isinstance(result, bool):
        return float(result)
    if not isinstance(result, kind) or (kind is int and isinstance(result, bool)):
        found = type(result).__name__
        raise ScenarioError(f"{path} returns a {found}, not a {kind.__name__}", source)
    return result
