"""The process that reads a model: see `quasilux.ifc._isolated`."""

from __future__ import annotations

import os
import pickle
import sys
import threading
from typing import Any

from quasilux import InputError
from quasilux._errors import MissingFileError
from quasilux.ifc import _care, _load, _survey

_TASKS = {"load": _load.load_here, "survey": _survey.survey_here}


def main(folder: str) -> None:
    """Run the task that stands in a folder, and put its result beside it."""
    with open(os.path.join(folder, "job"), "rb") as file:
        task, arguments, keywords, care = pickle.load(file)
    _care.CARE.__dict__.update(care.__dict__)
    beside = os.path.join(folder, "unfinished")
    with open(beside, "wb") as file:
        pickle.dump(_told(task, arguments, keywords), file)
    os.replace(beside, os.path.join(folder, "result"))


def _told(task: str, arguments: Any, keywords: Any) -> tuple[str, Any]:
    try:
        return "result", _TASKS[task](*arguments, **keywords)
    except InputError as error:
        is_missing = isinstance(error, MissingFileError)
        return "input", (error.message, error.file, error.line, error.column, is_missing)
    except ImportError as error:
        return "import", str(error)
    except MemoryError:
        path = os.fsdecode(arguments[0])
        return "input", ("not enough memory for the model", path, None, None, False)
    except Exception as error:
        # What a strange file does to code that expects a sound one.
        message = f"a model that cannot be read: {type(error).__name__}: {error}"
        return "input", (message, os.fsdecode(arguments[0]), None, None, False)


def run(folder: str) -> None:
    """Run the task as a whole process: with bounded memory, and no longer than its parent."""
    _bound_memory()
    threading.Thread(target=_end_with_parent, daemon=True).start()
    main(folder)
    # Without what native code does at the end of a process.
    os._exit(0)


def _end_with_parent() -> None:
    """Wait for the end of standard input, which its parent holds open."""
    sys.stdin.buffer.read()
    os._exit(1)


def _bound_memory() -> None:
    """Refuse memory beyond that of the machine, lest other processes be ended for it."""
    if sys.platform != "linux":
        return
    import resource

    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    most = memory if hard == resource.RLIM_INFINITY else min(memory, hard)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))
