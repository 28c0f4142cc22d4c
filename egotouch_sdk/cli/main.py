"""Entry point of the command `egotouch`."""

from __future__ import annotations

import argparse
import os
import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn, TextIO

from egotouch_sdk import __version__
from egotouch_sdk.errors import EgoTouchError, MissingExtraError

#: Exit codes: argparse itself uses 2 for a wrong command line; 130 is 128 + SIGINT as in every shell.
EXIT_ERROR = 1
EXIT_INTERRUPTED = 130

#: Subcommands in the order of the help, each a module with `add_parser(subparsers)`.
COMMANDS = (
    "egotouch_sdk.cli.demo",
    "egotouch_sdk.cli.run",
    "egotouch_sdk.cli.record",
    "egotouch_sdk.cli.replay",
    "egotouch_sdk.cli.simulate",
    "egotouch_sdk.cli.serve",
    "egotouch_sdk.cli.debug_events",
    "egotouch_sdk.cli.hands",
    "egotouch_sdk.cli.estimate",
    "egotouch_sdk.cli.bench",
    "egotouch_sdk.cli.config",
    "egotouch_sdk.cli.doctor",
    "egotouch_sdk.evaluation.cli",
    "egotouch_sdk.synthetic.cli",
    "egotouch_sdk.training.cli",
)

#: Import names of optional packages, by the extra that brings them.
EXTRA_PACKAGES = {
    "cluster": ("ray",),
    "debug": ("rich", "textual"),
    "evaluation": ("pingouin", "pyarrow"),
    "lan": ("cryptography", "segno"),
    "mdns": ("zeroconf",),
    "recording": ("lz4", "mcap", "zstandard"),
    "simulate": ("yaml",),
    "synthetic": ("av", "drjit", "mitsuba", "pygltflib", "scipy"),
    "train": ("lightning", "onnx", "torch"),
}

EXAMPLES = """\
examples:
  egotouch demo                      touches on skin without a camera
  egotouch run 0 --show              the first camera, with a live view in the browser
  egotouch run clip.mp4 --json       one JSON object per touch event
  egotouch doctor                    what is installed, what is wrong, how to mend it
"""


class _Parser(argparse.ArgumentParser):
    """Errors in the same form as all others."""

    def error(self, message: str) -> NoReturn:
        """Print one line and the way to the help; exit code 2."""
        sys.stderr.write(f"egotouch: error: {message}. See: {self.prog} --help\n")
        raise SystemExit(2)


def build_parser() -> argparse.ArgumentParser:
    """The whole command line; subcommands set `handler`, a function from the parsed arguments to an exit code."""
    parser = _Parser(
        prog="egotouch",
        description="Touch on bare skin from any RGB camera.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"egotouch {__version__}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, parser_class=_Parser)
    for module in COMMANDS:
        import_module(module).add_parser(subparsers)
    return parser


def _show_warning(
    message: Warning | str, category: type[Warning], filename: str, lineno: int, file: TextIO | None = None, line: str | None = None
) -> None:
    del category, filename, lineno, file, line
    sys.stderr.write(f"egotouch: warning: {message}\n")


def _explained(error: ModuleNotFoundError | OSError) -> str:
    """A missing optional package or a file that cannot be used, in one line with the next step; anything else is a defect."""
    if isinstance(error, OSError):
        return f"{error.strerror or error}{f': {error.filename}' if error.filename else ''}"
    for extra, packages in EXTRA_PACKAGES.items():
        if error.name and error.name.partition(".")[0] in packages:
            return str(MissingExtraError(f"this command ({error.name})", extra))
    raise error


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; every `EgoTouchError` becomes one line on stderr."""
    options = build_parser().parse_args(arguments)
    with warnings.catch_warnings():
        warnings.showwarning = _show_warning
        warnings.simplefilter("always", UserWarning)
        try:
            return int(options.handler(options))
        except EgoTouchError as error:
            sys.stderr.write(f"egotouch: error: {error}\n")
            return EXIT_ERROR
        except BrokenPipeError:
            raise
        except (ModuleNotFoundError, OSError) as error:
            sys.stderr.write(f"egotouch: error: {_explained(error)}\n")
            return EXIT_ERROR
        except KeyboardInterrupt:
            sys.stderr.write("egotouch: interrupted\n")
            return EXIT_INTERRUPTED


def entry_point() -> NoReturn:
    """What the installed script calls."""
    try:
        code = main()
        sys.stdout.flush()
    except KeyboardInterrupt:
        code = EXIT_INTERRUPTED
    except BrokenPipeError:
        # The reader of a pipe (`| head`) has gone; stop Python from complaining when it flushes stdout at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 0
    raise SystemExit(code)


if __name__ == "__main__":
    entry_point()
