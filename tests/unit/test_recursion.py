"""Garbage of large trees: collected between programs, never while one grows."""

import gc
import weakref
from collections.abc import Iterator

import pytest

from osc2tx.support.recursion import MOST_UNSEEN, room_for_trees


class Tree:
    """A cyclic structure that only a collection finds."""

    def __init__(self, size: int) -> None:
        self.itself = self
        self.nodes: list[list[object]] = [[] for _ in range(size)]


@pytest.fixture(autouse=True)
def collecting() -> Iterator[None]:
    gc.collect()
    gc.enable()
    with room_for_trees():
        Tree(MOST_UNSEEN + 1)
    yield
    with room_for_trees():  # nothing is left to those that come
        pass


def test_trees_of_an_earlier_program_are_collected_before_the_next_one() -> None:
    with room_for_trees():
        tree = Tree(MOST_UNSEEN + 1)
        found = weakref.ref(tree)
        del tree
        assert found() is not None, "nothing is collected while trees grow"
    with room_for_trees():
        assert found() is None


def test_few_objects_wait() -> None:
    with room_for_trees():  # what the fixture left is collected
        found = weakref.ref(Tree(100))
    with room_for_trees():
        assert found() is not None


def test_a_room_leaves_collection_as_it_was() -> None:
    gc.disable()
    with room_for_trees(), room_for_trees():
        assert not gc.isenabled()
    assert not gc.isenabled()
    gc.enable()
    with room_for_trees():
        assert not gc.isenabled()
    assert gc.isenabled()
