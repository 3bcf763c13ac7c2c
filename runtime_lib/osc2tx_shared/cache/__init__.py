"""What osc2tx and its runtime keep between two runs, in the user's cache folder.

`own_files` reads only what the user alone can have written; `snapshots` keeps what some code made
as plain data, as long as that code is the same. What is missing, damaged or of others counts as not
being there: nothing depends on the cache but time. The package imports nothing but the standard
library.
"""

from __future__ import annotations

from osc2tx_shared.cache.own_files import cache_folder, forget_the_oldest, read_own, write_own
from osc2tx_shared.cache.snapshots import Snapshots

__all__ = ["Snapshots", "cache_folder", "forget_the_oldest", "read_own", "write_own"]
