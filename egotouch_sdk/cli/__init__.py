"""The command `egotouch`: one module per subcommand, typed errors as one line, no logic of its own."""
