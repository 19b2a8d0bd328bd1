"""The program ``quasilux``: the command line of the same wheel."""

from __future__ import annotations

import signal
import sys

from quasilux import _native


def main() -> int:
    """Run the command line with the words of ``sys.argv`` and return its exit code."""
    # Ctrl-C and a closed pipe end the program as they end one that is not in Python.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    return _native.command_line(["quasilux", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
