"""Extension of Griffe: running text of docstrings as Markdown.

Examples before the first section become code, as they are in sections, and simple tables of
reStructuredText become tables.
"""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

from griffe import Extension

if TYPE_CHECKING:
    from griffe import Module, Object


class Docstrings(Extension):
    """Changes all docstrings."""

    def on_object(self, *, obj: Object, **kwargs: Any) -> None:
        """Change the docstring of one object."""
        if obj.docstring is not None:
            obj.docstring.value = as_markdown(obj.docstring.value)

    def on_package(self, *, pkg: Module, **kwargs: Any) -> None:
        """Change the docstring of the package, which is no object of another one."""
        self.on_object(obj=pkg)


def as_markdown(text: str) -> str:
    """Return a docstring with its running text changed."""
    lines = text.split("\n")
    underlines = (number for number, line in enumerate(lines) if line and set(line) == {"-"})
    # The heading of the first section stands above its underline.
    end = next(underlines, len(lines) + 1) - 1
    changed: list[str] = []
    for is_blank, paragraph in groupby(lines[:end], lambda line: not line.strip()):
        block = list(paragraph)
        if is_blank:
            changed += block
        elif block[0].startswith(">>>"):
            changed += ["```pycon", *block, "```"]
        elif set(block[0]) == {"=", " "}:
            changed += table(block)
        else:
            changed += block
    return "\n".join([*changed, *lines[end:]])


def table(lines: list[str]) -> list[str]:
    """Return a table of two columns without a heading."""
    at = lines[0].rindex(" ") + 1
    rows = [f"| {line[:at].strip()} | {line[at:].strip()} |" for line in lines[1:-1]]
    return ["| | |", "|---|---|", *rows]
