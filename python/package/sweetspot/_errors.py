"""What is wrong, where, and what was expected."""

from __future__ import annotations

import json
from typing import Any


class SweetspotError(ValueError):
    """Something that was given is wrong, or could not be read or written.

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
        return _again, (str(self), json.dumps({"mistakes": self.mistakes}))


def _again(message: str, document: str) -> SweetspotError:
    return SweetspotError(message, document)
