"""The exceptions of the package."""


class SquirmersError(Exception):
    """Everything that this package refuses or fails at."""

    __module__ = "squirmers"


class InputError(SquirmersError, ValueError):
    """A value that is not allowed; the text names it and says what is."""

    __module__ = "squirmers"


class FileError(SquirmersError, OSError):
    """A file or folder that cannot be read, written or merged."""

    __module__ = "squirmers"


class ComputationError(SquirmersError, RuntimeError):
    """A computation that failed."""

    __module__ = "squirmers"
