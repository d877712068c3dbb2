"""What the analysis raises when it cannot go on; everything less is a warning of the Scene."""


class AnalysisError(ValueError):
    """An input, hint or method that cannot be used; the message says what to do."""
