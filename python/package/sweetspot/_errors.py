"""The exceptions: what was found, where, and what was expected."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable
from typing import Any, TypeVar

Named = TypeVar("Named")


class SweetspotError(ValueError):
    """An argument or a file is wrong, or could not be read or written.

    ``mistakes`` has all of them, up to ten: dictionaries with ``file``, ``line``, ``column``, ``place`` (the
    field), ``found``, ``expected`` and ``hint``, each None where there is none. ``file``, ``line``,
    ``column`` and ``field`` are those of the first.
    """

    def __init__(self, message: str, document: str | None = None) -> None:
        super().__init__(message)
        self.mistakes: list[dict[str, Any]] = json.loads(document)["mistakes"] if document else []
        first = self.mistakes[0] if self.mistakes else {}
        self.file: str | None = first.get("file")
        self.line: int | None = first.get("line")
        self.column: int | None = first.get("column")
        self.field: str | None = first.get("place")

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), str(self), json.dumps({"mistakes": self.mistakes}))


class SweetspotTypeError(SweetspotError, TypeError):
    """A value of another type than was expected, or an argument that does not exist."""


def _again(kind: type[SweetspotError], message: str, document: str) -> SweetspotError:
    return kind(message, document)


def told(function: Callable[..., Any]) -> Callable[..., Any]:
    """The function, with exceptions of Python about wrong arguments turned into those of the package."""

    @functools.wraps(function)
    def call(*args: Any, **named: Any) -> Any:
        try:
            return function(*args, **named)
        except SweetspotError:
            raise
        except TypeError as error:
            raise SweetspotTypeError(f"{function.__qualname__}: {error}") from error
        except (ValueError, OverflowError, RecursionError) as error:
            raise SweetspotError(f"{function.__qualname__}: {error}") from error

    return call


def all_told(named: type[Named]) -> type[Named]:
    """A class with every public function wrapped by :func:`told`."""
    for name, member in list(vars(named).items()):
        if name.startswith("_") and name not in ("__init__", "__getitem__"):
            continue
        if isinstance(member, (classmethod, staticmethod)):
            setattr(named, name, type(member)(told(member.__func__)))
        elif isinstance(member, property):
            setattr(named, name, property(told(member.fget), doc=member.__doc__))
        elif callable(member) and not isinstance(member, type):
            setattr(named, name, told(member))
    return named
