"""The errors that a user can cause: each is one sentence that says what, where and what to do."""


class UserError(Exception):
    """Something the user can put right; ``exit_code`` is what the command line ends with."""

    exit_code = 2


class UsageError(UserError):
    """What was asked for does not exist or does not fit together (exit code 2)."""


class FileError(UserError):
    """A file is unreadable or inconsistent (exit code 3)."""

    exit_code = 3


class NothingToGrade(UserError):
    """The files hold no answers (exit code 4)."""

    exit_code = 4


class BrokenFamily(Exception):
    """A family that is not complete, or contradicts itself; the sentence tells its author what to do."""


def reason(error: OSError) -> str:
    """What the system says of an error, within a sentence."""
    return (error.strerror or str(error)).lower()
