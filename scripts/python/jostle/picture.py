"""Pictures of scenes and recordings for notebooks, as SVG: seen from above, people coloured by their state."""
from __future__ import annotations

import html
import math
from pathlib import Path
from typing import NamedTuple, Optional, Sequence

import numpy as np

__all__ = ["COLOURS", "Drawing", "Outline", "Picture", "draw"]

# Colours that people with any colour vision tell apart (Okabe and Ito, 2008), for states without a colour of their own.
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#000000")
MOST_TITLES = 400  # people who are named where the mouse rests
MOST_NAMES = 8  # states in the legend
FOOT = 26  # pixels below the plan, for legend, scale and time
LABEL = 11  # pixels, height of letters


class Picture:
    """A still picture: what a notebook shows. `svg` is the picture alone, `below` what stands under it in a notebook."""

    def __init__(self, svg: str, below: str = "") -> None:
        self.svg, self.below = svg, below

    @property
    def html(self) -> str:
        """The picture and what stands under it."""
        return f'<div style="max-width:100%">{self.svg}{self.below}</div>'

    def _repr_svg_(self) -> str:
        return self.svg

    def _repr_html_(self) -> str:
        return self.html

    def save(self, path: str) -> None:
        """Writes the picture to a file, as SVG."""
        Path(path).write_text(self.svg, encoding="utf-8")


class Outline(NamedTuple):
    """Points x, y, m, of a wall, a place or a body. `name` is written beside it; `is_open`: a wall that lets people pass."""

    points: np.ndarray
    name: str = ""
    is_closed: bool = False
    is_open: bool = False
    radius: float = 0.0


class Drawing(NamedTuple):
    """What is drawn. People are columns: `x`, `y`, `radius`, m; `axis`, rows x, y: from the centre of a torso to the
    middle of a shoulder, m; `kind`, an index into `kinds`, names and colours; `titles` tell who somebody is."""

    walls: Sequence[Outline]
    places: Sequence[Outline]
    bodies: Sequence[Outline]
    x: np.ndarray
    y: np.ndarray
    radius: np.ndarray
    axis: np.ndarray
    kind: np.ndarray
    kinds: Sequence[tuple]
    titles: Sequence[str] = ()
    paths: Sequence[np.ndarray] = ()
    time: Optional[float] = None
    title: str = ""


class _Plan:
    """Metres of the drawing as pixels of the picture."""

    def __init__(self, drawing: Drawing, width: int, height: int) -> None:
        outlines = [o.points for group in (drawing.walls, drawing.places, drawing.bodies) for o in group if len(o.points)]
        round_ = [o.points + o.radius * side for o in drawing.places if len(o.points) == 1 for side in (-1.0, 1.0)]
        points = np.vstack([np.column_stack((drawing.x, drawing.y)), *outlines, *round_, *drawing.paths, np.zeros((0, 2))])
        points = points[np.isfinite(points).all(1)]
        low, high = (points.min(0) - 0.6, points.max(0) + 0.6) if len(points) else (np.zeros(2), np.ones(2))
        self.scale = min(width / (high[0] - low[0]), (height - FOOT) / (high[1] - low[1]))
        self.low, self.high = low, high
        self.width = width
        self.height = max(60, math.ceil((high[1] - low[1]) * self.scale)) + FOOT
        self.margin = 0.5 * (width - (high[0] - low[0]) * self.scale)

    def x(self, x: float) -> float:
        return self.margin + (x - self.low[0]) * self.scale

    def y(self, y: float) -> float:
        return (self.high[1] - y) * self.scale

    def points(self, points: np.ndarray) -> str:
        return " ".join(f"{self.x(px):.1f},{self.y(py):.1f}" for px, py in points)


def _line(plan: _Plan, outline: Outline, style: str, dash: str = "") -> str:
    tag = "polygon" if outline.is_closed else "polyline"
    return f'<{tag} points="{plan.points(outline.points)}" {style}{dash}/>'


def _draw_places(plan: _Plan, places: Sequence[Outline]) -> list:
    parts = []
    for place in places:
        if not len(place.points):
            continue
        if len(place.points) == 1:
            x, y = place.points[0]
            parts.append(f'<circle cx="{plan.x(x):.1f}" cy="{plan.y(y):.1f}" r="{max(place.radius * plan.scale, 3):.1f}" '
                         'fill="#e3edf7" stroke="#9db7d1"/>')
        else:
            parts.append(_line(plan, place, 'fill="#eef3f9" stroke="#9db7d1"', ' stroke-dasharray="3 3"'))
    return parts


def _name_places(plan: _Plan, places: Sequence[Outline]) -> list:
    """The names of places that have room for them, over people."""
    names = []
    for place in places:
        if not len(place.points):
            continue
        x, y = place.points.mean(0)
        width = (np.ptp(place.points[:, 0]) + 2 * place.radius) * plan.scale
        if width >= 5.5 * len(place.name) or len(place.points) == 1:
            names.append(f'<text x="{plan.x(x):.1f}" y="{plan.y(y) + 4:.1f}" text-anchor="middle" fill="#36506b" '
                         'stroke="#fff" stroke-opacity="0.8" stroke-width="3" paint-order="stroke" stroke-linejoin="round">'
                         f"{html.escape(place.name)}</text>")
    return names


def _draw_people(plan: _Plan, drawing: Drawing) -> list:
    """People as lines with round ends: a disc is a line of no length, a torso one between its shoulders."""
    parts = []
    diameter = np.maximum(np.round(2 * drawing.radius * plan.scale, 1), 2.0)
    steps = [(f"M{plan.x(x - ax):.1f} {plan.y(y - ay):.1f}" + (f"l{2 * ax * plan.scale:.1f} {-2 * ay * plan.scale:.1f}" if ax or ay else "h0"))
             for x, y, (ax, ay) in zip(drawing.x.tolist(), drawing.y.tolist(), drawing.axis.tolist())]
    is_titled = len(steps) == len(drawing.titles) <= MOST_TITLES
    for number, (_, colour) in enumerate(drawing.kinds):
        chosen = np.flatnonzero(drawing.kind == number)
        inner = []
        for size in np.unique(diameter[chosen]):
            of_size = chosen[diameter[chosen] == size]
            if is_titled:
                inner += [f'<path d="{steps[i]}" stroke-width="{size:.1f}"><title>{html.escape(drawing.titles[i])}</title></path>'
                          for i in of_size]
            else:
                inner.append(f'<path d="{"".join(steps[i] for i in of_size)}" stroke-width="{size:.1f}"/>')
        if inner:
            parts.append(f'<g class="people" stroke="{html.escape(colour)}" stroke-linecap="round" fill="none">{"".join(inner)}</g>')
    return parts


def _scale_length(plan: _Plan) -> float:
    """A round length, m, that is up to 120 pixels long."""
    most = 120 / plan.scale
    power = 10.0 ** math.floor(math.log10(most))
    return max(step * power for step in (1, 2, 5) if step * power <= most)


def _draw_foot(plan: _Plan, drawing: Drawing) -> list:
    """The legend of states, a scale of length, the time."""
    parts, at, y = [], 6.0, plan.height - 9
    time = "" if drawing.time is None else f"t = {drawing.time:.2f} s"
    length = _scale_length(plan)
    right = plan.width - 6 - 6.5 * len(time)
    x1 = right - (14 if time else 0)
    x0 = x1 - length * plan.scale
    number = f"{length:g} m"
    there = set(drawing.kind.tolist())
    names = [(name, colour) for n, (name, colour) in enumerate(drawing.kinds) if n in there]
    for n, (name, colour) in enumerate(names):
        room = x0 - 8 - 7 * len(number) - at
        left_out = len(names) - n
        if n == MOST_NAMES or room < 24 + 6.5 * len(name) + (40 if left_out > 1 else 0):
            parts.append(f'<text x="{at:.0f}" y="{y}" fill="#555">and {left_out} more</text>')
            break
        parts.append(f'<circle cx="{at + 5:.0f}" cy="{y - 4}" r="5" fill="{html.escape(colour)}"/>'
                     f'<text x="{at + 14:.0f}" y="{y}">{html.escape(name)}</text>')
        at += 26 + 6.5 * len(name)
    parts.append(f'<path d="M{x0:.1f} {y - 8}v8H{x1:.1f}v-8" fill="none" stroke="#333"/>'
                 f'<text x="{x0 - 5:.1f}" y="{y}" text-anchor="end">{number}</text>')
    if time:
        parts.append(f'<text x="{plan.width - 6}" y="{y}" text-anchor="end">{time}</text>')
    return parts


def draw(drawing: Drawing, width: int, height: int) -> str:
    """The picture as SVG, `width` pixels wide and at most `height` high; it shrinks where there is less room."""
    plan = _Plan(drawing, width, height)
    about = drawing.title + ("" if drawing.time is None else f" at {drawing.time:.2f} s")
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{plan.height}" '
             f'viewBox="0 0 {width} {plan.height}" style="max-width:100%;height:auto" font-family="sans-serif" '
             f'font-size="{LABEL}" role="img" aria-label="{html.escape(about)}, {len(drawing.x)} people seen from above">'
             f'<rect width="{width}" height="{plan.height}" fill="#fff"/>']
    parts += _draw_places(plan, drawing.places)
    parts += [_line(plan, body, 'fill="#b9a58a" stroke="#6b5b45"') for body in drawing.bodies]
    if drawing.paths:
        lines = "".join(f'M{plan.points(path).replace(" ", "L")}' for path in drawing.paths if len(path) > 1)
        parts.append(f'<path class="ways" d="{lines}" fill="none" stroke="#8a8a8a" stroke-opacity="0.35" stroke-width="0.8"/>')
    parts += [_line(plan, wall, f'fill="{"#444" if wall.is_closed else "none"}" stroke="#333" stroke-width="2" stroke-linejoin="round"'
                    if not wall.is_open else 'fill="none" stroke="#999" stroke-width="1.5"',
                    ' stroke-dasharray="2 4"' if wall.is_open else "") for wall in drawing.walls]
    parts += _draw_people(plan, drawing)
    parts += _name_places(plan, drawing.places)
    parts += _draw_foot(plan, drawing)
    return "".join(parts) + "</svg>"
