#!/usr/bin/env python3
"""Drapes the examples and writes docs/gallery.md with a picture of each: make_gallery.py PROGRAM [NAME ...]

Lists only what came to rest with a clean certificate and kept its expectations; says what it left out. With names only these are
draped, the rest of the page stays. Uses nothing but the standard library of Python.
"""
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "docs", "gallery.md")
LIMIT = 80_000  # bytes of a picture
VIEWS = ("front", "side", "back")
BY_HAND = "\n## The ends of the size tables\n"

HEAD = """# What drapes

<!-- made by `./dev gallery`: facts are those of the run that made the picture -->

Each picture is one run of a script in [examples](../examples) with its own defaults: from the front, the wearer's left and behind, or
the front alone where nobody wears it. *At rest* means that the forces on the particles are down to 5 % of their weight and a Newton
step moves nothing by more than half a millimetre; the certificate is the exact test of the written coordinates: triangles of cloth that
cut one another, that cut the body, corners inside the body. The strain is the largest of warp and weft; the 99th percentile says what
the cloth bears as a whole. Seconds are those of the drape alone.
"""


def read_png(path):
    """Width, height and rows of RGB of an 8 bit PNG of colour type 2 or 6."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    width = height = channels = 0
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", body[:10])
            channels = {2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, stride = zlib.decompress(packed), width * channels
    rows, before = [], bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for x in range(stride):
            a = row[x - channels] if x >= channels else 0
            b, c = before[x], before[x - channels] if x >= channels else 0
            if kind == 1:
                row[x] = (row[x] + a) & 255
            elif kind == 2:
                row[x] = (row[x] + b) & 255
            elif kind == 3:
                row[x] = (row[x] + (a + b) // 2) & 255
            elif kind == 4:
                p = a + b - c
                pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                row[x] = (row[x] + (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255
        before = row
        rows.append(row if channels == 3 else bytearray(v for k, v in enumerate(row) if k % 4 < 3))
    return width, height, rows


def shrink(picture, by, levels):
    """The mean of every square of `by` pixels, in steps of `levels`."""
    width, height, rows = picture
    out = []
    for y in range(height // by):
        row = bytearray()
        for x in range(width // by):
            for channel in range(3):
                total = sum(rows[y * by + j][(x * by + i) * 3 + channel] for j in range(by) for i in range(by))
                row.append(min(255, (total // (by * by) + levels // 2) // levels * levels))
        out.append(row)
    return width // by, height // by, out


def write_png(path, picture):
    width, height, rows = picture
    raw, before = bytearray(), bytearray(width * 3)
    for row in rows:
        raw.append(2)
        raw += bytes((v - b) & 255 for v, b in zip(row, before))
        before = row

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    data += chunk(b"IDAT", zlib.compress(bytes(raw), 9)) + chunk(b"IEND", b"")
    with open(path, "wb") as file:
        file.write(data)
    return len(data)


def beside(pictures):
    height = min(p[1] for p in pictures)
    rows = [bytearray().join(p[2][y] for p in pictures) for y in range(height)]
    return sum(p[0] for p in pictures), height, rows


def cut(picture, left, top, right, bottom):
    width, height, rows = picture
    x0, x1, y0, y1 = int(left * width), int(right * width), int(top * height), int(bottom * height)
    return x1 - x0, y1 - y0, [row[3 * x0 : 3 * x1] for row in rows[y0:y1]]


def make_picture(files, name, by):
    """The views beside each other; those of a study cut to what is looked at, by half the size instead of a third."""
    views = [read_png(file) for file in files]
    if by == 2:
        views = [cut(view, 0.16, 0.08, 0.84, 0.6) for view in views]
    path = os.path.join(ROOT, "docs", "pictures", name + ".png")
    for levels in (4, 6, 8, 12, 16):
        if write_png(path, beside([shrink(view, by, levels) for view in views])) < LIMIT:
            return
    raise SystemExit(f"{path} is larger than {LIMIT} bytes")


def entry(program, name):
    """The page's part about one example, or None with the reason."""
    script = os.path.join(ROOT, "examples", name + ".garment")
    with open(script, encoding="utf-8") as file:
        text = file.read()
    study = re.search(r"^vary (\S+) over", text, re.M)
    if not study and not re.search(r"^drape ", text, re.M):
        return None, "has no drape"
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", script, "--library", os.path.join(ROOT, "stdlib"), "-o", folder, "-q"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        except subprocess.TimeoutExpired:
            return None, "takes more than 10 minutes"
        if done.returncode != 0:
            reason = next((line for line in done.stderr.splitlines() if line.startswith("error")), f"exit {done.returncode}")
            return None, reason
        worn = re.search(r"^body \w+ = bodies\.", text, re.M)
        views = [os.path.join(folder, view + ".png") for view in (VIEWS if worn else VIEWS[:1])]
        rounds = [folder]
        if study:
            rounds = sorted(os.path.join(folder, f) for f in os.listdir(folder) if f.startswith(study.group(1) + "="))
            views = [os.path.join(one, "front.png") for one in rounds]
        make_picture(views, name, 2 if study else 3)
        facts = [facts_of(one, os.path.basename(one).replace("=", " ") + ": " if study else "") for one in rounds]
    title = re.search(r'^garment 1 "(.*)"', text, re.M).group(1)
    lines = len(text.splitlines())
    said = " " + facts[0] if len(facts) == 1 else "\n\n- " + "\n- ".join(facts)
    return f"## {title}\n\n![{title}](pictures/{name}.png)\n\n[{name}.garment](../examples/{name}.garment), {lines} lines:{said}\n", ""


def facts_of(folder, before):
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    drape, strain = report["drape"], report["garment"]["strain"]
    measures = "".join(f"; {m['name']} {m['shown']}" for m in report["measures"] if "shown" in m)
    return before + (
        f"{report['particles']:,} particles, {drape['steps']} steps, {report['timings']['seconds']['drape']:.1f} s; strain "
        f"{100 * strain['largest']:.1f} % at most, 99th percentile {100 * strain['p99']:.1f} %; residual "
        f"{drape['residual_over_weight']:.3f} of the weight; {drape['self_intersections']} self-intersections, "
        f"{drape['body_intersections']} of the body, {drape['inside_body']} corners inside it{measures}."
    )


def page():
    if not os.path.exists(PAGE):
        return ""
    with open(PAGE, encoding="utf-8") as file:
        return file.read()


def parts_of_page():
    parts = page().split("\n## ")[1:]
    return {m.group(1): "## " + p.rstrip() + "\n" for p in parts if (m := re.search(r"\(\.\./examples/(\w+)\.garment\)", p))}


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    program, asked = sys.argv[1], sys.argv[2:]
    names = sorted(f[:-8] for f in os.listdir(os.path.join(ROOT, "examples")) if f.endswith(".garment"))
    parts = parts_of_page() if asked else {}
    by_hand = page().partition(BY_HAND)[1:]  # what is written by hand stays
    for name in asked or names:
        part, reason = entry(program, name)
        print(f"{name}: {'at rest' if part else 'left out, ' + reason}", flush=True)
        if part:
            parts[name] = part
        else:
            parts.pop(name, None)
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write(HEAD + "".join("\n" + parts[one] for one in names if one in parts) + "".join(by_hand))


main()
