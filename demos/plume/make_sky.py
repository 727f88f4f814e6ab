#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes sky.exr, the dusk sky of this demo: a gradient with an afterglow above the horizon.

Run it in this folder: python3 make_sky.py. Latitude-longitude map, half floats, uncompressed.
"""
import math
import struct

WIDTH, HEIGHT = 64, 512
ZENITH = (0.003, 0.007, 0.026)
HAZE = (0.045, 0.115, 0.21)  # blue band above the afterglow
GLOW = (1.35, 0.47, 0.16)  # on the horizon, where the sun went down
SUN_AZIMUTH = math.radians(7)  # from -Z towards +X


def radiance(u, v):
    elevation = 90 - 180 * v
    azimuth = (u - 0.5) * 2 * math.pi
    up = max(elevation, 0)
    off = math.degrees(azimuth - SUN_AZIMUTH)
    haze = math.exp(-up / 10) * (0.25 + 0.75 * math.exp(-((off / 30) ** 2)))
    glow = math.exp(-up / 4.2) * math.exp(-((off / 17) ** 2))
    return [z + haze * h + glow * g for z, h, g in zip(ZENITH, HAZE, GLOW)]


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def main():
    # OpenEXR file layout: magic, version, attributes, offset table, one block per scan line.
    channels = b"".join(c + b"\0" + struct.pack("<iBBBBii", 1, 0, 0, 0, 0, 1, 1) for c in (b"B", b"G", b"R"))
    window = struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute("channels", "chlist", channels + b"\0")
    header += attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line = WIDTH * 3 * 2
    first = len(header) + 8 * HEIGHT
    with open("sky.exr", "wb") as out:
        out.write(header)
        out.write(struct.pack(f"<{HEIGHT}Q", *(first + y * (8 + line) for y in range(HEIGHT))))
        for y in range(HEIGHT):
            row = [radiance((x + 0.5) / WIDTH, (y + 0.5) / HEIGHT) for x in range(WIDTH)]
            out.write(struct.pack("<ii", y, line))
            for channel in (2, 1, 0):
                out.write(struct.pack(f"<{WIDTH}e", *(texel[channel] for texel in row)))


if __name__ == "__main__":
    main()
