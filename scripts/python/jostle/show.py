"""Pictures of a scene for notebooks, and its live page in a frame."""
from __future__ import annotations

import html
import os
import re
import shutil
import subprocess
import weakref
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ._library import Error, ffi, lib, text_of

if TYPE_CHECKING:
    from .scene import Scene

# Colours that people with any colour vision tell apart (Okabe and Ito, 2008).
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#000000")


class Picture:
    """What a notebook shows: `svg` of a still picture, `html` of a live page, whose run ends with `stop`."""

    def __init__(self, svg: str = "", html: str = "", process: "subprocess.Popen | None" = None) -> None:
        self.svg, self.html, self._process = svg, html, process
        if process:
            weakref.finalize(self, process.terminate)

    def stop(self) -> None:
        """Ends the run of a live page."""
        if self._process:
            self._process.terminate()
            self._process.wait()

    def _repr_html_(self) -> str:
        return self.html or self.svg

    def save(self, path: str) -> None:
        """Writes the still picture to a file."""
        Path(path).write_text(self.svg, encoding="utf-8")


def _walls(scene: "Scene") -> np.ndarray:
    count = lib.jo_world_walls(scene._live(), ffi.NULL, 0)
    edges = np.empty((count, 4))
    lib.jo_world_walls(scene._live(), ffi.from_buffer("double *", edges), count)
    return edges


def _bodies(scene: "Scene") -> list:
    outlines, found, slot = [], 0, 0
    count = lib.jo_world_body_count(scene._live())
    while found < count:
        body = lib.jo_world_body_at(scene._live(), slot)
        slot += 1
        if not body.generation:
            continue
        found += 1
        points = np.empty((64, 2))
        outlines.append(points[: lib.jo_body_outline(scene._live(), body, ffi.from_buffer("double *", points), 64)])
    return [outline for outline in outlines if len(outline)]


def picture_of(scene: "Scene", width: int, height: int) -> Picture:
    """From above: walls, bodies, and people coloured by their state, with a legend."""
    x, y, radius, machine, state = (scene[name] for name in ("x", "y", "radius", "machine", "state"))
    walls, bodies = _walls(scene), _bodies(scene)
    points = np.vstack([np.column_stack((x, y)), walls[:, :2], walls[:, 2:], *bodies, np.zeros((0, 2))])
    low, high = (points.min(0) - 1, points.max(0) + 1) if len(points) else (np.zeros(2), np.ones(2))
    scale = min(width / (high[0] - low[0]), (height - 24) / (high[1] - low[1]))

    def place(px: float, py: float) -> str:
        return f"{(px - low[0]) * scale:.1f},{(high[1] - py) * scale:.1f}"

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif">'
             f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for outline in bodies:
        parts.append(f'<polygon points="{" ".join(place(*p) for p in outline)}" fill="#b9a58a" stroke="#6b5b45"/>')
    for x0, y0, x1, y1 in walls:
        parts.append(f'<polyline points="{place(x0, y0)} {place(x1, y1)}" stroke="#333" stroke-width="2" fill="none"/>')
    kinds = sorted(set(zip(machine.tolist(), state.tolist())))
    names = []
    for n, (m, s) in enumerate(kinds):
        colour = COLOURS[n % len(COLOURS)]
        name = text_of(lib.jo_world_state_name(scene._live(), m, s)) or "people"
        names.append((colour, name))
        circles = []
        for i in np.flatnonzero((machine == m) & (state == s)):
            cx, cy = place(x[i], y[i]).split(",")
            circles.append(f'<circle cx="{cx}" cy="{cy}" r="{max(radius[i] * scale, 1):.1f}"/>')
        parts.append(f'<g fill="{colour}">{"".join(circles)}</g>')
    at = 8
    for colour, name in names[:8]:
        parts.append(f'<circle cx="{at + 5}" cy="{height - 11}" r="5" fill="{colour}"/>'
                     f'<text x="{at + 14}" y="{height - 7}" font-size="12">{html.escape(name)}</text>')
        at += 30 + 7 * len(name)
    parts.append(f'<text x="{width - 8}" y="{height - 7}" font-size="12" text-anchor="end">t = {scene.time:.2f} s</text></svg>')
    return Picture(svg="".join(parts))


def _program() -> str:
    """The command `jostle`: JOSTLE, the one on the path, or the one of this tree."""
    tree = [str(folder / "build" / "release" / "jostle") for folder in Path(__file__).resolve().parents]
    for name in [os.environ.get("JOSTLE"), shutil.which("jostle"), *tree]:
        if name and os.access(name, os.X_OK):
            return name
    raise Error("the command jostle was not found; JOSTLE may name it", 2)


def live_page(scene: "Scene", width: int, height: int) -> Picture:
    """The live page of a run of the same scene, seed and values, from its beginning."""
    from .scene import _written

    command = [_program(), "run", scene.path, "--view", "--quiet"]
    if scene.seed is not None:
        command += ["--seed", str(scene.seed)]
    for key, value in scene.overrides.items():
        command += ["--set", f"{key}={_written(value)}"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    said = []
    for line in process.stdout or ():
        said.append(line)
        address = re.search(r"http://\S+", line)
        if address:
            frame = f'<iframe src="{html.escape(address[0])}" width="{width}" height="{height}" style="border:0"></iframe>'
            return Picture(html=frame, process=process)
    process.wait()
    raise Error("the live page did not open: " + "".join(said).strip())
