"""Bytes of measurement files: where they come from."""

from __future__ import annotations

import errno
import os
import stat
from dataclasses import dataclass
from typing import Protocol, Union

from quasilux._errors import input_error, missing_file
from quasilux._whole_file import write_whole as write_whole


class BinaryReader(Protocol):
    """A file that is open for reading in binary mode."""

    def read(self, size: int, /) -> bytes: ...


Path = Union[str, "os.PathLike[str]"]
Source = Union[str, "os.PathLike[str]", bytes, bytearray, memoryview, BinaryReader]


@dataclass(frozen=True)
class Contents:
    """The bytes of a file, and what messages call it."""

    data: bytes
    file: str
    path: str | None


def contents(source: Source, *, name: str | None, most_bytes: int) -> Contents:
    """Read a path, an open file or a buffer, but never more than ``most_bytes``.

    Raises
    ------
    OSError
        When the file cannot be read.
    TypeError
        When the source is none of these, or an open file is in text mode.
    InputError
        When there are more bytes.
    """
    path: str | None = None
    if isinstance(source, bytes):
        data, called = source, "<bytes>"
    elif isinstance(source, (bytearray, memoryview)):
        data, called = bytes(source), "<bytes>"
    elif isinstance(source, (str, os.PathLike)):
        path = os.fsdecode(source)
        called = path
        if "\n" in path or "\0" in path:
            raise ValueError("found a text of several lines; expected a path, or bytes")
        try:
            with open(path, "rb") as file:
                data = _read(file, most_bytes)
        except FileNotFoundError:
            raise missing_file(path) from None
    elif callable(getattr(source, "read", None)):
        called = getattr(source, "name", None)
        called = called if isinstance(called, str) else "<file>"
        data = _read(source, most_bytes)
    else:
        kind = type(source).__name__
        raise TypeError(f"found {kind}; expected a path, bytes or a file in binary mode")
    called = printable(name if name is not None else called)
    if len(data) > most_bytes:
        message = f"the file is larger than {most_bytes >> 20} MiB"
        raise input_error(message, called)
    return Contents(data, called, path)


def regular_file(path: str, *, most_bytes: int) -> Contents:
    """Read a file that another file names: no device and no pipe, which may have no end.

    Raises
    ------
    OSError
        When it cannot be read, is no regular file or is larger.
    """
    information = os.stat(path)
    if not stat.S_ISREG(information.st_mode):
        raise OSError(errno.EINVAL, "not a regular file", path)
    if information.st_size > most_bytes:
        raise OSError(errno.EFBIG, f"the file is larger than {most_bytes >> 20} MiB", path)
    with open(path, "rb") as file:
        return Contents(_read(file, most_bytes), printable(path), path)


def _read(file: BinaryReader, most_bytes: int) -> bytes:
    pieces: list[bytes] = []
    left = most_bytes + 1
    while left > 0:
        piece = file.read(left)
        if isinstance(piece, str):
            raise TypeError('found a file in text mode; expected one opened with "rb"')
        if not piece:
            break
        pieces.append(piece)
        left -= len(piece)
    return pieces[0] if len(pieces) == 1 else b"".join(pieces)


def extension(path: Path) -> str:
    """The extension of a name in small letters, with its point."""
    return os.path.splitext(os.fsdecode(path))[1].lower()


def printable(text: str) -> str:
    """Text that can be encoded: names of files may hold any bytes."""
    return text.encode("utf-8", "replace").decode("utf-8")
