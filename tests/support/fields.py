"""Reads what fields.nc holds without any library: NetCDF classic with 32-bit or 64-bit offsets, or 64-bit data."""
import struct
from pathlib import Path

SIZE = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}
LETTER = {1: "b", 2: "c", 3: "h", 4: "i", 5: "f", 6: "d"}
DIMENSIONS, VARIABLES, ATTRIBUTES = 10, 11, 12


class Fields:
    """The variables of a fields.nc: values(name) is a flat list, shape(name) the lengths of its dimensions."""

    def __init__(self, path):
        self.data = Path(path).read_bytes()
        if self.data[:3] != b"CDF" or self.data[3] not in (1, 2, 5):
            raise ValueError(f"{path} is no NetCDF classic file")
        self.version, self.place = self.data[3], 4
        self.records = self.count()
        self.lengths = [self.dimension() for _ in range(self.list_of(DIMENSIONS))]
        self.attributes()
        self.variables = dict(self.variable() for _ in range(self.list_of(VARIABLES)))
        # The records of all variables follow one another, so a record is as long as all of them together.
        self.record_bytes = sum(v["bytes"] for v in self.variables.values() if self.by_record(v))

    def take(self, format):
        value, = struct.unpack_from(">" + format, self.data, self.place)
        self.place += struct.calcsize(format)
        return value

    def count(self):
        return self.take("q" if self.version == 5 else "i")

    def list_of(self, tag):
        found, length = self.take("i"), self.count()
        if found not in (0, tag):
            raise ValueError("the header of fields.nc is not as it should be")
        return length

    def name(self):
        length = self.count()
        text = self.data[self.place:self.place + length].decode()
        self.place += length + -length % 4
        return text

    def dimension(self):
        self.name()
        return self.count()  # 0: the records

    def attributes(self):
        for _ in range(self.list_of(ATTRIBUTES)):
            self.name()
            kind = self.take("i")
            size = SIZE[kind] * self.count()
            self.place += size + -size % 4

    def variable(self):
        name = self.name()
        dimensions = [self.count() for _ in range(self.count())]
        self.attributes()
        kind, size = self.take("i"), self.count()
        begin = self.take("i" if self.version == 1 else "q")
        return name, {"dimensions": dimensions, "kind": kind, "bytes": size, "begin": begin}

    def by_record(self, variable):
        return bool(variable["dimensions"]) and self.lengths[variable["dimensions"][0]] == 0

    def shape(self, name):
        return [self.lengths[i] or self.records for i in self.variables[name]["dimensions"]]

    def record(self, name, number):
        """The values of one record of a variable that has records."""
        variable, length = self.variables[name], 1
        for n in self.shape(name)[1:]:
            length *= n
        place = variable["begin"] + number * self.record_bytes
        return struct.unpack_from(f">{length}{LETTER[variable['kind']]}", self.data, place)

    def values(self, name):
        variable, shape = self.variables[name], self.shape(name)
        if self.by_record(variable):
            return [value for number in range(shape[0]) for value in self.record(name, number)]
        length = 1
        for n in shape:
            length *= n
        return list(struct.unpack_from(f">{length}{LETTER[variable['kind']]}", self.data, variable["begin"]))
