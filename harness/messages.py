"""Log messages of an FMU."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Status(IntEnum):
    """The status codes of FMI 2.0, section 2.1.3."""

    OK = 0
    WARNING = 1
    DISCARD = 2
    ERROR = 3
    FATAL = 4
    PENDING = 5

    @classmethod
    def _missing_(cls, value: object) -> Status:
        """A number that is no status of FMI is an error."""
        return cls.ERROR


@dataclass(frozen=True)
class LogMessage:
    """One message of an FMU.

    Attributes:
        instance: name of the FMU instance.
        time: last communication point before the message [s].
        status: how bad it is.
        category: the FMU's own, one of the LogCategories of its modelDescription.xml; "" when it gave none.
        text: what it says.
    """

    instance: str
    time: float
    status: Status
    category: str
    text: str

    @property
    def needs_attention(self) -> bool:
        """Whether the user should see it."""
        return self.status in (Status.WARNING, Status.DISCARD, Status.ERROR, Status.FATAL)
