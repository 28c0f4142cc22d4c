"""The event grammar, checkable by anyone: `verify_events` for a finished stream, `GrammarVerifier` for a running one."""

from egotouch_sdk.events.verify import GrammarVerifier, Violation, verify_events

__all__ = ["GrammarVerifier", "Violation", "verify_events"]
