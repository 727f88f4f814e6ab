#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what this demo stands on: stone.glb (basin, bowls, balustrade), ground.glb and paving.png (the
terrace), water.glb (the surfaces of the water) and sky.exr (dusk).

Run it in this folder: python3 make_stage.py. Needs nothing but Python.
"""
import json
import math
import random
import struct
import zlib

BASIN_RADIUS = 1.72  # m, of the water; its level is 0.36 m
BOWLS = [(0.74, 1.215), (0.30, 1.655)]  # radius and level of the water in the bowls


class Mesh:
    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def vertex(self, position, normal, uv=()):
        self.positions.append(position)
        self.normals.append(normal)
        self.uvs.append(uv)
        return len(self.positions) - 1

    def quad(self, a, b, c, d):
        self.indices += [a, b, c, a, c, d]

    def lathe(self, profile, segments=64):
        """Turns (radius, height) points about Y; edges sharper than 40 degrees stay sharp."""
        profile = [p for i, p in enumerate(profile) if i == 0 or p != profile[i - 1]]

        def normal(i):
            (r0, y0), (r1, y1) = profile[i], profile[i + 1]
            length = math.hypot(r1 - r0, y1 - y0)
            return (y1 - y0) / length, (r0 - r1) / length

        normals = [normal(i) for i in range(len(profile) - 1)]
        for i, own in enumerate(normals):
            ends = []
            for j, other in ((i, i - 1), (i + 1, i + 1)):
                n = own
                if 0 <= other < len(normals):
                    m = normals[other]
                    if own[0] * m[0] + own[1] * m[1] > math.cos(math.radians(40)):
                        n = (own[0] + m[0], own[1] + m[1])
                        n = tuple(k / math.hypot(*n) for k in n)
                ring = []
                r, y = profile[j]
                for s in range(segments + 1):
                    angle = 2 * math.pi * s / segments
                    c, z = math.cos(angle), math.sin(angle)
                    ring.append(self.vertex((r * c, y, r * z), (n[0] * c, n[1], n[0] * z)))
                ends.append(ring)
            for s in range(segments):
                self.quad(ends[0][s], ends[1][s], ends[1][s + 1], ends[0][s + 1])

    def box(self, lo, hi):
        for axis in range(3):
            for side in (0, 1):
                u, v = (axis + 1) % 3, (axis + 2) % 3
                corners = []
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    p, n = [0, 0, 0], [0, 0, 0]
                    p[axis], p[u], p[v] = (lo, hi)[side][axis], (lo, hi)[a][u], (lo, hi)[b][v]
                    n[axis] = 2 * side - 1
                    corners.append(self.vertex(tuple(p), tuple(n)))
                self.quad(*(corners if side else corners[::-1]))

    def disc(self, radius, y, segments=96):
        middle = self.vertex((0, y, 0), (0, 1, 0))
        ring = [self.vertex((radius * math.cos(2 * math.pi * s / segments), y,
                             radius * math.sin(2 * math.pi * s / segments)), (0, 1, 0))
                for s in range(segments)]
        for s in range(segments):
            self.indices += [middle, ring[(s + 1) % segments], ring[s]]


def write(path, parts):
    """A binary glTF file of (mesh, places) pairs: each mesh stands at each of its places."""
    data, views, accessors, meshes, nodes = b"", [], [], [], []

    def accessor(kind, component, count, packed, **extra):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data += packed + b"\0" * (-len(packed) % 4)
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count,
                          "type": kind, **extra})
        return len(accessors) - 1

    def floats(kind, rows, **extra):
        flat = [x for row in rows for x in row]
        return accessor(kind, 5126, len(rows), struct.pack(f"<{len(flat)}f", *flat), **extra)

    for mesh, places in parts:
        attributes = {
            "POSITION": floats("VEC3", mesh.positions,
                               min=[min(p[i] for p in mesh.positions) for i in range(3)],
                               max=[max(p[i] for p in mesh.positions) for i in range(3)]),
            "NORMAL": floats("VEC3", mesh.normals)}
        if any(mesh.uvs):
            attributes["TEXCOORD_0"] = floats("VEC2", mesh.uvs)
        count = len(mesh.indices)
        indices = accessor("SCALAR", 5123, count, struct.pack(f"<{count}H", *mesh.indices))
        meshes.append({"primitives": [{"attributes": attributes, "indices": indices}]})
        nodes += [{"mesh": len(meshes) - 1, "translation": place} for place in places]
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
                       "nodes": nodes, "meshes": meshes, "buffers": [{"byteLength": len(data)}],
                       "bufferViews": views, "accessors": accessors}).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as out:
        out.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(data)))
        out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        out.write(struct.pack("<II", len(data), 0x004E4942) + data)

def arc(center, radius, begin, end, steps=8):
    """Points on a circle from `begin` to `end` degrees, for mouldings."""
    return [(center[0] + radius * math.cos(math.radians(begin + (end - begin) * i / steps)),
             center[1] + radius * math.sin(math.radians(begin + (end - begin) * i / steps)))
            for i in range(steps + 1)]


def make_stone():
    stone = Mesh()
    # Two steps, then the wall of the basin with a rounded coping.
    stone.lathe([(2.75, 0), (2.75, 0.09), (2.42, 0.09), (2.42, 0.17), (2.05, 0.17)])
    stone.lathe([(2.05, 0.17), (2.05, 0.22)] + arc((2.05, 0.28), 0.06, 270, 180) + [(1.97, 0.36)]
                + arc((2.0, 0.43), 0.055, 240, 360) + arc((2.0, 0.47), 0.055, 0, 90)
                + [(1.78, 0.525)] + arc((1.78, 0.475), 0.05, 90, 180) + [(1.73, 0.05), (0, 0.05)])
    # Foot, column and the large bowl.
    stone.lathe([(0.52, 0.05), (0.52, 0.40), (0.44, 0.45)] + arc((0.40, 0.51), 0.06, 270, 450)
                + [(0.30, 0.60), (0.20, 0.66), (0.155, 0.76), (0.15, 0.86), (0.17, 0.95)]
                + arc((0.19, 0.98), 0.03, 270, 450) + [(0.20, 1.02), (0.42, 1.05), (0.62, 1.12), (0.73, 1.2)]
                + arc((0.765, 1.215), 0.025, 200, 450) + [(0.735, 1.23), (0.60, 1.16), (0.10, 1.10)])
    # The small bowl and its nozzle.
    stone.lathe([(0.10, 1.10), (0.10, 1.22), (0.07, 1.30), (0.06, 1.42)] + arc((0.075, 1.46), 0.025, 270, 450)
                + [(0.08, 1.5), (0.18, 1.53), (0.27, 1.60), (0.30, 1.645)] + arc((0.315, 1.655), 0.014, 200, 450)
                + [(0.30, 1.66), (0.22, 1.62), (0.05, 1.60), (0.045, 1.68), (0.03, 1.74), (0, 1.74)], 48)
    # The balustrade at the end of the terrace: rails, posts with balls, and what stands between.
    rails, post, baluster = Mesh(), Mesh(), Mesh()
    rails.box((-9.5, 0, -0.2), (9.5, 0.16, 0.2))
    rails.box((-9.5, 0.90, -0.19), (9.5, 1.02, 0.19))
    post.box((-0.2, 0.16, -0.24), (0.2, 1.06, 0.24))
    post.box((-0.26, 1.06, -0.3), (0.26, 1.12, 0.3))
    post.lathe([(0.10, 1.12), (0.07, 1.16)] + arc((0, 1.34), 0.19, -70, 90, 16), 32)
    baluster.lathe([(0.09, 0.16), (0.09, 0.22), (0.05, 0.25), (0.055, 0.30), (0.085, 0.40), (0.08, 0.48),
                    (0.045, 0.62), (0.035, 0.72), (0.055, 0.78), (0.05, 0.82), (0.085, 0.84), (0.085, 0.90)], 20)
    places = {is_post: [(0.3 * i, 0, -6.5) for i in range(-30, 31) if (i % 8 == 4) == is_post]
              for is_post in (False, True)}
    write("stone.glb", [(stone, [(0, 0, 0)]), (rails, [(0, 0, -6.5)]), (post, places[True]),
                        (baluster, places[False])])


def make_ground():
    ground = Mesh()
    x, z = 14, 8
    corners = [ground.vertex((i * x, 0, j * z), (0, 1, 0), (i * x / 2.4, j * z / 2.4))
               for i, j in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    ground.quad(*corners)
    write("ground.glb", [(ground, [(0, 0, 0)])])


def make_water():
    water = Mesh()
    water.disc(BASIN_RADIUS, 0.36)
    for radius, level in BOWLS:
        water.disc(radius, level)
    write("water.glb", [(water, [(0, 0, 0)])])


def make_paving(size=384, slabs=4):
    """Slabs of worn stone, each with a tone and specks of its own; tiles seamlessly."""
    draw = random.Random(3)
    noise = [[draw.random() for _ in range(64)] for _ in range(64)]

    def smooth(u, v, cells):
        x, y = u * cells, v * cells
        i, j = int(x), int(y)
        x, y = x - i, y - j
        x, y = x * x * (3 - 2 * x), y * y * (3 - 2 * y)
        at = lambda a, b: noise[a % cells][b % cells]
        return ((at(i, j) * (1 - x) + at(i + 1, j) * x) * (1 - y)
                + (at(i, j + 1) * (1 - x) + at(i + 1, j + 1) * x) * y)

    tones = [[draw.uniform(0.75, 1.0) for _ in range(slabs)] for _ in range(slabs)]
    rows = []
    for py in range(size):
        row = bytearray([0])
        for px in range(size):
            u, v = px / size, py / size
            across = (u + (0.5 / slabs if int(v * slabs) % 2 else 0)) % 1
            x, y = across * slabs % 1, v * slabs % 1
            edge = min(x, 1 - x, y, 1 - y)
            grout = min(max((edge - 0.012) / 0.03, 0), 1)
            grain = 0.55 * smooth(u, v, 16) + 0.3 * smooth(u, v, 32) + 0.15 * smooth(u, v, 64)
            tone = tones[int(across * slabs)][int(v * slabs)] * (0.62 + 0.55 * grain) * (0.35 + 0.65 * grout)
            row += bytes(min(int(255 * tone * c), 255) for c in (0.78, 0.72, 0.66))
        rows.append(bytes(row))
    chunk = lambda kind, data: (struct.pack(">I", len(data)) + kind + data
                                + struct.pack(">I", zlib.crc32(kind + data)))
    with open("paving.png", "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0))
                  + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def sky(u, v):
    """Dusk: deep blue above, a band of afterglow on the horizon behind the fountain."""
    up = max(90 - 180 * v, 0)
    off = (u - 0.5) * 360 + 6
    zenith = (0.005, 0.010, 0.034)
    haze = math.exp(-up / 14) * (0.35 + 0.65 * math.exp(-((off / 55) ** 2)))
    glow = math.exp(-up / 4.5) * math.exp(-((off / 32) ** 2))
    return [z + haze * h + glow * g for z, h, g in zip(zenith, (0.035, 0.075, 0.165), (0.62, 0.24, 0.10))]


def make_sky(width=32, height=256):
    attribute = lambda name, kind, value: (name.encode() + b"\0" + kind.encode() + b"\0"
                                           + struct.pack("<i", len(value)) + value)
    channels = b"".join(c + b"\0" + struct.pack("<iBBBBii", 1, 0, 0, 0, 0, 1, 1) for c in (b"B", b"G", b"R"))
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    # OpenEXR file layout: magic, version, attributes, offset table, one block per scan line.
    header = struct.pack("<II", 20000630, 2)
    header += attribute("channels", "chlist", channels + b"\0") + attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line = width * 3 * 2
    first = len(header) + 8 * height
    with open("sky.exr", "wb") as out:
        out.write(header + struct.pack(f"<{height}Q", *(first + y * (8 + line) for y in range(height))))
        for y in range(height):
            row = [sky((x + 0.5) / width, (y + 0.5) / height) for x in range(width)]
            out.write(struct.pack("<ii", y, line))
            for channel in (2, 1, 0):
                out.write(struct.pack(f"<{width}e", *(texel[channel] for texel in row)))


if __name__ == "__main__":
    make_stone()
    make_ground()
    make_water()
    make_paving()
    make_sky()
