"""Scenario `comments`.

Head of the file,
in two lines.
beside the import

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, s

require_api(1)


class Comments(Scenario):
    """About the scenario.
    beside the scenario
    """

    name = "comments"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        # Above the map
        # beside the map
        self.road = self.cast(
            "road",
            Map(
                # above the constraint
                # beside the constraint
                map_file="highway.xodr"
            ),
        )
        self.ego = self.cast("ego", Vehicle())  # beside the actor
        # Above a value
        self.v = self.parameter("v", 50 * kph, unit="kph")

        # above an event
        self.seen = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(self.v), throughout=True)

    def behavior(self) -> Behaviour:
        """Above do."""
        return Serial(
            self.name,
            # Above a drive
            # beside the drive
            Until(
                self.ego.drive(
                    # above a modifier
                    speed(self.v),  # beside a modifier
                    duration=(1 * s, 2 * s),
                ),
                # above until
                elapsed(1 * s),
            ),
            self._wait_and_emit_seen(),
            # below the last member of the serial
        )

    def _wait_and_emit_seen(self) -> Behaviour:
        """Above a parallel."""
        return Parallel(
            "parallel",
            # above a member
            Wait(elapsed(1 * s)),  # beside a wait
            Emit(self.seen),
            # below the last member of the parallel
        )

    # below the last member of the scenario
    # At the end of the file.


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Comments().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Comments))
