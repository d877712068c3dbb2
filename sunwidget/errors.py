"""Errors and warnings that a caller may catch; each message says what to do."""


class PhotoError(ValueError):
    """A picture that cannot be opened or written; the message says what to do."""


class PhotoWarning(UserWarning):
    """A picture was opened, but part of its content could not be kept."""


class EditError(ValueError):
    """A recipe or parameter value that cannot be used; the message says what to do."""


class UnknownParameterError(EditError, TypeError):
    """An unknown parameter name; also a TypeError, as for any unknown keyword."""


class AnalysisError(ValueError):
    """An input, hint or method that cannot be used; the message says what to do."""


class RendererError(RuntimeError):
    """The kernel cannot render; the message says what is missing."""


class StudyError(ValueError):
    """Answers or pictures that cannot be used; the message says what to do."""
