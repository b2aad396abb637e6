#!/usr/bin/env python3
"""Writes tube.ply, ring.ply and knot.ply beside this file: the meshes of the scenes in this folder."""
import math
import pathlib


def cylinder(radius, height, around, along):
    """An open cylinder around the z axis. Returns rows of points, closed around."""
    return [[(radius * math.cos(2 * math.pi * i / around), radius * math.sin(2 * math.pi * i / around),
              height * (k / (along - 1) - 0.5)) for i in range(around)] for k in range(along)], True


def scaled(v, s):
    return tuple(s * a for a in v)


def unit(v):
    return scaled(v, 1 / math.hypot(*v))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def knotted_ribbon(width, size, along, across):
    """A ribbon along an open trefoil, the curve (t³ - 3t, t⁴ - 4t², 2 (t⁵/5 - 2t)), with straight ends.

    It is wide along the curve's binormal, so the curve is a geodesic of it, and flat cloth can take this shape up to
    its twist.
    """
    end, straight = 2.15, 1.2

    def point(t):
        return (t**3 - 3 * t, t**4 - 4 * t**2, 2 * (t**5 / 5 - 2 * t))

    def first(t):
        return (3 * t**2 - 3, 4 * t**3 - 8 * t, 2 * (t**4 - 2))

    def second(t):
        return (6 * t, 12 * t**2 - 8, 8 * t**3)

    fine = [-end + 2 * end * i / 20000 for i in range(20001)]
    curve = [scaled(point(t), size) for t in fine]
    length = [0.0]
    for a, b in zip(curve, curve[1:]):
        length.append(length[-1] + math.dist(a, b))
    total = length[-1] + 2 * straight * size
    rows, at = [], 0
    for k in range(along):
        s = total * k / (along - 1) - straight * size
        beyond = min(s, 0) + max(s - length[-1], 0)
        s = min(max(s, 0), length[-1])
        while at < len(length) - 2 and length[at + 1] < s:
            at += 1
        share = (s - length[at]) / (length[at + 1] - length[at])
        t = fine[at] + share * (fine[at + 1] - fine[at])
        tangent, side = unit(first(t)), unit(cross(first(t), second(t)))
        center = [c + beyond * d for c, d in zip(scaled(point(t), size), tangent)]
        rows.append([tuple(c + width * (i / (across - 1) - 0.5) * d for c, d in zip(center, side))
                     for i in range(across)])
    return rows, False


def write(name, comment, grid):
    rows, closed = grid
    columns = len(rows[0])
    faces = []
    for k in range(len(rows) - 1):
        for i in range(columns if closed else columns - 1):
            a, b = k * columns + i, k * columns + (i + 1) % columns
            c, d = b + columns, a + columns
            faces += [(a, b, c), (a, c, d)] if (i + k) % 2 == 0 else [(a, b, d), (b, c, d)]
    lines = ["ply", "format ascii 1.0", f"comment {comment}", f"element vertex {len(rows) * columns}",
             "property float x", "property float y", "property float z",
             f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(f"{c:.5f}" for c in p) for row in rows for p in row]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    (pathlib.Path(__file__).parent / name).write_text("\n".join(lines) + "\n")


write("tube.ply", "A tube, 0.5 m long and 0.36 m wide.", cylinder(0.18, 0.5, 96, 43))
write("ring.ply", "A hoop of cloth, 0.08 m long and 0.2 m wide.", cylinder(0.1, 0.08, 48, 7))
write("knot.ply", "A ribbon, 0.024 m wide, with an open overhand knot.", knotted_ribbon(0.024, 0.05, 401, 5))
