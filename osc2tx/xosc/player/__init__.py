"""Plays documents by the text of the standard alone, with independent laws of motion.

It shares nothing with the back end that writes documents but the model of their elements, and with
the runtime only the reader of maps: its results are independent evidence about both.

- `storyboard`: acts and events, from instant to instant; begin here
- `reading`: how tools read documents otherwise than the standard
- `conditions`, `distances`: triggers, and what they measure
- `actions` with `speeds`, `across`, `ways`: running actions on the bodies, in `scene`
- `bodies`, `places`: entities on their map; `courses`: values over time
"""

from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.reading import BY_THE_STANDARD, Reading
from osc2tx.xosc.player.storyboard import Evaluator, map_of

__all__ = ["BY_THE_STANDARD", "Evaluator", "Reading", "Unplayable", "map_of"]
