"""Water: where it is, and where the old sun glints on it."""
