"""`python -m egotouch_sdk` is the command `egotouch`."""

from egotouch_sdk.cli.main import entry_point

entry_point()
