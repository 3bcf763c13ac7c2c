"""Movable objects, except vehicles (DSL 8.7.4 to 8.7.6, 8.7.9, 8.7.10)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Unpack

from osc2tx_runtime.domain.methods import AnimalMethods, MovableObjectMethods, PersonMethods
from osc2tx_runtime.domain.objects.part_defaults import default_infrastructure, default_role
from osc2tx_runtime.domain.objects.physical_objects import ObjectFields, PhysicalObject
from osc2tx_runtime.enums import IntendedInfrastructure, TrafficParticipantRole
from osc2tx_runtime.errors import ScenarioError

Infrastructure = Sequence[IntendedInfrastructure] | Mapping[int, IntendedInfrastructure]


class MovableObject(PhysicalObject, MovableObjectMethods):
    """An object that may move."""

    kinds = ("movable_object", *PhysicalObject.kinds)


class ParticipantFields(ObjectFields, total=False):
    """Keywords of `TrafficParticipant`."""

    intended_infrastructure: Infrastructure | None
    role: TrafficParticipantRole | None


class TrafficParticipant(MovableObject):
    """A movable object that takes part in traffic.

    Args:
        intended_infrastructure: The infrastructure it moves on, or single elements of that list;
            default: that of its kind or category.
        role: The externally visible role; default: the role of the model, if it has one.
        **fields: As of `PhysicalObject`.
    """

    kinds = ("traffic_participant", *MovableObject.kinds)

    def __init__(
        self,
        *,
        intended_infrastructure: Infrastructure | None = None,
        role: TrafficParticipantRole | None = None,
        **fields: Unpack[ObjectFields],
    ) -> None:
        super().__init__(**fields)
        self._infrastructure = intended_infrastructure
        self._role = role

    @property
    def intended_infrastructure(self) -> list[IntendedInfrastructure]:
        """The infrastructure it moves on, in words of OpenDRIVE lane types."""
        said = self._infrastructure or {}
        if not isinstance(said, Mapping):
            return list(said)
        found = list(default_infrastructure(self.category or self.library_kind))
        for number, kind in sorted(said.items()):
            if number > len(found):
                raise ScenarioError(
                    f"intended_infrastructure[{len(found)}] of {self.id} is not stated", self.source
                )
            found[number : number + 1] = [kind]
        return found

    @property
    def role(self) -> TrafficParticipantRole:
        """The externally visible role."""
        return self._said("role", self._role or default_role(self.model))


class Person(TrafficParticipant, PersonMethods):
    """A pedestrian; walks straight ahead, independent of lanes."""

    kinds = ("person", *TrafficParticipant.kinds)


class Animal(TrafficParticipant, AnimalMethods):
    """An animal; moves like a pedestrian."""

    kinds = ("animal", *TrafficParticipant.kinds)
