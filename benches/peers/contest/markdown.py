"""Markdown of pages that are written by programs."""

import textwrap


def document(parts: list[str]) -> str:
    """Parts one after the other; prose at 100 columns."""
    return "\n\n".join(map(_wrapped, "\n".join(parts).split("\n\n")))


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def _wrapped(block: str) -> str:
    """Prose at 100 columns; tables, headings and commands as they are."""
    if block.startswith("#") and "\n" in block:
        heading, rest = block.split("\n", 1)
        return f"{heading}\n{_wrapped(rest)}"
    if block.lstrip("\n").startswith(("|", "#", "!", "    ")):
        return block
    end = "\n" if block.endswith("\n") else ""
    return textwrap.fill(block, 100, break_long_words=False, break_on_hyphens=False) + end
