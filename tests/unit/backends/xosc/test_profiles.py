"""Profiles of tools: one for each name that `--xml-profile` takes."""

from osc2tx.options import DEFAULT_XML_VERSION, ONLY_VERSIONS, XML_PROFILES
from osc2tx.xosc.profiles import PROFILES


def test_every_name_has_a_profile() -> None:
    assert {name: profile.name for name, profile in PROFILES.items()} == {
        name: name for name in XML_PROFILES
    }


def test_the_default_version_is_one_that_the_tool_reads() -> None:
    for name, profile in PROFILES.items():
        assert ONLY_VERSIONS.get(name, DEFAULT_XML_VERSION) in profile.versions, name
