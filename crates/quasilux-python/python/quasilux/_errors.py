"""What is wrong with values that Python code passes."""

from __future__ import annotations

import errno
import os
from typing import TYPE_CHECKING

from quasilux._native import InputError

if TYPE_CHECKING:
    from types import ModuleType


class MissingFileError(InputError, FileNotFoundError):
    """A file that is not there: an `InputError`, as of every file, and a `FileNotFoundError`."""

    def __str__(self) -> str:
        return str(self.args[0])


def missing_file(path: str) -> MissingFileError:
    """Return the error of a file that is not there, with its parts as attributes."""
    message = os.strerror(errno.ENOENT)
    error = MissingFileError(f"{path}: {message}")
    error.file, error.line, error.column, error.message = path, None, None, message
    error.errno, error.filename = errno.ENOENT, path
    return error


def input_error(
    message: str,
    file: str | None = None,
    line: int | None = None,
    column: int | None = None,
) -> InputError:
    """Return an error with its parts as attributes."""
    place = "".join(f"{part}:" for part in (file, line, column) if part is not None)
    error = InputError(f"{place} {message}" if place else message)
    error.file, error.line, error.column, error.message = file, line, column, message
    return error


def optional(module: str, extra: str) -> ModuleType:
    """Import what only some users need.

    Raises
    ------
    ImportError
        Where it is missing, with what to install.
    """
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = module.partition(".")[0]
        message = f"this needs {name}: pip install 'quasilux[{extra}]'"
        raise ImportError(message, name=name) from error
