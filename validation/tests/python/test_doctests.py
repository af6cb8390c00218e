"""What the documentation shows is so."""

import doctest
import importlib
import pkgutil

import pytest
import treejet

NAMES = [m.name for m in pkgutil.iter_modules(treejet.__path__) if m.name != "__main__"]


@pytest.mark.parametrize("name", NAMES)
def test_examples_in_the_documentation_hold(name):
    assert doctest.testmod(importlib.import_module(f"treejet.{name}")).failed == 0


def test_there_are_such_examples():
    modules = [importlib.import_module(f"treejet.{name}") for name in NAMES]
    assert sum(bool(t.examples) for m in modules for t in doctest.DocTestFinder().find(m)) >= 15
