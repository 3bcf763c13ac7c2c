"""Scenarios `event`, `quoting`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Unit,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import position, speed
from osc2tx_runtime.units import kph, s

require_api(1)

# Units that the scenario declares
furlong = 201.168


class EventScenario(Scenario):
    """Class names and keywords of Python must not disturb."""

    name = "event"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.lambda_ = self.cast("lambda", Vehicle())
        self.place_ = self.cast("place", Vehicle())
        self.two_words = self.parameter("two words", 10 * kph, unit="kph")
        self.name_ = self.parameter("name", 2 * furlong, unit=Unit("furlong", furlong))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.lambda_, speed(self.two_words), throughout=True)
        self.place(self.place_, position(self.name_, ahead_of=self.lambda_))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.class_(),
            self.behavior_(),
        )

    def class_(self) -> Behaviour:
        return Serial(
            "class",
            self.lambda_.drive(speed(self.two_words), duration=1 * s),
        )

    def behavior_(self) -> Behaviour:
        return Serial(
            "behavior",
            self.place_.drive(duration=1 * s),
        )


class Quoting(Scenario):
    name = "quoting"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="high\"way{{ 1 }}'''.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def behavior(self) -> Behaviour:
        """a comment with \"\"\" and \\ and {% raw %}"""
        return self.ego.drive(duration=1 * s)


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Quoting().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(EventScenario, Quoting))
