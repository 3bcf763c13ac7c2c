"""Names of files and folders that every operating system accepts."""

from __future__ import annotations

import re

# Names of devices on Windows, with any suffix.
_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³])(\..*)?", re.IGNORECASE | re.DOTALL)
_FORBIDDEN = re.compile(r'[<>:"|?*\\\x00-\x1f\x7f]')


def is_portable(name: str) -> bool:
    """Return whether a file or folder can have this name on every system."""
    ends_well = not name.endswith((".", " "))
    return ends_well and not _FORBIDDEN.search(name) and not _DEVICE.fullmatch(name)
