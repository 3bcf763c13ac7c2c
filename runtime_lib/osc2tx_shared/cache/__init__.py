"""Files that osc2tx and its runtime keep between two runs, in the user's cache folder.

`own_files` reads only files that the user alone can have written; `snapshots` keeps plain data made
by code, as long as that code is the same. Missing, damaged and foreign files count as missing:
nothing depends on the cache but time, and the repair of a simulator after a run that was killed.
The package imports nothing but the standard library.
"""

from __future__ import annotations

from osc2tx_shared.cache.own_files import cache_folder, forget_the_oldest, read_own, write_own
from osc2tx_shared.cache.snapshots import Snapshots

__all__ = ["Snapshots", "cache_folder", "forget_the_oldest", "read_own", "write_own"]
