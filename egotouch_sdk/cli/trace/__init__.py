"""What `egotouch debug-events` shows: every event with the state before and after it, and its cause."""
