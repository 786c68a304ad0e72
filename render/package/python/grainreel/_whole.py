"""Whether a NetCDF file of a run is whole. The libraries read zeros behind the end of a file that was cut off."""
from __future__ import annotations

import struct
import time
from pathlib import Path
from typing import BinaryIO, List, Optional, Tuple

from ._messages import GrainreelError, tell

_SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}  # bytes of a value, by the number of its type


class _Header:
    """The header of a file of the classic format (NetCDF user's guide, appendix B): its records, and where they lie."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        form = file.read(4)
        if form[:3] != b"CDF" or form[3:] not in (b"\1", b"\2", b"\5"):
            raise ValueError("not of the classic format")
        self._count, self._place = ("q" if form[3] == 5 else "i"), ("i" if form[3] == 1 else "q")
        #: How many records the file counts; None where it says that a program still writes it.
        self.counted: Optional[int] = self._number(self._count)
        if self.counted is not None and self.counted < 0:
            self.counted = None
        #: The name of their dimension.
        self.dimension = ""
        lengths = []
        for _ in range(self._list()):
            name, length = self._name(), self._number(self._count)
            self.dimension = name if length == 0 else self.dimension
            lengths.append(length)
        self._attributes()
        of_records = [variable for variable in (self._variable(lengths) for _ in range(self._list())) if variable]
        #: Bytes: where the first record begins, and how long each is.
        self.begin = min((begin for begin, _ in of_records), default=0)
        alone = len(of_records) == 1  # its records lie without gaps
        self.record = sum(size if alone else size + -size % 4 for _, size in of_records)

    def _number(self, form: str) -> int:
        return int(struct.unpack(">" + form, self._file.read(struct.calcsize(">" + form)))[0])

    def _list(self) -> int:
        self._number("i")  # what it is a list of
        return self._number(self._count)

    def _name(self) -> str:
        length = self._number(self._count)
        return self._file.read(length + -length % 4)[:length].decode("utf-8", "replace")

    def _attributes(self) -> None:
        for _ in range(self._list()):
            self._name()
            size = _SIZES[self._number("i")] * self._number(self._count)
            self._file.seek(size + -size % 4, 1)

    def _variable(self, lengths: List[int]) -> Optional[Tuple[int, int]]:
        """Begin and size of a record of a variable that has records."""
        self._name()
        own = [lengths[self._number(self._count)] for _ in range(self._number(self._count))]
        self._attributes()
        size = _SIZES[self._number("i")]
        self._number(self._count)
        begin = self._number(self._place)
        if not own or own[0] != 0:
            return None
        for length in own[1:]:
            size *= length
        return begin, size


def whole_records(path: Path) -> Optional[Tuple[str, int]]:
    """The dimension of the file's records and how many of those that it counts are whole; None where it is of another
    format. Raises where more than one frame is not; a killed run may leave one (see trajectory_reader.cpp)."""
    patience = 0.5  # s: a run that goes on writes the count of its records first
    until = time.monotonic() + patience
    while True:
        try:
            with path.open("rb") as file:
                header = _Header(file)
            length = path.stat().st_size
        except (OSError, ValueError, KeyError, IndexError, struct.error):
            return None  # the reader of NetCDF says what is wrong
        if header.counted is None or not header.record:
            return None
        whole = max(0, length - header.begin) // header.record
        if whole >= header.counted or time.monotonic() > until or time.time() - path.stat().st_mtime > 10:
            break
        time.sleep(0.01)
    if whole + 1 < header.counted:
        if header.dimension == "frame":
            raise GrainreelError(f"{path}: was cut off: of its {header.counted} frames {whole} are whole; copy it again")
        tell(f"{path}: was cut off, or its run was killed: of {header.counted} rows {whole} are whole")
    return header.dimension, min(whole, header.counted)
