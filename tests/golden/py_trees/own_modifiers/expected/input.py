"""Scenario `demo`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
    within,
)
from osc2tx_runtime.modifiers import keep_lane, lane, position, speed
from osc2tx_runtime.units import Speed, m, mps, s

require_api(1)


def gentle(*, top: Speed = 8 * mps) -> list[speed]:
    """Modifier `gentle`."""
    return [
        speed(top),
    ]


def calm(
    *,
    # keep(it == 6mps)
    top: Speed,
) -> list[keep_lane | speed]:
    """Modifier `calm`."""
    return [
        # as it was
        keep_lane(),
        speed(top),
    ]


def easy(*, top: Speed = 8 * mps, side: int) -> list[lane | speed]:
    """Modifier `easy`."""
    # keep(top <= 10mps)
    return [
        # in the end
        lane(side, at="end"),
        speed(top + 1 * mps),
    ]


class Demo(Scenario):
    name = "demo"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.slow_easy_side = self.parameter("slow.easy.side", within(1, 2))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, speed(10 * mps), lane(2), position(50 * m))

    def behavior(self) -> Behaviour:
        self.override("slow", "quick")
        return Serial(
            self.name,
            self.ego.drive("a", speed(10 * mps), duration=2 * s),
            self.ego.drive("b", *gentle(), duration=2 * s),
            self.ego.drive("c", *gentle(top=7 * mps), duration=2 * s),
            self.ego.drive("d", *calm(top=6 * mps), duration=2 * s),
            self._ego_slow_and_w(),
        )

    def _ego_slow_and_w(self) -> Behaviour:
        """all at once."""
        return Parallel(
            "ego: parallel",
            self.ego.drive(
                "slow",
                # easily
                *easy(side=self.slow_easy_side),
                duration=3 * s,
            ),
            self.w(),
        )

    def w(self) -> Behaviour:
        return Serial(
            "w",
            Wait(elapsed(1 * s)),
            self.ego.change_speed("quick", target=10 * mps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Demo().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Demo))
