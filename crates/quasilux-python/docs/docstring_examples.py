"""Extension of Griffe: examples in the running text of docstrings are code, as in sections."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from griffe import Extension

if TYPE_CHECKING:
    from griffe import Object


class DocstringExamples(Extension):
    """Puts fences around lines that begin with ``>>>`` before the first section."""

    def on_object(self, *, obj: Object, **kwargs: Any) -> None:
        """Change the docstring of one object."""
        if obj.docstring is not None:
            obj.docstring.value = with_fences(obj.docstring.value)


def with_fences(text: str) -> str:
    """Return a docstring with its examples in fences."""
    lines = text.split("\n")
    underlines = (number for number, line in enumerate(lines) if line and set(line) == {"-"})
    # The heading of the first section stands above its underline.
    end = next(underlines, len(lines) + 1) - 1
    fenced: list[str] = []
    is_example = False
    for line in lines[:end]:
        if is_example and not line.strip():
            fenced.append("```")
            is_example = False
        elif not is_example and line.startswith(">>>"):
            fenced.append("```pycon")
            is_example = True
        fenced.append(line)
    if is_example:
        fenced.append("```")
    return "\n".join([*fenced, *lines[end:]])
