"""Scenario `methods`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Length, Speed, kph, m, s

require_api(1)


class Methods(Scenario):
    name = "methods"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        # Holds in all scenarios of a run
        self.limit = self.global_parameter("limit", 50 * kph, unit="kph")
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.share(self.limit)), throughout=True)

    # A method of the scenario becomes a method of its class.
    def share(self, v: Speed, part: float = 0.5) -> Speed:
        return v * part

    # A parameter may be called like a unit, or like a word of Python.
    def longer(self, m_: Length, self_: Length = 1 * m) -> Length:
        return m_ + self_ + 5 * m

    def is_faster(self, a: Vehicle, b: Vehicle) -> bool:
        return a.speed > b.speed

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(self.share(self.limit)), duration=2 * s),
            Wait(
                lambda: self.ego.object_distance(reference=self.other, direction="euclidean")
                > self.longer(1 * m, self_=2 * m)
            ),
            Wait(
                lambda: self.is_faster(self.ego, self.other)
                or self.ego.speed >= self.share(self.limit, part=0.4)
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Methods().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Methods))
