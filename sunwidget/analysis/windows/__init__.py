"""Windows that can be lit."""
