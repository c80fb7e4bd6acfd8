"""Checkpoints read and written without the program (src/io/checkpoint.h has the format)."""
import struct

HEADER = 32
DOUBLES, INTEGER, TEXT = range(3)


def checksum(data):
    """FNV-1a, 64 bit."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    return value


def with_right_checksum(data):
    payload = data[HEADER:]
    return data[:16] + struct.pack("<QQ", len(payload), checksum(payload)) + payload


def read(path):
    """The entries of a checkpoint: lists of floats, integers and texts by name."""
    data, at, entries = path.read_bytes(), HEADER, {}
    while at < len(data):
        kind, length = struct.unpack_from("<BI", data, at)
        name = data[at + 5:at + 5 + length].decode()
        n, = struct.unpack_from("<Q", data, at + 5 + length)
        at += 13 + length
        if kind == DOUBLES:
            entries[name], size = list(struct.unpack_from(f"<{n}d", data, at)), 8 * n
        elif kind == INTEGER:
            entries[name], size = struct.unpack_from("<q", data, at)[0], 8
        else:
            entries[name], size = data[at:at + n].decode(), n
        at += size
    return entries


def write(path, entries):
    """Replaces the entries of a checkpoint."""
    payload = b""
    for name, value in sorted(entries.items()):
        if isinstance(value, str):
            kind, n, content = TEXT, len(value.encode()), value.encode()
        elif isinstance(value, int):
            kind, n, content = INTEGER, 1, struct.pack("<q", value)
        else:
            kind, n, content = DOUBLES, len(value), struct.pack(f"<{len(value)}d", *value)
        payload += struct.pack("<BI", kind, len(name)) + name.encode() + struct.pack("<Q", n) + content
    path.write_bytes(with_right_checksum(path.read_bytes()[:HEADER] + payload))
