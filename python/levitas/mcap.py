"""Messages of the MCAP files that `amb export --mcap` writes: chunks without compression, protobuf.

Format: mcap.dev, specification 0; developers.google.com/protocol-buffers, "Encoding".
"""

import struct

import numpy

MAGIC = b"\x89MCAP0\r\n"
SCHEMA, CHANNEL, MESSAGE, CHUNK, METADATA = 3, 4, 5, 6, 12


def records(data, at, end):
    while at + 9 <= end:
        kind, size = struct.unpack_from("<BQ", data, at)
        if at + 9 + size > end:
            return
        yield kind, data[at + 9:at + 9 + size]
        at += 9 + size


def text(data, at):
    size = struct.unpack_from("<I", data, at)[0]
    return data[at + 4:at + 4 + size].decode("utf-8", "replace"), at + 4 + size


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, at


def protobuf(data):
    """(field, value) in the order of the bytes; doubles as floats, what has a length as bytes."""
    at = 0
    while at < len(data):
        key, at = varint(data, at)
        if key & 7 == 1:
            yield key >> 3, struct.unpack_from("<d", data, at)[0]
            at += 8
        elif key & 7 == 2:
            size, at = varint(data, at)
            yield key >> 3, data[at:at + size]
            at += size
        elif key & 7 == 0:
            value, at = varint(data, at)
            yield key >> 3, value
        else:
            raise ValueError(f"a protobuf field of wire type {key & 7}")


def doubles(messages):
    """{field number: array} of messages that hold the same doubles, which lie in the same places."""
    first, places = messages[0], {}
    at = 0
    while at < len(first):
        key, at = varint(first, at)
        if key & 7 != 1:
            raise ValueError(f"a protobuf field of wire type {key & 7} among numbers")
        places[key >> 3] = at
        at += 8
    if any(len(message) != len(first) for message in messages):
        raise ValueError("messages of one topic hold different fields")
    rows = numpy.frombuffer(b"".join(messages), "u1").reshape(len(messages), len(first))
    return {number: numpy.ascontiguousarray(rows[:, place:place + 8]).view("<f8")[:, 0]
            for number, place in places.items()}


def names(schema):
    """{field number: name} of the one message type of a FileDescriptorSet."""
    file = dict(protobuf(schema))[1]
    message = dict(protobuf(file))[4]
    found = [dict(protobuf(value)) for field, value in protobuf(message) if field == 2]
    return {field[3]: field[1].decode() for field in found}


def read(data):
    """({topic: (names, [(time in ns, message)])}, metadata)."""
    schemas, channels, messages, metadata = {}, {}, {}, {}

    def take(kind, body):
        if kind == SCHEMA:
            number = struct.unpack_from("<H", body)[0]
            _, at = text(body, 2)
            _, at = text(body, at)
            schemas[number] = names(body[at + 4:])
        elif kind == CHANNEL:
            number, schema = struct.unpack_from("<HH", body)
            topic, _ = text(body, 4)
            channels[number] = topic
            messages.setdefault(topic, (schemas.get(schema, {}), []))
        elif kind == MESSAGE:
            number, _, time_ns, _ = struct.unpack_from("<HIQQ", body)
            messages[channels[number]][1].append((time_ns, body[22:]))
        elif kind == METADATA:
            name, at = text(body, 0)
            end = at + 4 + struct.unpack_from("<I", body, at)[0]
            at += 4
            while name == "levitas" and at < end:
                key, at = text(body, at)
                metadata[key], at = text(body, at)
        elif kind == CHUNK:
            compression, at = text(body, 28)
            if compression:
                raise ValueError(f"chunks compressed by {compression}: not of amb export")
            for inner in records(body, at + 8, len(body)):
                take(*inner)

    for kind, body in records(data, len(MAGIC), len(data) - len(MAGIC)):
        take(kind, body)
    return messages, metadata
