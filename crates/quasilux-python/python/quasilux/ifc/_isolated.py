"""Reading in a process of its own: the kernel is native code, and files break it.

What ends that process without a result is told as an error, or, where a product is to blame, as a
finding: the geometry is then made product by product, without those that broke it.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import tempfile
import time
from typing import Any

from quasilux._errors import MissingFileError, input_error
from quasilux.ifc._care import Care

# Seconds for a whole model at once, for one product, and for a model product by product.
ALL_S, ONE_S, MOST_S = 900.0, 60.0, 3600.0
_MOST_SKIPPED = 20
# The folder that a command runs in is no place for modules.
_CODE = (
    "import sys; sys.path[:] = [part for part in sys.path if part]; "
    "from quasilux.ifc._child import run; run(sys.argv[1])"
)
_LOOK_S = 0.05


def isolated(task: str, arguments: tuple[Any, ...], keywords: dict[str, Any], name: str) -> Any:
    """Run a task of `quasilux.ifc._child` in another process, and return its result.

    Raises
    ------
    InputError
        As the task does, and when the process ends without a result.
    """
    with tempfile.TemporaryDirectory() as folder:
        care = Care(progress=os.path.join(folder, "progress"))
        begin = time.monotonic()
        while True:
            how = _run(folder, (task, arguments, keywords, care), begin + MOST_S)
            result = os.path.join(folder, "result")
            if not how and os.path.exists(result):
                with open(result, "rb") as file:
                    return _result(pickle.load(file))
            product = _product(care.progress)
            is_known = care.one_by_one and product is not None
            if is_known:
                care.skipped[product or 0] = how
            is_late = time.monotonic() - begin > MOST_S
            if len(care.skipped) > _MOST_SKIPPED or is_late or (care.one_by_one and not is_known):
                message = f"ifcopenshell {how or 'ended without a result'}; export the model again"
                raise input_error(message, name)
            care.one_by_one = True


def _run(folder: str, job: Any, end: float) -> str:
    """Run the process; how it ended, empty where it ended well."""
    for name in ("result", "progress"):
        if os.path.exists(os.path.join(folder, name)):
            os.unlink(os.path.join(folder, name))
    with open(os.path.join(folder, "job"), "wb") as file:
        pickle.dump(job, file)
    care: Care = job[3]
    path = os.pathsep.join(os.path.abspath(part) for part in sys.path if part)
    process = subprocess.Popen(
        [sys.executable, "-c", _CODE, folder],
        # Its end is that of this process, which the other one waits for.
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": path},
    )
    try:
        return _waited(process, care, end)
    finally:
        if process.poll() is None:
            process.kill()
        process.wait()
        if process.stdin is not None:
            process.stdin.close()


def _waited(process: subprocess.Popen[bytes], care: Care, end: float) -> str:
    changed = time.monotonic()
    seen: int | None = None
    while process.poll() is None:
        time.sleep(_LOOK_S)
        product = _product(care.progress) if care.one_by_one else None
        if product != seen:
            seen, changed = product, time.monotonic()
        most = ONE_S if care.one_by_one and seen is not None else ALL_S
        if time.monotonic() - changed > most:
            return f"took more than {most:.0f} s"
        if time.monotonic() > end:
            return f"took more than {MOST_S:.0f} s in all"
    code = process.returncode
    if code == 0:
        return ""
    if code < 0:
        return f"broke off ({signal.Signals(-code).name})"
    return f"ended with code {code}"


def _product(progress: str) -> int | None:
    try:
        with open(progress, encoding="ascii") as file:
            return int(file.read())
    except (OSError, ValueError):
        return None


def _result(told: tuple[str, Any]) -> Any:
    kind, value = told
    if kind == "result":
        return value
    if kind == "import":
        raise ImportError(value, name="ifcopenshell")
    message, file, line, column, is_missing = value
    if is_missing:
        error = MissingFileError(f"{file}: {message}")
        error.file, error.line, error.column, error.message = file, line, column, message
        raise error
    raise input_error(message, file, line, column)
