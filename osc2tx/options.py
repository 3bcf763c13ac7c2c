"""What can be chosen about a compilation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Standard: TypeAlias = Literal["2.1", "2.2"]
Dialect: TypeAlias = Literal["asam", "carla"]
OneOfPolicy: TypeAlias = Literal["race", "first", "seeded"]
ProductName: TypeAlias = Literal["ast", "model", "ir", "py"]

STANDARDS: tuple[Standard, ...] = ("2.1", "2.2")
DIALECTS: tuple[Dialect, ...] = ("asam", "carla")
ONE_OF_POLICIES: tuple[OneOfPolicy, ...] = ("race", "first", "seeded")
PRODUCT_NAMES: tuple[ProductName, ...] = ("ast", "model", "ir", "py")  # of `--emit`


@dataclass(frozen=True, slots=True)
class CompileOptions:
    """The options of one compilation; they are all that output depends on besides the source.

    Attributes:
        standard: Version of OpenSCENARIO DSL.
        dialect: The language as the standard has it, or as a simulator's users write it.
        one_of: Which member of a `one_of` counts.
    """

    standard: Standard = "2.1"
    dialect: Dialect = "asam"
    one_of: OneOfPolicy = "race"
