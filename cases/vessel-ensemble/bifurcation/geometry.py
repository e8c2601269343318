"""Writes system/blockMeshDict of the bifurcation from the numbers below, in micrometres.

A parent channel along x divides into an upper and a lower daughter. The outer corners are rounded, and so
is the nose of the divider, because a sharp one makes the flow singular there. Eight blocks: two lanes in
the parent, divided by the streamline to the nose, two more in the junction, two in each daughter.

Run as: geometry.py [CELL SIZE]     in the folder of the case; default 1.25
"""

import math
import pathlib
import sys

PARENT = 75.0  # width of the parent channel
LENGTH = 200.0  # of the parent, up to the corners
UPPER = {"width": 50.0, "angle": math.radians(30), "length": 150.0}
LOWER = {"width": 35.0, "angle": math.radians(-40), "length": 150.0}
CORNER = 25.0  # radius of the outer corners
NOSE = 10.0  # radius of the tip of the divider
LANES = 75.0  # length of the junction blocks before the corners
ARC = 12  # chords of half an arc
DEPTH = 1.0


def along(angle):
    return (math.cos(angle), math.sin(angle))


def moved(point, direction, distance):
    return (point[0] + distance * direction[0], point[1] + distance * direction[1])


def arc(centre, radius, begin, end):
    """Points on a circle between two angles, both included."""
    return [moved(centre, along(begin + (end - begin) * k / ARC), radius) for k in range(ARC + 1)]


def intersection(a, u, b, v):
    """Of the lines a + s u and b + t v."""
    s = ((b[0] - a[0]) * v[1] - (b[1] - a[1]) * v[0]) / (u[0] * v[1] - u[1] * v[0])
    return moved(a, u, s)


def corner(y, angle):
    """Both halves of the rounded corner of an outer wall that turns by an angle at (LENGTH, y)."""
    side = math.copysign(1, angle)
    centre = (LENGTH - CORNER * math.tan(abs(angle) / 2), y + side * CORNER)
    down = -side * math.pi / 2
    return arc(centre, CORNER, down, down + angle / 2), arc(centre, CORNER, down + angle / 2, down + angle)


def geometry():
    upper, lower = along(UPPER["angle"]), along(LOWER["angle"])
    top, bottom = (LENGTH, PARENT), (LENGTH, 0.0)
    # Inner walls: the outer ones, moved across the daughters.
    inner_upper = moved(top, (upper[1], -upper[0]), UPPER["width"])
    inner_lower = moved(bottom, (-lower[1], lower[0]), LOWER["width"])
    apex = intersection(inner_upper, upper, inner_lower, lower)
    middle = (UPPER["angle"] + LOWER["angle"]) / 2
    half = (UPPER["angle"] - LOWER["angle"]) / 2
    centre = moved(apex, along(middle), NOSE / math.sin(half))
    back = middle + math.pi
    return {
        "corner_upper": corner(PARENT, UPPER["angle"]),
        "corner_lower": corner(0.0, LOWER["angle"]),
        # from the tip of the nose to where the straight inner walls begin
        "nose_upper": arc(centre, NOSE, back, UPPER["angle"] + math.pi / 2),
        "nose_lower": arc(centre, NOSE, back, LOWER["angle"] + 3 * math.pi / 2),
        "inner_upper": inner_upper,
        "inner_lower": inner_lower,
        "top": top,
        "bottom": bottom,
    }


class Dictionary:
    """Vertices, edges and blocks; every vertex in front and behind."""

    def __init__(self):
        self.vertices, self.edges, self.blocks = [], [], []

    def vertex(self, point):
        self.vertices.append(point)
        return len(self.vertices) - 1

    def edge(self, begin, end, points):
        self.edges.append((begin, end, points))

    def block(self, corners, cells):
        self.blocks.append((corners, cells))

    def write(self, patches):
        n = len(self.vertices)
        place = lambda p, z: f"({p[0]:.12g} {p[1]:.12g} {z:g})"
        lines = [
            "// Written by geometry.py, which holds the measures; micrometres.",
            "FoamFile { version 2.0; format ascii; class dictionary; object blockMeshDict; }",
            "scale 1;",
            "vertices",
            "(",
            *[f"    {place(p, z)}" for z in (0.0, DEPTH) for p in self.vertices],
            ");",
            "blocks",
            "(",
        ]
        for c, (i, j) in self.blocks:
            numbers = " ".join(str(k) for k in (*c, *[k + n for k in c]))
            lines.append(f"    hex ({numbers}) ({i} {j} 1) simpleGrading (1 1 1)")
        lines += [");", "edges", "("]
        for begin, end, points in self.edges:
            for shift, z in ((0, 0.0), (n, DEPTH)):
                inner = " ".join(place(p, z) for p in points)
                lines.append(f"    polyLine {begin + shift} {end + shift} ({inner})")
        lines += [");", "boundary", "("]
        for name, kind, pairs in patches:
            faces = " ".join(f"({a} {b} {b + n} {a + n})" for a, b in pairs)
            lines.append(f"    {name} {{ type {kind}; faces ({faces}); }}")
        flat = " ".join(
            "({} {} {} {})".format(*c) + " ({} {} {} {})".format(*[k + n for k in c]) for c, _ in self.blocks
        )
        lines += [f"    frontAndBack {{ type empty; faces ({flat}); }}", ");"]
        return "\n".join(lines) + "\n"


def mesh(size):
    g = geometry()
    d = Dictionary()
    nose = g["nose_upper"][0]
    corner_upper, corner_lower = g["corner_upper"][0][-1], g["corner_lower"][0][-1]
    section_upper = math.dist(nose, corner_upper)
    section_lower = math.dist(nose, corner_lower)
    divide = PARENT * section_lower / (section_upper + section_lower)

    start = LENGTH - LANES
    inlet = [d.vertex((0, y)) for y in (0, divide, PARENT)]
    lanes = [d.vertex((start, y)) for y in (0, divide, PARENT)]
    tip, up, low = d.vertex(nose), d.vertex(corner_upper), d.vertex(corner_lower)
    d.edge(lanes[2], up, g["corner_upper"][0][:-1])
    d.edge(lanes[0], low, g["corner_lower"][0][:-1])

    cells_upper, cells_lower = (max(4, round(s / size)) for s in (section_upper, section_lower))
    count = lambda length: max(2, round(length / size))
    d.block((inlet[0], lanes[0], lanes[1], inlet[1]), (count(start), cells_lower))
    d.block((inlet[1], lanes[1], lanes[2], inlet[2]), (count(start), cells_upper))
    d.block((lanes[0], low, tip, lanes[1]), (count(LANES), cells_lower))
    d.block((lanes[1], tip, up, lanes[2]), (count(LANES), cells_upper))

    def daughter(duct, side, inner, outer, nose_arc, corner_arc, corner_vertex, cells):
        """The block from the nose to where both walls are straight and level, and that to the end."""
        direction = along(duct["angle"])
        length = lambda p: (p[0] - outer[0]) * direction[0] + (p[1] - outer[1]) * direction[1]
        straight = 1.0 * duct["width"]  # from the corner on
        ends = (straight, duct["length"])
        inside, outside = [], []
        across = (side * direction[1] * duct["width"], -side * direction[0] * duct["width"])
        for end in ends:
            at = moved(outer, direction, end)
            outside.append(d.vertex(at))
            inside.append(d.vertex((at[0] + across[0], at[1] + across[1])))
        d.edge(tip, inside[0], nose_arc[1:])
        d.edge(corner_vertex, outside[0], corner_arc[1:])
        first = count(straight - length(nose))
        second = count(duct["length"] - straight)
        if side > 0:
            d.block((tip, inside[0], outside[0], corner_vertex), (first, cells))
            d.block((inside[0], inside[1], outside[1], outside[0]), (second, cells))
        else:
            d.block((corner_vertex, outside[0], inside[0], tip), (first, cells))
            d.block((outside[0], outside[1], inside[1], inside[0]), (second, cells))
        return inside, outside

    upper_in, upper_out = daughter(
        UPPER, 1, g["inner_upper"], g["top"], g["nose_upper"], g["corner_upper"][1], up, cells_upper
    )
    lower_in, lower_out = daughter(
        LOWER, -1, g["inner_lower"], g["bottom"], g["nose_lower"], g["corner_lower"][1], low, cells_lower
    )
    walls = [
        (inlet[0], lanes[0]),
        (lanes[0], low),
        (low, lower_out[0]),
        (lower_out[0], lower_out[1]),
        (lanes[2], inlet[2]),
        (up, lanes[2]),
        (upper_out[0], up),
        (upper_out[1], upper_out[0]),
        (tip, upper_in[0]),
        (upper_in[0], upper_in[1]),
        (lower_in[0], tip),
        (lower_in[1], lower_in[0]),
    ]
    return d.write(
        [
            ("inlet", "patch", [(inlet[1], inlet[0]), (inlet[2], inlet[1])]),
            ("upper", "patch", [(upper_in[1], upper_out[1])]),
            ("lower", "patch", [(lower_out[1], lower_in[1])]),
            ("walls", "wall", walls),
        ]
    )


if __name__ == "__main__":
    cell_size = float(sys.argv[1]) if len(sys.argv) > 1 else 1.25
    pathlib.Path("system/blockMeshDict").write_text(mesh(cell_size), encoding="utf-8")
