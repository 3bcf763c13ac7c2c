"""Files that osc2tx and its runtime keep between two runs, in the user's cache folder.

`own_files` only reads files that no other user can have written; `snapshots` keeps plain data
computed by code, valid while that code is unchanged. Damaged and foreign files count as missing:
only speed depends on the cache, and the repair of a simulator after a killed run. The package only
imports the standard library.
"""

from __future__ import annotations

from osc2tx_shared.cache.own_files import cache_folder, evict_oldest, read_own, write_own
from osc2tx_shared.cache.snapshots import Snapshots

__all__ = ["Snapshots", "cache_folder", "evict_oldest", "read_own", "write_own"]
