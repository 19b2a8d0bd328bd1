"""How geometry is made: all at once, or product by product where the kernel is known to break."""

from __future__ import annotations

import os
from dataclasses import dataclass, field


@dataclass
class Care:
    """What a process that makes geometry has to keep to.

    Attributes
    ----------
    progress : str
        A file for the number of the product that is being made; empty for none.
    one_by_one : bool
        Whether products are made one after another, each noted before it begins.
    skipped : dict of int to str
        Numbers of products at which the kernel broke, and how.
    """

    progress: str = ""
    one_by_one: bool = False
    skipped: dict[int, str] = field(default_factory=dict)

    def note(self, number: int) -> None:
        """Note which product comes next."""
        if self.progress:
            beside = f"{self.progress}.new"
            with open(beside, "w", encoding="ascii") as file:
                file.write(str(number))
            os.replace(beside, self.progress)

    def end(self) -> None:
        """Note that no product is being made."""
        if self.progress and os.path.exists(self.progress):
            os.unlink(self.progress)


# That of this process.
CARE = Care()
