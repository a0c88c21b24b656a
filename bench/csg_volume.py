#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume of an IFC Boolean tree without making any surface: random points are asked whether they are in it.

usage: csg_volume.py FILE.ifc NUMBER [POINTS]   of a representation item, or of a product's body less its openings

An opinion that shares nothing with a tessellating kernel: for docs/explanation/import-differences.md. Knows what the corpus' hard cases
are made of: extrusions of polygons, rectangles (also hollow) and circles, faceted breps, half-spaces.
"""
import math
import random
import re
import sys

RECORD = re.compile(r"#(\d+)\s*=\s*([A-Za-z0-9_]+)\s*(\(.*?\))\s*;\s*(?=#|END|/\*)", re.S)
RECORDS = {int(m[1]): (m[2].upper(), m[3]) for m in RECORD.finditer(open(sys.argv[1], encoding="latin-1").read())}


def arguments(number):
    parts, depth, part, quoted = [], 0, "", False
    for c in RECORDS[number][1][1:-1]:
        quoted ^= c == "'"
        depth += 0 if quoted else (c == "(") - (c == ")")
        if c == "," and depth == 0 and not quoted:
            parts.append(part.strip())
            part = ""
        else:
            part += c
    return parts + [part.strip()]


def ref(text):
    return int(text[1:]) if text.startswith("#") else None


def refs(text):
    return [int(n) for n in re.findall(r"#(\d+)", text)]


def point(number):
    p = [float(x) for x in re.findall(r"[-+]?[0-9.]+(?:[Ee][-+]?\d+)?", arguments(number)[0])]
    return p + [0.0] * (3 - len(p))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(number, otherwise):
    v = point(number) if number else otherwise
    length = math.sqrt(dot(v, v))
    return [x / length for x in v] if length > 0 else list(otherwise)


def frame(number):
    """Three axes and an origin."""
    if not number:
        return [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0]
    a, flat = arguments(number), RECORDS[number][0].endswith("2D")
    z = [0, 0, 1] if flat else unit(ref(a[1]), [0, 0, 1])
    x = unit(ref(a[1 if flat else 2]), [1, 0, 0])
    x = [x[k] - dot(x, z) * z[k] for k in range(3)]
    length = math.sqrt(dot(x, x))
    x = [c / length for c in x]
    return [x, cross(z, x), z], point(ref(a[0]))


def into(f, p):
    return [dot(axis, minus(p, f[1])) for axis in f[0]]


def out_of(f, p):
    return [f[1][k] + sum(p[i] * f[0][i][k] for i in range(3)) for k in range(3)]


def polygon_holds(polygon):
    def holds(x, y):
        inside, (ax, ay) = False, polygon[-1][:2]
        for bx, by, *_ in polygon:
            if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
                inside = not inside
            ax, ay = bx, by
        return inside
    return holds


def outline(number):
    name, a = RECORDS[number][0], arguments(number)
    if name == "IFCPOLYLINE":
        return [point(n) for n in refs(a[0])]
    if name == "IFCCOMPOSITECURVE":
        points = []
        for segment in refs(a[0]):
            s = arguments(segment)
            part = outline(ref(s[2]))
            points += (part if s[1] == ".T." else part[::-1])[:-1]
        return points
    if name == "IFCTRIMMEDCURVE":
        basis, base = RECORDS[ref(a[0])][0], arguments(ref(a[0]))
        ends, values = [[point(n) for n in refs(a[k])] for k in (1, 2)], [re.search(r"VALUE\(([-+0-9.Ee]+)\)", a[k]) for k in (1, 2)]
        if basis == "IFCLINE":
            along = arguments(ref(base[1]))
            start, d = point(ref(base[0])), [c * float(along[1]) for c in unit(ref(along[0]), [1, 0, 0])]
            return [e[0] if e else [start[k] + d[k] * float(v[1]) for k in range(3)] for e, v in zip(ends, values)]
        if basis == "IFCCIRCLE":
            f, r = frame(ref(base[0])), float(base[1])
            per = math.pi / 180 if any("'DEGREE'" in text.upper() for name, text in RECORDS.values() if name == "IFCCONVERSIONBASEDUNIT") else 1
            t = [math.atan2(*into(f, e[0])[1::-1]) if e else float(v[1]) * per for e, v in zip(ends, values)]
            forward = a[3] == ".T."
            sweep = (t[1] - t[0]) % (2 * math.pi) if forward else -((t[0] - t[1]) % (2 * math.pi))
            return [out_of(f, [r * math.cos(t[0] + sweep * k / 90), r * math.sin(t[0] + sweep * k / 90), 0]) for k in range(91)]
    raise SystemExit(f"#{number}={name} is not known here")


def profile(number):
    name, a = RECORDS[number][0], arguments(number)
    if name.startswith("IFCARBITRARY"):
        outer = polygon_holds(outline(ref(a[2])))
        holes = [polygon_holds(outline(n)) for n in refs(a[3])] if "VOIDS" in name else []
        return lambda x, y: outer(x, y) and not any(h(x, y) for h in holes)
    f = frame(ref(a[2]))
    if name == "IFCRECTANGLEPROFILEDEF":
        w, h = float(a[3]) / 2, float(a[4]) / 2
        corners = [out_of(f, [x, y, 0]) for x, y in ((-w, -h), (w, -h), (w, h), (-w, h))]
        return polygon_holds(corners)
    if name == "IFCRECTANGLEHOLLOWPROFILEDEF":
        w, h, t = float(a[3]) / 2, float(a[4]) / 2, float(a[5])

        def hollow(x, y):
            x, y = (abs(c) for c in into(f, [x, y, 0])[:2])
            return x <= w and y <= h and not (x < w - t and y < h - t)
        return hollow
    if name == "IFCCIRCLEPROFILEDEF":
        r = float(a[3])
        return lambda x, y: math.hypot(x - f[1][0], y - f[1][1]) <= r
    raise SystemExit(f"#{number}={name} is not known here")


def triangles(brep):
    for face in refs(arguments(ref(arguments(brep)[0]))[0]):
        for bound in refs(arguments(face)[0]):
            p = [point(n) for n in refs(arguments(ref(arguments(bound)[0]))[0])]
            yield from ((p[0], p[k], p[k + 1]) for k in range(1, len(p) - 1))


def brep(number):
    ray, ready = [0.1234, 0.4567, 0.8810], []
    for a, b, c in triangles(number):
        u, v = minus(b, a), minus(c, a)
        h = cross(ray, v)
        if abs(dot(u, h)) > 1e-12:
            ready.append((a, u, v, h, dot(u, h)))

    def holds(p):
        crossings = 0
        for a, u, v, h, det in ready:
            s = minus(p, a)
            x = dot(s, h) / det
            if 0 <= x <= 1:
                q = cross(s, u)
                y = dot(q, ray) / det
                crossings += y >= 0 and x + y <= 1 and dot(v, q) / det > 0
        return crossings % 2 == 1
    return holds


def solid(number):
    name, a = RECORDS[number][0], arguments(number)
    if name.startswith("IFCBOOLEAN"):
        first, second = solid(ref(a[1])), solid(ref(a[2]))
        if a[0] == ".DIFFERENCE.":
            return lambda p: first(p) and not second(p)
        return (lambda p: first(p) and second(p)) if a[0] == ".INTERSECTION." else (lambda p: first(p) or second(p))
    if name == "IFCEXTRUDEDAREASOLID":
        f, d, holds = frame(ref(a[1])), unit(ref(a[2]), [0, 0, 1]), profile(ref(a[0]))
        height = d[2] * float(a[3])

        def extruded(p):
            q = into(f, p)
            t = q[2] / d[2]
            return min(0, height) <= q[2] <= max(0, height) and holds(q[0] - t * d[0], q[1] - t * d[1])
        return extruded
    if name == "IFCFACETEDBREP":
        return brep(number)
    if name == "IFCMAPPEDITEM":   # neither scaled nor mirrored
        source, target = arguments(ref(a[0])), arguments(ref(a[1]))
        parts, origin = [solid(n) for n in refs(arguments(ref(source[1]))[3])], frame(ref(source[0]))
        x, z = unit(ref(target[0]), [1, 0, 0]), unit(ref(target[4]) if len(target) > 4 else None, [0, 0, 1])
        f = [x, cross(z, x), z], point(ref(target[2]))
        return lambda p: any(part(into(origin, into(f, p))) for part in parts)
    if "HALFSPACE" in name:
        plane, side = frame(ref(arguments(ref(a[0]))[0])), -1 if a[1] == ".T." else 1
        if name != "IFCPOLYGONALBOUNDEDHALFSPACE":
            return lambda p: into(plane, p)[2] * side >= 0
        f, holds = frame(ref(a[2])), polygon_holds(outline(ref(a[3])))
        return lambda p: into(plane, p)[2] * side >= 0 and holds(*into(f, p)[:2])
    raise SystemExit(f"#{number}={name} is not known here")


def corners(number):
    name, a = RECORDS[number][0], arguments(number)
    if name.startswith("IFCBOOLEAN"):
        return corners(ref(a[1]))
    if name == "IFCFACETEDBREP":
        return [p for t in triangles(number) for p in t]
    f, d, base = frame(ref(a[1])), unit(ref(a[2]), [0, 0, 1]), ref(a[0])
    if RECORDS[base][0].startswith("IFCARBITRARY"):
        flat = outline(ref(arguments(base)[2]))
    else:
        g, w = frame(ref(arguments(base)[2])), [float(x) / 2 for x in arguments(base)[3:5]]
        flat = [out_of(g, [x * w[0], y * w[1], 0]) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return [out_of(f, [p[0] + d[0] * t, p[1] + d[1] * t, d[2] * t]) for p in flat for t in (0, float(a[3]))]


def body(product):
    shapes = refs(arguments(ref(arguments(product)[6]))[2])
    return [item for s in shapes if arguments(s)[1] == "'Body'" for item in refs(arguments(s)[3])]


def to_world(placement):
    chain = []
    while placement:
        a = arguments(placement)
        chain.append(frame(ref(a[1])))
        placement = ref(a[0])
    return chain


def less_openings(product):
    """Whether a point of the product's frame is in its body and in none of its openings."""
    items, own = [solid(n) for n in body(product)], to_world(ref(arguments(product)[5]))
    tools = []
    for name, text in RECORDS.values():
        if name == "IFCRELVOIDSELEMENT" and refs(text)[-2] == product:
            opening = refs(text)[-1]
            tools.append((to_world(ref(arguments(opening)[5])), [solid(n) for n in body(opening)]))

    def holds(p):
        if not any(item(p) for item in items):
            return False
        world = p
        for f in own:
            world = out_of(f, world)
        for chain, parts in tools:
            q = world
            for f in reversed(chain):
                q = into(f, q)
            if any(part(q) for part in parts):
                return False
        return True
    return holds


def main():
    sys.setrecursionlimit(10000)
    item, count = int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 20000
    product = arguments(item)[0].startswith("'")
    box = [(min(c), max(c)) for c in zip(*(q for n in (body(item) if product else [item]) for q in corners(n)))]
    holds, rng = less_openings(item) if product else solid(item), random.Random(1)
    kept = [p for p in ([rng.uniform(*side) for side in box] for _ in range(count)) if holds(p)]
    whole, share = math.prod(b - a for a, b in box), len(kept) / count
    error = 2 * whole * math.sqrt(share * (1 - share) / count)
    print(f"{whole * share:.6g} +- {error:.2g} (95 %) cubic units; seen from", [round(min(c), 1) for c in zip(*kept)], "to", [round(max(c), 1) for c in zip(*kept)])


main()
