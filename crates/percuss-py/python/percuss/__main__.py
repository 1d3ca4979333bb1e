"""The program ``percuss``, as the wheel installs it: ``python -m percuss`` is the same."""

import signal
import sys

from . import _percuss


def main() -> int:
    """Runs the command line of this process; returns its exit code."""
    # Python only notes Ctrl-C until it runs again, which it does not before the command has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _percuss.command(["percuss", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
