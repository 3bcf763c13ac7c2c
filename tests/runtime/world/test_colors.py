"""Colors by name are those of the library."""

from typing import get_args

from osc2tx_runtime.enums import Color
from osc2tx_runtime.world.actor_dimensions import RGB


def test_each_color_of_the_library_has_values() -> None:
    assert RGB.keys() == set(get_args(Color)) - {"other"}
