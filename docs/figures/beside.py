#!/usr/bin/env python3
"""Puts PNG pictures of one height beside each other.

    docs/figures/beside.py OUT.png ONE.png TWO.png ...

Reads what grainreel writes: 8 bits a channel, RGB or RGBA, no interlacing. Needs Python alone.
"""

import struct
import sys
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunks(data):
    at = len(SIGNATURE)
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        yield data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        at += length + 12


def predicted(kind, left, above, corner):
    """What a PNG filter of this kind adds to a byte (PNG specification, section 9)."""
    if kind == 3:
        return (left + above) // 2
    if kind < 4:
        return (0, left, above)[kind]
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))


def rows_of(path):
    """The picture's rows as RGB bytes."""
    data = open(path, "rb").read()
    if not data.startswith(SIGNATURE):
        sys.exit(f"{path}: is not a PNG file")
    parts = list(chunks(data))
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", parts[0][1])
    if depth != 8 or colour not in (2, 6) or interlaced:
        sys.exit(f"{path}: is not RGB or RGBA of 8 bits without interlacing")
    size = 3 if colour == 2 else 4
    raw = zlib.decompress(b"".join(part for name, part in parts if name == b"IDAT"))
    above, rows = bytearray(size * width), []
    for y in range(height):
        kind, row = raw[y * (size * width + 1)], bytearray(raw[y * (size * width + 1) + 1 : (y + 1) * (size * width + 1)])
        for i in range(len(row) if kind else 0):
            left, corner = (row[i - size], above[i - size]) if i >= size else (0, 0)
            row[i] = (row[i] + predicted(kind, left, above[i], corner)) & 255
        above = row
        rows.append(bytes(row) if size == 3 else bytes(byte for i, byte in enumerate(row) if i % 4 != 3))
    return rows


def write(path, rows):
    """Writes rows of RGB bytes, each as its difference to the row above."""
    packed, above = bytearray(), bytes(len(rows[0]))
    for row in rows:
        packed += b"\x02" + bytes((a - b) & 255 for a, b in zip(row, above))
        above = row
    with open(path, "wb") as out:
        out.write(SIGNATURE)
        head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
        for name, part in ((b"IHDR", head), (b"IDAT", zlib.compress(bytes(packed), 9)), (b"IEND", b"")):
            out.write(struct.pack(">I", len(part)) + name + part + struct.pack(">I", zlib.crc32(name + part)))


def main(out, *pictures):
    all_rows = [rows_of(picture) for picture in pictures]
    if len({len(rows) for rows in all_rows}) != 1:
        sys.exit("the pictures are not of one height")
    write(out, [b"".join(rows) for rows in zip(*all_rows)])


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
