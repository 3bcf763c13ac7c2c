"""Garbage of large trees: collected between programs, never while one grows."""

import gc
import weakref
from collections.abc import Iterator

import pytest

from osc2tx.support.recursion import MOST_UNSEEN, allowing_deep_trees


class Tree:
    """A cyclic structure that only a collection finds."""

    def __init__(self, size: int) -> None:
        self.itself = self
        self.nodes: list[list[object]] = [[] for _ in range(size)]


@pytest.fixture(autouse=True)
def collecting() -> Iterator[None]:
    gc.collect()
    gc.enable()
    with allowing_deep_trees():
        Tree(MOST_UNSEEN + 1)
    yield
    with allowing_deep_trees():  # nothing is left to those that come
        pass


def test_trees_of_an_earlier_program_are_collected_before_the_next_one() -> None:
    with allowing_deep_trees():
        tree = Tree(MOST_UNSEEN + 1)
        found = weakref.ref(tree)
        del tree
        assert found() is not None, "nothing is collected while trees grow"
    with allowing_deep_trees():
        assert found() is None


def test_few_objects_wait() -> None:
    with allowing_deep_trees():  # what the fixture left is collected
        found = weakref.ref(Tree(100))
    with allowing_deep_trees():
        assert found() is not None


def test_a_room_leaves_collection_as_it_was() -> None:
    gc.disable()
    with allowing_deep_trees(), allowing_deep_trees():
        assert not gc.isenabled()
    assert not gc.isenabled()
    gc.enable()
    with allowing_deep_trees():
        assert not gc.isenabled()
    assert gc.isenabled()
