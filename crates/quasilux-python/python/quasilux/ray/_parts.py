"""What blocks gave, on disk: a new driver goes on from there."""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path

_MAGIC = b"quasilux-block/1\n"
_DIGEST_BYTES = 32


class Parts:
    """A folder of what blocks of one run gave, one file a block.

    A file is there whole or not at all, and one that was damaged counts as missing.
    Several drivers may share a folder: what they write is the same.

    Parameters
    ----------
    directory
        Where the folders of all runs are.
    run
        What tells this run from others: the digest of its program, scene and settings.
    """

    def __init__(self, directory: str | os.PathLike[str], run: str) -> None:
        self._folder = Path(directory) / run
        self._folder.mkdir(parents=True, exist_ok=True)

    @property
    def folder(self) -> Path:
        """The folder of this run."""
        return self._folder

    def read(self, frame: str, start: int, end: int) -> bytes | None:
        """What the block ``start`` to ``end`` of a frame gave, if it is known."""
        try:
            content = self._path(frame, start, end).read_bytes()
        except OSError:
            return None
        digest, payload = content[:_DIGEST_BYTES], content[_DIGEST_BYTES:]
        return payload if _digest(payload) == digest else None

    def write(self, frame: str, start: int, end: int, payload: bytes) -> None:
        """Keep what a block gave.

        Raises
        ------
        OSError
            When the folder cannot be written to.
        """
        handle, name = tempfile.mkstemp(dir=self._folder, prefix=".new-")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(_digest(payload))
                file.write(payload)
            os.replace(name, self._path(frame, start, end))
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise

    def _path(self, frame: str, start: int, end: int) -> Path:
        return self._folder / f"{frame}-{start}-{end}.block"


def _digest(payload: bytes) -> bytes:
    return hashlib.sha256(_MAGIC + payload).digest()
