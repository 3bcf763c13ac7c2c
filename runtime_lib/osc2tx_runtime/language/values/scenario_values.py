"""Parameters of a scenario, their draws and constraints; coverage items."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar, Unpack, overload

from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.source_map import SourceMap
from osc2tx_runtime.language.tree.coverage import CoverageItem, ItemOptions
from osc2tx_runtime.language.values.drawing import ATTEMPTS, Drawing
from osc2tx_runtime.language.values.external_methods import external_function
from osc2tx_runtime.language.values.narrowing import Narrowed
from osc2tx_runtime.language.values.parameters import (
    Choice,
    Domain,
    NumberT,
    Range,
    ValueT,
    choose,
    only,
)
from osc2tx_runtime.language.values.walks import Draws
from osc2tx_runtime.language.values.written_units import AnyUnit, Unit, unit_named

AnyT = TypeVar("AnyT")


class ScenarioValues:
    """The values that a scenario chooses before it runs. Generated classes use it in `declare`.

    Args:
        settings: Of the run.
        arguments: Values given by the caller.
        source_map: Positions in the source.
        caller: The values of the main scenario, for an invoked one.
        path: Labels of the invocations to this scenario, for names in settings.
        key: Key of draws besides the seed, independent of the order of invocations.
        times: Seconds that the caller chose for this scenario and those it invokes, by path.

    Attributes:
        settings: Of the run.
        parameters: Values of the parameters, in order; the main scenario also has those of all
            invoked ones.
        parameter_units: Of parameters that have one, likewise.
        has_drawn_values: Whether a value of the main scenario, or of an invoked one, was drawn.
    """

    def __init__(
        self,
        settings: RunSettings,
        arguments: Mapping[str, Any],
        source_map: SourceMap,
        *,
        caller: ScenarioValues | None = None,
        path: str = "",
        key: str = "",
        times: Mapping[str, float] | None = None,
    ) -> None:
        self.settings = settings
        self.parameters: dict[str, Any] = {}
        self.parameter_units: dict[str, Unit] = {}
        self._arguments = arguments
        self._source_map = source_map
        self._composite: set[str] = set()  # lists, ranges and objects that the caller may give
        self._shared: dict[str, Any] = self.parameters if caller is None else caller._shared
        self._roles: dict[int, str] = {}
        self._shared_objects: dict[str, Any] = {} if caller is None else caller._shared_objects
        self._path = path  # empty for the main scenario
        self._key = key
        self._times = times or {}
        self._first: ScenarioValues = self if caller is None else caller._first
        self.has_drawn_values = False
        self._drawing = Drawing(
            settings.draws_from,
            key,
            source_map,
            self.parameters,
            self.parameter_units,
            ATTEMPTS if settings.draws is None else 1,
        )
        self._items: dict[str, CoverageItem] = {}
        self._narrowed: dict[str, Narrowed] = {}

    # --- used by generated classes ---

    @overload
    def parameter(
        self,
        name: str,
        default: Range[NumberT],
        domain: Domain | None = None,
        *,
        unit: AnyUnit = "",
    ) -> NumberT: ...
    @overload
    def parameter(
        self,
        name: str,
        default: Choice[ValueT],
        domain: Domain | None = None,
        *,
        unit: AnyUnit = "",
    ) -> ValueT: ...
    @overload
    def parameter(
        self, name: str, default: ValueT, domain: Domain | None = None, *, unit: AnyUnit = ""
    ) -> ValueT: ...
    def parameter(
        self, name: str, default: Any, domain: Domain | None = None, *, unit: AnyUnit = ""
    ) -> Any:
        """Return the value of a parameter.

        Precedence: argument of the class, `--set`, draw from a range, default. Setting one
        parameter does not change the draws of another. Parameters of invoked scenarios are set by
        path: `--set p1.gap=12`.

        Args:
            name: Name of the parameter.
            default: Value, or the values to draw from, SI units.
            domain: Domain of settings; default: the values to draw from.
            unit: Its unit in the scenario, for messages and reports; `--set` accepts all units of
                its physical type.
        """
        return self._own(name, default, domain, unit)

    def required(
        self, name: str, kind: type[ValueT], domain: Domain | None = None, *, unit: AnyUnit = ""
    ) -> ValueT:
        """Return the value of a parameter that the scenario leaves open.

        Args:
            name: Name of the parameter.
            kind: Type of its value.
            domain: The domain of the value.
            unit: See `parameter`.

        Raises:
            SettingsError: Neither an argument nor `--set` gives a value.
        """
        value: ValueT = self._own(name, kind, domain, unit)
        return value

    def argument(self, name: str, default: AnyT) -> AnyT:
        """Return a list, range or object: that of the caller, else its default.

        Settings cannot state it, so it is not a parameter.
        """
        self._composite.add(name)
        value: AnyT = self._arguments.get(name, self._fixed(name, default))
        return value

    def required_argument(self, name: str, kind: type[AnyT]) -> AnyT:
        """Return a list, range or object that the caller has to give.

        Raises:
            SettingsError: The caller does not give it.
        """
        if name not in self._arguments and name not in self._narrowed:
            path = f"{self._path}.{name}" if self._path else name
            raise SettingsError(
                f"parameter `{path}` has no value, and `--set` cannot give it one:"
                " the invocation of the scenario must"
            )
        value: AnyT = self.argument(name, self._arguments.get(name))  # type: ignore[assignment]
        return value

    @overload
    def global_parameter(
        self,
        name: str,
        default: Range[NumberT],
        domain: Domain | None = None,
        *,
        unit: AnyUnit = "",
    ) -> NumberT: ...
    @overload
    def global_parameter(
        self,
        name: str,
        default: Choice[ValueT],
        domain: Domain | None = None,
        *,
        unit: AnyUnit = "",
    ) -> ValueT: ...
    @overload
    def global_parameter(
        self, name: str, default: ValueT, domain: Domain | None = None, *, unit: AnyUnit = ""
    ) -> ValueT: ...
    def global_parameter(
        self, name: str, default: Any, domain: Domain | None = None, *, unit: AnyUnit = ""
    ) -> Any:
        """Return the value of a global parameter: one for all scenarios of the run."""
        return self._global(name, default, domain, unit)

    def required_global(
        self, name: str, kind: type[ValueT], domain: Domain | None = None, *, unit: AnyUnit = ""
    ) -> ValueT:
        """Return the value of a global parameter without default: `--set` must give it."""
        value: ValueT = self._global(name, kind, domain, unit)
        return value

    def narrow_to(self, name: str, default: Any, domain: Any = None, *, unit: AnyUnit = "") -> None:
        """Narrow a parameter of the base: `self.narrow_to("gap", within(5 * m, 8 * m))`.

        Call it in `declare`, before that of the base. A value that depends on the base is given as
        a function without parameters, which is called when the base declares the parameter.

        Args:
            name: Name of the parameter.
            default: As of `parameter`.
            domain: As of `parameter`.
            unit: As of `parameter`; default: that of the base.
        """
        self._narrowed.setdefault(name, Narrowed(default, domain, unit))

    def fix_to(self, name: str, value: Any) -> None:
        """Fix a parameter or object of the base to one value: `self.fix_to("gap", 8 * m)`.

        As `narrow_to`; a fixed parameter is no longer a parameter.
        """
        self._narrowed.setdefault(name, Narrowed(value, is_fixed=True))

    def keep(self, holds: bool) -> None:
        """Require a relation between values; call it after their declarations.

        If it does not hold, all drawn values are drawn again; after a thousand draws, or without
        drawn values, the scenario cannot run.
        """
        self._drawing.demand(holds)

    @overload
    def external(self, path: str) -> Callable[..., object]: ...
    @overload
    def external(self, path: str, kind: type[AnyT]) -> Callable[..., AnyT]: ...
    def external(self, path: str, kind: type | None = None) -> Callable[..., Any]:
        """Return a user function, `module.function`, if the settings allow it.

        Raises:
            SettingsError: `--allow-external` does not name it.
        """
        place = self._source_map.of_field(path)
        return external_function(path, kind, self.settings.allow_external, place)

    def cover(
        self, name: str, value: Callable[[], Any] | None = None, **options: Unpack[ItemOptions]
    ) -> None:
        """Sample a value at an event, for the coverage of many runs; call it in `declare`.

        Args:
            name: Name of the item in the trace.
            value: Returns the value in SI units; omitted for a cross of `items`.
            **options: See `CoverageItem`; without `at` it is sampled at the end.
        """
        self._items[name] = CoverageItem(name=name, kind="cover", value=value, **options)

    def record(
        self, name: str, value: Callable[[], Any] | None = None, **options: Unpack[ItemOptions]
    ) -> None:
        """Sample a value at an event, for information only; as `cover`."""
        self._items[name] = CoverageItem(name=name, kind="record", value=value, **options)

    # --- used by `Scenario` ---

    def _declare_values(self, declare: Callable[[], None]) -> None:
        """Call `declare` repeatedly until the constraints between drawn values hold.

        Raises:
            ScenarioError: They never hold, or a value cannot be computed.
        """
        members, shared = set(vars(self)), dict(self._shared)
        objects = dict(self._shared_objects)

        def declare_anew() -> None:
            for name in vars(self).keys() - members:
                del self.__dict__[name]
            self.parameters.clear()
            self._narrowed.clear()
            for kept, before in ((self._shared, shared), (self._shared_objects, objects)):
                kept.clear()
                kept.update(before)
            declare()
            self._take_assigned(members)

        self._drawing.settle(declare_anew)

    def _take_assigned(self, inherited: set[str]) -> None:
        """Apply values that a subclass assigns to parameters after `declare` of its base."""
        for name, declared in list(self.parameters.items()):
            attribute = f"{name}_" if name in inherited or name not in vars(self) else name
            value = vars(self).get(attribute, declared)
            if value is not declared:
                path = f"{self._path}.{name}" if self._path else name
                self.parameters[name] = self._shared[path] = value

    def _times_below(self, invocation: str) -> dict[str, float]:
        """Return the times that the caller chose for an invocation of this scenario."""
        above = f"{invocation}."
        found = self._times.items()
        return {path.removeprefix(above): t for path, t in found if path.startswith(above)}

    def _fixed(self, name: str, declared: AnyT) -> AnyT:
        """Return an object as fixed by an inheriting scenario, else as declared."""
        narrowed = self._narrowed.get(name)
        value: AnyT = declared if narrowed is None else narrowed.value
        return value

    def _own(self, name: str, default: Any, domain: Domain | None, unit: AnyUnit) -> Any:
        narrowed = self._narrowed.get(name)
        path = f"{self._path}.{name}" if self._path else name
        generator = self._drawing.draws_for(f"{self._key}/{name}")
        if narrowed is not None:
            if narrowed.is_fixed:
                default = narrowed.value
                if name in self._arguments:  # it has to be equal
                    same = only(default)
                    self._choose(name, path, default, same, generator, self._arguments[name])
                return default
            default, domain, unit = narrowed.value, narrowed.domain, narrowed.unit or unit
        given = self._times.get(name, self._arguments.get(name))
        if unit:
            self.parameter_units[name] = self._first.parameter_units[path] = unit_named(unit)
        value = self._choose(name, path, default, domain, generator, given)
        self.parameters[name] = self._shared[path] = value
        return value

    def _global(self, name: str, default: Any, domain: Domain | None, unit: AnyUnit) -> Any:
        narrowed = self._narrowed.get(name)
        if narrowed is not None:
            if narrowed.is_fixed:
                return narrowed.value
            default, domain, unit = narrowed.value, narrowed.domain, narrowed.unit or unit
        if unit:
            self._first.parameter_units[name] = unit_named(unit)
        if name not in self._shared:
            generator = self._drawing.draws_for(f"global/{name}")
            self._shared[name] = self._choose(name, name, default, domain, generator, None)
        return self._shared[name]

    def _choose(
        self,
        name: str,
        path: str,
        default: Any,
        domain: Domain | None,
        generator: Draws,
        given: Any,
    ) -> Any:
        chosen = self.settings.set
        if self.settings.draws is not None:
            generator = self.settings.draws(path)
        is_open = given is None and path not in chosen
        if isinstance(default if is_open else given, Range | Choice):
            self._drawing.has_drawn = self._first.has_drawn_values = True
        unit = self._first.parameter_units.get(path)
        try:
            return choose(path, default, domain, generator, given=given, settings=chosen, unit=unit)
        except ScenarioError as error:
            error.source = error.source or self._source_map.of_field(name)
            raise
