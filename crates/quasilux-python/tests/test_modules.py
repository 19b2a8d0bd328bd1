"""Modules of the package: none of them needs, directly or by others, one that needs it."""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import quasilux

PACKAGE = Path(quasilux.__file__).parent


def imports(source: str, known: set[str]) -> set[str]:
    """The modules of the package that a source imports: in functions and for types alone, too."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            within = {f"{node.module}.{alias.name}" for alias in node.names}
            # What is imported from a package is most often one of its modules.
            found |= (within & known) or {node.module}
    return found & known


def modules() -> dict[str, str]:
    """The source of each module by its name; packages hand out what their modules have."""
    found: dict[str, str] = {}
    for path in PACKAGE.rglob("*.py"):
        if path.name != "__init__.py":
            name = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
            found[name] = path.read_text(encoding="utf-8")
    return found


def order(sources: dict[str, str]) -> list[str]:
    """Modules, each behind those that it imports."""
    graph = {name: imports(source, set(sources)) for name, source in sources.items()}
    return list(TopologicalSorter(graph).static_order())


def test_no_module_needs_one_that_needs_it() -> None:
    found = order(modules())
    assert len(found) > 40
    assert found.index("quasilux._figure") < found.index("quasilux._result")


def test_circles_are_found() -> None:
    one = "def f():\n    from quasilux import _two\n"
    two = "if TYPE_CHECKING:\n    from quasilux._one import One\n"
    with pytest.raises(CycleError):
        order({"quasilux._one": one, "quasilux._two": two})
