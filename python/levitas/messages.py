"""Messages as numpy types, from the .lcm files that define them.

LCM writes a fingerprint of eight bytes, then the fields in order, numbers big-endian, arrays as long
as a count that stands before them, texts with their length before and a zero behind.
"""

import re
import struct
from pathlib import Path

import numpy

NUMBERS = {"byte": "u1", "boolean": "i1", "int8_t": "i1", "int16_t": ">i2", "int32_t": ">i4",
           "int64_t": ">i8", "float": ">f4", "double": ">f8"}
FIELD = re.compile(r"^\s*(\w+)\s+(\w+)\s*(?:\[(\w+)\])?\s*;", re.M)
FINGERPRINT = 8
MASK = (1 << 64) - 1


def fields(name):
    """[(type, name, count or None)] of a message. In a clone the definitions lie in lcmtypes/."""
    here = Path(__file__).resolve().parent / f"{name}.lcm"
    path = here if here.exists() else here.parents[2] / "lcmtypes" / here.name
    text = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
    body = text[text.index("{") + 1:text.rindex("}")]
    return [(kind, field, count or None) for kind, field, count in FIELD.findall(body)]


def fingerprint(message_fields):
    """The eight bytes that LCM makes of names, types and dimensions (lcm-gen's lcmgen.c), as a number."""
    value = 0x12345678

    def update(byte):
        nonlocal value
        signed = value - (1 << 64) if value >> 63 else value
        value = (((value << 8) & MASK) ^ ((signed >> 55) & MASK)) + byte & MASK

    def name(text):
        update(len(text))
        for byte in text.encode():
            update(byte)

    for kind, field, count in message_fields:
        name(field)
        name(kind)
        update(1 if count else 0)
        if count:
            update(0 if count.isdigit() else 1)
            name(count)
    return ((value << 1) & MASK) | (value >> 63)


def encode(message_fields, values):
    """The bytes of a message of numbers alone; what `values` lacks is 0."""
    parts = [struct.pack(">Q", fingerprint(message_fields))]
    parts += [numpy.array(values.get(name, 0), NUMBERS[kind]).tobytes() for kind, name, _ in message_fields]
    return b"".join(parts)


def layout(message_fields, payload):
    """The numpy type of a message without texts, with the counts that this one has."""
    parts, counts, at = [("fingerprint", ">u8")], {}, FINGERPRINT
    for kind, name, count in message_fields:
        number = numpy.dtype(NUMBERS[kind])
        length = counts[count] if count else 1
        if not count and kind == "int32_t" and at + 4 <= len(payload):
            counts[name] = struct.unpack_from(">i", payload, at)[0]
        if length < 0:
            raise ValueError(f"a count of {length}")
        parts.append((name, number, (length,)) if count else (name, number))
        at += number.itemsize * length
    return numpy.dtype(parts)


def decode(message_fields, payload):
    """{field: value} of a message of any kind; ValueError when it ends too early."""
    out, at = {}, FINGERPRINT

    def number(kind):
        nonlocal at
        dtype = numpy.dtype(NUMBERS[kind])
        value = numpy.frombuffer(payload, dtype, 1, at)[0]
        at += dtype.itemsize
        return value.item()

    def text():
        nonlocal at
        size = number("int32_t")
        value = bytes(payload[at:at + size - 1])
        at += size
        if size < 1 or at > len(payload):
            raise ValueError("a text beyond the end")
        return value.decode("utf-8", "replace")

    for kind, name, count in message_fields:
        one = text if kind == "string" else lambda kind=kind: number(kind)
        out[name] = [one() for _ in range(out[count])] if count else one()
    return out
