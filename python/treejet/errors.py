"""What can go wrong, with the exit codes of the program (README, "Exit codes")."""

from __future__ import annotations


class TreejetError(RuntimeError):
    """A failure of the program or of this package; the text is what the program said.

    >>> raise TreejetError("deck.dat:3: unknown directive", 2)
    Traceback (most recent call last):
    ...
    treejet.errors.TreejetError: deck.dat:3: unknown directive
    """

    def __init__(self, message: str, exit_code: int) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class InputError(TreejetError):
    """Wrong arguments, exit code 2."""

    def __init__(self, message: str) -> None:
        super().__init__(message, 2)


class FileError(TreejetError):
    """A file that cannot be read or written, exit code 4."""

    def __init__(self, message: str) -> None:
        super().__init__(message, 4)
