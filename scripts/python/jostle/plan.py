"""What pictures of scenes and recordings show: walls, places, bodies, people and their states."""
from __future__ import annotations

import json
import re
import sqlite3
from typing import TYPE_CHECKING, Any

import numpy as np

from ._library import ffi, lib, text_of
from .picture import COLOURS, Drawing, Outline, Picture, draw
from .table import html_table

if TYPE_CHECKING:
    from .recording import Recording
    from .scene import Scene

__all__ = ["picture_of_recording", "picture_of_scene", "plan_of"]

PATH_POINTS = 40000  # of all paths of a picture


def plan_of(scene: "Scene") -> dict:
    """What a scene has besides people, as jo_scene_plan tells; empty with the engine's library alone."""
    try:
        text = lib.jo_scene_plan
    except AttributeError:
        return {}
    pointer = text(scene._scene)
    if not pointer:
        return {}
    try:
        return json.loads(text_of(pointer))
    finally:
        lib.jo_free(pointer)


def _points(points: Any) -> np.ndarray:
    return np.array(points, dtype=float).reshape(-1, 2)


def _standing_walls(scene: "Scene") -> list:
    count = lib.jo_world_walls(scene._live(), ffi.NULL, 0)
    edges = np.empty((count, 4))
    lib.jo_world_walls(scene._live(), ffi.from_buffer("double *", edges), count)
    return [Outline(edge.reshape(2, 2)) for edge in edges]


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
        corners = lib.jo_body_outline(scene._live(), body, ffi.from_buffer("double *", points), 64)
        if corners:
            outlines.append(Outline(points[:corners], is_closed=True))
    return outlines


def _kinds(scene: "Scene", plan: dict) -> dict:
    """Name and colour by (machine, state); people without a machine are grey."""
    kinds: dict = {}
    for entry in plan.get("states", []):
        machine = entry["machine"]
        kinds[machine, sum(m == machine for m, _ in kinds)] = (entry["name"], entry["colour"])
    pairs = np.unique(np.column_stack((scene["machine"], scene["state"])), axis=0).tolist()
    for n, pair in enumerate(map(tuple, pairs)):
        if pair not in kinds:
            name = text_of(lib.jo_world_state_name(scene._live(), *pair))
            kinds[pair] = (name or "people", COLOURS[n % len(COLOURS)] if name else "#777777")
    return kinds


def _count_states(scene: "Scene", kinds: dict, kind: np.ndarray) -> str:
    """A table of HTML: in each state so many people, and how fast they are."""
    speed = np.hypot(scene["vx"], scene["vy"])
    rows, marks = [], []
    for number, (name, colour) in enumerate(kinds.values()):
        chosen = kind == number
        if chosen.any():
            rows.append([name, int(chosen.sum()), float(speed[chosen].mean())])
            marks.append(colour)
    rows.append(["all people", len(scene), float(speed.mean()) if len(scene) else None])
    return html_table(["state", "people", "mean speed [m/s]"], rows, f"{scene.title} at {scene.time:.2f} s", marks=marks + [""])


def picture_of_scene(scene: "Scene", width: int, height: int) -> Picture:
    """How a scene stands, and below how many people are in each state."""
    plan = plan_of(scene)
    kinds = _kinds(scene, plan)
    numbers = {pair: n for n, pair in enumerate(kinds)}
    machine, state = scene["machine"].tolist(), scene["state"].tolist()
    kind = np.array([numbers[pair] for pair in zip(machine, state)], dtype=int)
    names = [name for name, _ in kinds.values()]
    speed = np.hypot(scene["vx"], scene["vy"])
    contact = scene["contact_radius"]
    walls = [Outline(_points(wall["points"]), wall["name"] or "", wall["solid"], wall["open"]) for wall in plan["walls"]
             ] if plan else _standing_walls(scene)
    places = [Outline(_points(place["points"]), place["name"], place["kind"] == "polygon", False, place["radius"])
              for place in plan.get("places", [])]
    drawing = Drawing(
        walls, places, _bodies(scene), scene["x"].astype(float), scene["y"].astype(float),
        np.where(contact > 0, contact, scene["radius"]).astype(float), np.column_stack((scene["axis_x"], scene["axis_y"])).astype(float),
        kind, list(kinds.values()),
        [f"agent {who}: {names[k]}, {pace:.1f} m/s" for who, k, pace in zip(scene["id"], kind, speed)], time=scene.time, title=scene.title)
    return Picture(draw(drawing, width, height), _count_states(scene, kinds, kind))


# ---- recordings ----


def _read_rows(database: sqlite3.Connection, table: str, columns: str) -> list:
    """Rows of a table of Jostle's recordings; none where a recording of others lacks it."""
    if not database.execute("SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name = ?", (table,)).fetchone():
        return []
    return database.execute(f"SELECT {columns} FROM {table}").fetchall()


def _recorded_walls(database: sqlite3.Connection, frame: int) -> list:
    """The newest of each wall up to a frame; else the rings of the recorded geometry."""
    newest: dict = {}
    for at, number, name, solid, is_open, points in sorted(_read_rows(
            database, "jostle_wall", "frame, number, name, solid, open, points"), key=lambda row: row[0]):
        if at <= frame:
            numbers = np.array(re.findall(r"[-+.\deE]+", points or ""), dtype=float)
            newest[number] = Outline(numbers[:len(numbers) // 2 * 2].reshape(-1, 2), name or "", bool(solid), bool(is_open))
    if newest:
        return [wall for wall in newest.values() if len(wall.points) > 1]
    rings = [re.findall(r"[-+.\deE]+", ring) for (wkt,) in _read_rows(database, "geometry", "wkt")[:1]
             for ring in re.findall(r"\(([^()]+)\)", wkt or "")]
    return [Outline(np.array(ring, dtype=float).reshape(-1, 2)) for ring in rings if len(ring) % 2 == 0]


def picture_of_recording(recording: "Recording", time: Any, paths: bool, width: int, height: int) -> Picture:
    """How people of a recording stood at a time, s, and with `paths` the ways that they took until then."""
    frames = list(recording.frames())
    chosen = frames[-1] if frames else (0, slice(0, 0))
    for frame in frames:
        if time is not None and frame[0] / recording.fps <= time + 1e-9:
            chosen = frame
    if time is not None and frames and frames[0][0] / recording.fps > time:
        chosen = frames[0]
    number, rows = chosen
    with recording.opened() as database:
        states = {row[0]: (row[1] or "people", row[2] or "") for row in _read_rows(database, "jostle_state", "number, state, colour")}
        walls = _recorded_walls(database, number)
    x, y, ids = (recording[name] for name in ("x", "y", "id"))
    has_states = bool(states) and "state" in recording.names()
    there = recording["state"][rows] if has_states else np.zeros(rows.stop - rows.start, int)
    kinds = [(states.get(s, ("people", ""))[0], states.get(s, ("", ""))[1] or COLOURS[n % len(COLOURS)])
             for n, s in enumerate(sorted(set(there.tolist())))]
    numbers = {s: n for n, s in enumerate(sorted(set(there.tolist())))}
    kind = np.array([numbers[s] for s in there.tolist()], dtype=int)
    radius = recording["radius"][rows].astype(float) if "radius" in recording.names() else np.full(len(kind), 0.2)
    radius[~(radius > 0)] = 0.2
    axis = np.zeros((len(kind), 2))
    if {"chest", "breadth", "depth"} <= set(recording.names()):  # torsos: two shoulders, half a depth about each
        chest, breadth, depth = (recording[name][rows].astype(float) for name in ("chest", "breadth", "depth"))
        is_torso = breadth > 0
        reach = np.where(is_torso, 0.5 * (breadth - depth), 0.0)
        axis = np.column_stack((-np.sin(chest) * reach, np.cos(chest) * reach))
        axis[~is_torso] = 0.0
        radius = np.where(is_torso, 0.5 * depth, radius)
    drawn = []
    if paths:
        past = slice(0, rows.stop)
        order = np.lexsort((recording["frame"][past], ids[past]))
        every = max(1, len(order) // PATH_POINTS)
        for one in np.split(order, np.flatnonzero(np.diff(ids[past][order])) + 1):
            kept = np.r_[one[::every], one[-1:]]
            drawn.append(np.column_stack((x[kept], y[kept])))
    drawing = Drawing(walls, [], [], x[rows].astype(float), y[rows].astype(float), radius, axis, kind, kinds,
                      [f"agent {who}: {kinds[k][0]}" for who, k in zip(ids[rows].tolist(), kind)], drawn,
                      number / recording.fps, recording.title)
    table = html_table(["figure", "value"], [
        ["recorded from [s]", frames[0][0] / recording.fps if frames else None], ["recorded until [s]", frames[-1][0] / recording.fps if frames else None],
        ["frames", len(frames)], ["frames a second [1/s]", recording.fps], ["people", len(np.unique(ids))], ["people at this time", len(kind)]],
        f"{recording.title} at {number / recording.fps:.2f} s")
    return Picture(draw(drawing, width, height), table)
