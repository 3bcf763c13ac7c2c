"""Scenario `top`.

Above the last line of the head.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass

from osc2tx_runtime import (
    Behaviour,
    Event,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    at_most,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Length, kph, m, s

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Part:
    """Struct `part`.

    tag::part[]
    """

    # weight: mass
    size: Length = 2 * m

    # end::part[]


class Top(Scenario):
    """Of the scenario: nothing stands between.

    The second paragraph.
    """

    name = "top"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        # First in its block.

        self.one = self.argument("one", Part())
        # touches the field above only

        self.ego = self.cast("ego", Vehicle())

        self.other = self.cast("other", Vehicle())
        # above a value
        self.v = self.parameter("v", 30 * kph, at_most(50 * kph), unit="kph")
        self.over = Event()

        self.keep(self.v < 50 * kph)
        # keep(it > 10kph)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.v), throughout=True)
        self.place(self.other, speed(self.v), throughout=True)

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive(
                speed(self.v)
                # speed(99kph)
            ),
            self.other.drive(
                # Above a modifier.
                # beside a bracket
                # within brackets
                # behind an argument
                speed(self.v)
                # lane(2)
            ),
            # touches the drive above only
            self._wait_serial(),
            duration=1 * s,
            # At the end of the parallel.
        )

    def _wait_serial(self) -> Behaviour:
        """Above a serial."""
        return Until(
            Serial(
                "serial",
                Wait(elapsed(1 * s)),
                # emit over
            ),
            # Above the `with` of the serial.
            # until @over
            elapsed(1 * s),
        )

    # At the end of the scenario.
    # end::top[]


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Top().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Top))
