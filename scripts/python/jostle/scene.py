"""A scene that runs, its agents and bodies."""
from __future__ import annotations

import json
import math
import operator
import os
import sys
import weakref
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from ._events import Events, events_of
from ._library import Error, check, ffi, lib, named, path_named, scene_file, text_of, told, whole
from ._words import Word, Words, column_of
from .live import LivePage, open_page
from .picture import Picture
from .plan import picture_of_scene, plan_of
from .table import Table, frame_of

__all__ = ["Agent", "Body", "Scene", "Stair", "Storey", "Where"]

def _written(value: Any) -> str:
    """A value as `jostle run --set` takes it."""
    if isinstance(value, (list, tuple, dict, np.ndarray)):
        raise TypeError(f"a key is set to a number, a text or a truth value, not to {value!r}")
    return value if isinstance(value, str) else json.dumps(value, default=_plain)


def _plain(value: Any) -> Any:
    """A number of NumPy as one of Python."""
    return value.item() if isinstance(value, np.generic) else float(value)


# Units of columns that are no parameters.
UNITS = {"x": "m", "y": "m", "vx": "m/s", "vy": "m/s", "axis_x": "m", "axis_y": "m", "contact_radius": "m", "spin": "rad/s",
         "pref_x": "m/s", "pref_y": "m/s", "force_x": "N", "force_y": "N", "compression": "N/m", "load": "N", "density": "1/m2"}

FARTHEST = 1e4  # m, from the origin


def _within(what: str, least: float, most: float, *numbers: float) -> None:
    for number in numbers:
        if not least <= number <= most:
            raise ValueError(f"{what} is from {least:g} to {most:g}, not {number!r}")


def _vector(numbers: Optional[Sequence[float]], count: int) -> Any:
    if numbers is None:
        return ffi.NULL
    if len(numbers) != count:
        raise ValueError(f"expected {count} numbers, not {len(numbers)}")
    return ffi.new("double[]", [float(n) for n in numbers])


class Storey(NamedTuple):
    """A storey: its name, and the height of its floor, m."""

    name: str
    height: float


class Stair(NamedTuple):
    """A stair, ramp or escalator: `lower` and `upper` are numbers of storeys, `width`, `length` (in plan) and `rise` m, `belt` m/s
    along the slope of an escalator, upwards positive, else 0."""

    name: str
    lower: int
    upper: int
    width: float
    length: float
    rise: float
    belt: float
    closed: bool


class Lift(NamedTuple):
    """A lift and its car: `capacity`, `people` in the car and those `waiting` before a door; the number of the `storey` where it
    stands or which it left, its `height` in m, the share of its door that is `open`, and its mode, one of `LIFT_MODES`."""

    name: str
    mode: str
    capacity: int
    people: int
    waiting: int
    storey: int
    moves: bool
    height: float
    open: float


# As the library numbers them.
LIFT_MODES = ("in_use", "out_of_use", "firemen")


class Where(NamedTuple):
    """A point in plan, m: the height of the floor there (of an agent in a lift, of its car), the number of the storey (on a stair
    that which is nearer in height), and the number of the stair or None. Of an agent also the number of the lift that it uses or
    None, how it does, one of `RIDES`, and since when it has waited, or ridden, in s of simulated time (else None)."""

    x: float
    y: float
    height: float
    storey: int
    stair: Optional[int]
    lift: Optional[int]
    ride: str
    since: Optional[float]


# As the library has it.
WHERE = np.dtype([("x", "f8"), ("y", "f8"), ("height", "f8"), ("storey", "u4"), ("stair", "u4"), ("lift", "u4"), ("ride", "u4"),
                  ("since", "f8")])
RIDES = ("none", "approaches", "waits", "rides")
NO_STAIR = NO_LIFT = 2**32 - 1


def _where(where: Any) -> Where:
    return Where(where.x, where.y, where.height, where.storey, None if where.stair == NO_STAIR else where.stair,
                 None if where.lift == NO_LIFT else where.lift, RIDES[where.ride], None if np.isnan(where.since) else where.since)


class Hit(NamedTuple):
    """What a ray or disc met: `kind` is "agent", "body" or "wall"; `what` an id, a slot or a wall's edge."""

    kind: str
    what: int
    share: float
    x: float
    y: float
    normal: tuple


class Scene:
    """A scene of a YAML file, or a shipped one by its name, as "evacuation". Every error of loading goes to `message`, the first is raised as an Error.

    seed, dt: in place of the scene's (dt in s). set: keys of the scene and their values, as `jostle run --set`.
    threads: 0 are all processors; they never change a result. mods: folders or names of mods, and no others.
    input_log: a file of what people and programs did, played back. message: is told what is to be said to people;
    by default it goes to stderr. words: what behaviours can use besides the language's own (Word). One scene must not be used by two threads at once, and is neither copied nor pickled.
    """

    def __init__(self, path: Union[str, Path], seed: Optional[int] = None, set: Optional[Mapping[str, Any]] = None,
                 dt: Optional[float] = None, threads: int = 0, mods: Sequence[str] = (),
                 input_log: Union[str, Path, None] = None, message: Optional[Callable[[str], Any]] = None,
                 density: bool = True, words: Sequence[Word] = ()) -> None:
        if getattr(self, "_scene", None):
            raise Error("the scene is loaded already", 2)
        if isinstance(mods, (str, bytes)):
            raise TypeError(f"mods are a list of folders or names, not the text {mods!r}")
        self._scene = self._page = ffi.NULL
        self._busy = self._finished = self._recorded = False
        path = scene_file(path)
        name = path_named(path)
        self.path, self.seed, self.overrides = os.fsdecode(path), seed, dict(set or {})
        say = message or sys.stderr.write
        self._message = ffi.callback("void(void *, const char *)", lambda _context, text: (say(text_of(text)), None)[1])
        definition = ffi.new("JoSceneDef *", lib.jo_default_scene_def())
        kept = [ffi.new("char[]", name)]
        definition.path = kept[0]
        overrides = [ffi.new("char[]", named(f"{key}={_written(value)}")) for key, value in self.overrides.items()]
        names = [ffi.new("char[]", path_named(mod)) for mod in mods]
        kept += [ffi.new("char *[]", overrides or [ffi.NULL]), ffi.new("char *[]", names or [ffi.NULL])]
        definition.overrides, definition.override_count = ffi.cast("const char *const *", kept[1]), len(overrides)
        definition.mods, definition.mod_count = ffi.cast("const char *const *", kept[2]), len(names)
        definition.named_mods_only, definition.no_density = True, not density
        definition.threads, definition.message = whole("threads", threads, 2**32 - 1), self._message
        self._words = Words(words, self._acting)
        definition.words, definition.word_count = self._words.array, self._words.count
        if seed is not None:
            definition.has_seed, definition.seed = True, whole("a seed", seed)
        if dt is not None:
            definition.has_dt, definition.dt = True, dt
        if input_log is not None:
            kept.append(ffi.new("char[]", path_named(input_log)))
            definition.input_log = kept[-1]
        self._error = ffi.new("JoError *")
        self._scene = check(lib.jo_scene_load(definition, self._error), self._error)
        self._world = lib.jo_scene_world(self._scene)
        self._raise_failure()

    # ---- its life ----

    def close(self) -> None:
        """Ends it and frees it. Arrays that were read from it remain."""
        if self._scene:
            self._live()
            self._close_page()
            closed, self._scene, self._world = self._scene, ffi.NULL, ffi.NULL
            lib.jo_scene_free(closed)

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_scene", None):
            self._close_page()
            lib.jo_scene_free(self._scene)

    def __reduce_ex__(self, _protocol: Any) -> Any:
        """Also what copy.copy and copy.deepcopy call: two objects would free one scene."""
        raise TypeError("a scene is neither copied nor pickled: load it anew, and give that its state by "
                        "restore(scene.snapshot())")

    def _live(self) -> Any:
        """The world; refuses where the scene is closed, or a call of it is under way: in another thread, or the one that
        gives a message to the function that asks."""
        if not self._scene:
            raise Error("the scene is closed", 2)
        if self._busy:
            raise Error("another call of this scene is under way", 2)
        return self._world

    def _do(self, call: Any, *arguments: Any) -> Any:
        """A call of the library that takes a JoError at its end. Other Python threads run meanwhile."""
        self._live()
        self._busy = True
        try:
            result = call(*arguments, self._error)
        finally:
            self._busy = False
        return check(result, self._error)

    def _acting(self, begins: bool) -> None:
        """An action of the program may use the scene, within the call that steps it."""
        self._busy = not begins

    def _raise_failure(self) -> None:
        failure, self._words.failure = self._words.failure, None
        if failure:
            raise failure

    # ---- stepping ----

    def _going(self) -> None:
        self._live()
        if self._finished:
            raise Error("the scene is finished: nothing is done to it any more", 2)

    def step(self, steps: int = 1) -> None:
        """Advances by so many steps, 0 or more. Other Python threads run meanwhile."""
        for _ in range(whole("a number of steps", steps)):
            self._going()
            self._do(lib.jo_scene_step, self._scene)
            self._raise_failure()
            if self._page:
                lib.jo_live_show(self._page)

    def run(self, seconds: Optional[float] = None) -> "Scene":
        """Advances by simulated seconds, to the nearest step; without, until the scene's duration is over."""
        self._live()
        if seconds is not None:
            _within("a time to run, s,", 0.0, 1e9, seconds)
        left = max(0.0, lib.jo_scene_duration(self._scene) - self.time) if seconds is None else seconds
        if not math.isfinite(left):
            raise ValueError("the scene gives no duration: say how many seconds it runs")
        self.step(round(left / self.dt))
        return self

    @property
    def title(self) -> str:
        """The scene's title, or the name of its file."""
        return plan_of(self).get("title") or os.path.basename(self.path)

    @property
    def time(self) -> float:
        """Simulated seconds so far."""
        return lib.jo_world_time(self._live())

    @property
    def tick(self) -> int:
        """Steps done."""
        return lib.jo_world_tick(self._live())

    @property
    def dt(self) -> float:
        """Seconds of a step."""
        self._live()
        return lib.jo_scene_stats(self._scene).dt

    @property
    def hash(self) -> str:
        """Of the whole state, as 16 hex digits: equal for equal input at any number of threads."""
        return f"{lib.jo_world_hash(self._live()):016x}"

    def __len__(self) -> int:
        return lib.jo_world_agent_count(self._live())

    # ---- what is there ----

    def __getitem__(self, name: str) -> np.ndarray:
        """A column, one number for each agent, as it is now: a read-only copy, which later steps do not change and
        which outlives the scene. Agents change their places as they walk; `scene["id"]` says who is who."""
        copy = column_of(self._live(), name).copy()
        copy.flags.writeable = False
        return copy

    def columns(self) -> list:
        """Names of all columns."""
        names, n = [], 0
        while True:
            name = text_of(lib.jo_column_name(n))
            if not name:
                return names
            names.append(name)
            n += 1

    def positions(self) -> np.ndarray:
        """Rows x, y of all agents, m, in plan, in the order of `scene["id"]`; `where()` has their storeys."""
        if self.storeys:
            where = self.where()
            return np.column_stack((where["x"], where["y"]))
        return np.column_stack((self["x"], self["y"]))

    @property
    def storeys(self) -> list:
        """The storeys, from the lowest up; empty without any. In a scene with storeys the columns "x" and "y" are points of one
        plane, in which storeys are moved along y: `where()` and `positions()` are in plan."""
        world = self._live()
        return [Storey(text_of(lib.jo_world_storey_name(world, n)), lib.jo_world_storey_height(world, n))
                for n in range(lib.jo_world_storey_count(world))]

    @property
    def stairs(self) -> list:
        """The stairs, ramps and escalators."""
        world = self._live()
        found = (lib.jo_world_stair(world, n) for n in range(lib.jo_world_stair_count(world)))
        return [Stair(text_of(s.name), s.lower, s.upper, s.width, s.length, s.rise, s.belt, s.closed) for s in found]

    @property
    def lifts(self) -> list:
        """The lifts, with their cars as they are at present."""
        world = self._live()
        found = (lib.jo_world_lift(world, n) for n in range(lib.jo_world_lift_count(world)))
        return [Lift(text_of(at.name), LIFT_MODES[at.mode], at.capacity, at.people, at.waiting, at.storey, at.moves, at.height,
                     at.open) for at in found]

    def storey(self, storey: Union[int, str]) -> int:
        """The number of a storey that is given by name or number. KeyError where there is none."""
        names = [one.name for one in self.storeys]
        if isinstance(storey, str):
            if storey in names:
                return names.index(storey)
        elif 0 <= operator.index(storey) < max(len(names), 1):
            return operator.index(storey)
        raise KeyError(storey)

    def where(self) -> np.ndarray:
        """Where all agents are, in the order of `scene["id"]`: an array with the fields x, y (m, in plan), height (m, of the
        floor there, or of a lift's car), storey (its number; on a stair that which is nearer in height), stair (its number;
        2**32 - 1: none), lift that the agent uses (likewise), ride (an index of `RIDES`) and since (s: when it called the lift, or
        came into the car; else NaN)."""
        out = np.zeros(len(self), WHERE)
        lib.jo_world_wheres(self._live(), ffi.from_buffer("JoWhere *", out), len(out))
        return out

    def states(self) -> np.ndarray:
        """The name of each agent's state."""
        machine, state = self["machine"], self["state"]
        names = {(m, s): text_of(lib.jo_world_state_name(self._world, int(m), int(s)))
                 for m, s in np.unique(np.column_stack((machine, state)), axis=0)}
        return np.array([names[pair] for pair in zip(machine, state)])

    def table(self, names: Optional[Sequence[str]] = None, units: bool = False) -> Any:
        """Columns as a pandas DataFrame where pandas is installed, else as a Table: a dict of arrays. Besides the columns
        there are "state_name" and "group_name". Units are in `attrs["units"]` of the DataFrame, or in `units` of the
        Table; with `units` in the names: "x [m]"."""
        chosen = {}
        for name in names or ("id", "x", "y", "vx", "vy", "group", "state", "state_name"):
            chosen[name] = self.states() if name == "state_name" else self._groups() if name == "group_name" else self[name].copy()
        return frame_of(chosen, self.units(), f"{self.title} at {self.time:.2f} s", units)

    def _groups(self) -> np.ndarray:
        group = self["group"]
        names = {g: text_of(lib.jo_world_group_name(self._world, g)) for g in np.unique(group).tolist()}
        return np.array([names[g] for g in group.tolist()], dtype=object)

    def units(self) -> dict:
        """The unit of each column that has one."""
        parameters = {entry["name"]: entry["unit"] for machine in plan_of(self).get("machines", []) for entry in machine["defaults"]}
        return {name: unit for name, unit in {**parameters, **UNITS}.items() if unit}

    def events(self) -> Events:
        """What happened in the last step."""
        return events_of(lib.jo_world_events(self._live()))

    def agents(self) -> list:
        """All agents, in ascending id."""
        return [Agent(self, int(agent)) for agent in np.sort(self["id"])]

    def agent(self, agent: int) -> "Agent":
        """The agent with an id. KeyError where it is not there."""
        world = self._live()
        if not 0 <= operator.index(agent) < 2**32 or not lib.jo_world_agent_of(world, agent).generation:
            raise KeyError(agent)
        return Agent(self, operator.index(agent))

    def body(self, name: str) -> "Body":
        """The body of a name. KeyError where there is none."""
        body = lib.jo_world_find_body(self._live(), named(name))
        if not body.generation:
            raise KeyError(name)
        return Body(self, body)

    # ---- questions ----

    def neighbours(self, x: float, y: float, radius: float, storey: Union[int, str] = 0) -> tuple:
        """Ids and distances (m) of agents whose centres are within `radius` m of a point on a storey, the nearest first; at most
        1,024."""
        _within("a place, m,", -FARTHEST, FARTHEST, x, y)
        _within("a radius, m,", 0.0, float("inf"), radius)
        ids, distances = np.empty(1024, np.uint32), np.empty(1024, np.float32)
        count = lib.jo_world_neighbours_on(self._live(), self.storey(storey), x, y, radius, ffi.from_buffer("uint32_t *", ids),
                                           ffi.from_buffer("float *", distances), 1024)
        return ids[:count].copy(), distances[:count].copy()

    def cast(self, start: Sequence[float], end: Sequence[float], radius: float = 0.0, agents: bool = True,
             bodies: bool = True, walls: bool = True, storey: Union[int, str] = 0) -> Optional[Hit]:
        """What a disc (a ray, without radius) meets first on its way on a storey; None where the way is free."""
        _within("a place, m,", -FARTHEST, FARTHEST, *start, *end)
        _within("a radius, m,", 0.0, 100.0, radius)
        kinds = lib.JO_CAST_AGENTS * agents + lib.JO_CAST_BODIES * bodies + lib.JO_CAST_WALLS * walls
        met = lib.jo_world_cast_on(self._live(), self.storey(storey), _vector(start, 2), _vector(end, 2), radius, kinds)
        kind = {lib.JO_TOUCHED_AGENT: "agent", lib.JO_TOUCHED_BODY: "body", lib.JO_TOUCHED_WALL: "wall"}[met.kind]
        return Hit(kind, met.what, met.share, met.x, met.y, (met.nx, met.ny)) if met.hit else None

    def way(self, x: float, y: float, place: str, storey: Union[int, str] = 0) -> np.ndarray:
        """The way round walls, and over stairs, from a point on a storey to a place: rows x, y about 0.25 m apart, in plan; no rows
        where none leads there. In a scene with storeys a third column has the number of the storey."""
        _within("a place, m,", -FARTHEST, FARTHEST, x, y)
        level = self.storey(storey)
        count = lib.jo_world_path_on(self._live(), level, x, y, named(place), ffi.NULL, 0, ffi.NULL)
        points = np.zeros(count, WHERE)
        lib.jo_world_path_on(self._world, level, x, y, named(place), ffi.from_buffer("JoWhere *", points), count, ffi.NULL)
        return np.column_stack([points[name] for name in (("x", "y", "storey") if self.storeys else ("x", "y"))])

    def density(self, x: float, y: float, storey: Union[int, str] = 0) -> float:
        """People per m2 at a point on a storey."""
        _within("a place, m,", -FARTHEST, FARTHEST, x, y)
        return lib.jo_world_density_on(self._live(), self.storey(storey), x, y)

    # ---- what is done to it ----

    def spawn(self, group: str, x: float, y: float, storey: Union[int, str] = 0) -> "Agent":
        """A new agent of a group, at a point, m, on a storey."""
        self._live()
        agent = lib.jo_world_spawn_on(self._world, named(group), self.storey(storey), x, y, self._error)
        check(agent.generation, self._error)
        return Agent(self, lib.jo_agent_state(self._world, agent).id)

    def signal(self, name: str) -> None:
        """Calls a name out, which everybody hears in the next step."""
        self._do(lib.jo_world_signal, self._world, named(name))

    def open(self, wall: str, is_open: bool = True) -> None:
        """Opens or closes the walls of a name."""
        self._do(lib.jo_world_open_wall, self._world, named(wall), is_open)

    def set_lift(self, lift: str, mode: str) -> None:
        """The mode of a lift from now on, `in_use`, `out_of_use` or `firemen`; `all` means all lifts."""
        if mode not in LIFT_MODES:
            raise ValueError(f"a lift has no mode {mode!r}: {', '.join(LIFT_MODES)}")
        self._do(lib.jo_world_set_lift_mode, self._world, named(lift), LIFT_MODES.index(mode))

    def add_wall(self, name: str, points: Sequence[Sequence[float]], storey: Union[int, str] = 0) -> None:
        """A thin wall between 2 points or a solid with 4 corners, m, on a storey."""
        flat = [number for point in points for number in point]
        self._do(lib.jo_world_add_wall_on, self._world, named(name), self.storey(storey), _vector(flat, 2 * len(points)), len(points))

    def remove_wall(self, name: str) -> None:
        """Takes out the walls of a name that were added."""
        self._do(lib.jo_world_remove_wall, self._world, named(name))

    def input(self, line: str) -> None:
        """Does what a line of an input log says: "push 7 300 0"."""
        self._going()
        self._do(lib.jo_scene_input, self._scene, named(line))

    # ---- what it leaves ----

    def record(self, path: Union[str, Path], every: float = 0.0) -> None:
        """Writes trajectories to an SQLite file from here on, a frame each `every` s (0: each 0.1 s)."""
        _within("a time between frames, s,", 0.0, 1e6, every)
        if self._recorded:
            raise Error("the scene is recorded already", 2)
        self._recorded = bool(self._do(lib.jo_scene_record, self._scene, path_named(path), every))

    def log_input(self, path: Union[str, Path]) -> None:
        """Writes what is done to it to a file from here on, which `input_log` plays back to the same state."""
        self._do(lib.jo_scene_log_input, self._scene, path_named(path))

    def finish(self) -> None:
        """Ends recordings and logs: their files are whole."""
        self._do(lib.jo_scene_finish, self._scene)
        self._finished = True

    def snapshot(self) -> bytes:
        """All that its future depends on."""
        size = ffi.new("size_t *")
        data = check(lib.jo_world_snapshot(self._live(), size, self._error), self._error)
        try:
            return bytes(ffi.buffer(ffi.cast("char *", data), size[0]))
        finally:
            lib.jo_free(data)

    def restore(self, data: bytes) -> None:
        """Puts it into that state: it goes on as it did then, to the bit."""
        self._do(lib.jo_world_restore, self._world, ffi.from_buffer(data), len(data))

    def summary(self) -> dict:
        """The figures of the run so far, as `jostle run --summary` gives them."""
        self._live()
        with told(lib.jo_scene_figures(self._scene)) as figures:
            return _nested(figures.items[0:figures.count])

    def troubles(self) -> list:
        """Sentences on what did not go as it was written: functions that failed too often, people who were lost."""
        self._live()
        with told(lib.jo_scene_troubles(self._scene)) as troubles:
            return [text_of(trouble.text) for trouble in troubles.items[0:troubles.count]]

    def probes(self) -> dict:
        """The table of each probe by its name: a Table, which is a dict of arrays by column, as "time [s]"; texts as arrays of
        objects. `scene.probes()["door"].frame()` is a DataFrame of pandas."""
        self._live()
        tables, n = {}, 0
        while True:
            name = text_of(lib.jo_scene_probe_name(self._scene, n))
            if not name:
                return tables
            with told(lib.jo_scene_probe_table(self._scene, n)) as table:
                tables[name] = _table(table)
            n += 1

    # ---- looking at it ----

    def show(self, live: bool = False, width: int = 800, height: int = 600) -> Union[Picture, LivePage]:
        """In a notebook a picture of how it stands, seen from above, and how many are in which state; `live`: its live
        page, as `live()` opens it."""
        self._live()
        width, height = (max(100, whole("a size in pixels", size, 10000)) for size in (width, height))
        return self.live(width, height) if live else picture_of_scene(self, width, height)

    def live(self, width: Union[int, str] = "100%", height: int = 600, running: bool = False, watch: bool = True,
             port: int = 0, frame: Optional[str] = None) -> LivePage:
        """In a notebook its live page in a frame. It shows the steps that Python makes; between the cells people can let
        the scene run there and act on it (in a program: within `LivePage.serve`). `running`: it runs at once, else when
        somebody presses Play. watch: its files are loaded again when they are saved. port: 0 is 8730 or the next free one. frame: pages that may show it, as
        "https://notes.example"; without, notebooks of this machine. Who knows the address, which stands in the
        notebook's output, acts on the scene; it is another one each time."""
        if not isinstance(width, str):
            width = max(100, whole("a size in pixels", width, 10000))
        height = max(100, whole("a size in pixels", height, 10000))
        self._going()
        if not self._page:
            self._page = open_page(self, frame, whole("a port", port, 65535), running, watch)
            self._page_end = weakref.finalize(self, lib.jo_live_close, self._page)
        return LivePage(self, width, height)

    def _serve_page(self, seconds: float = 0.0) -> float:
        """Lets people use the page; returns in how many seconds this is due again."""
        if self._busy or not self._page:
            return 0.05
        self._busy = True
        try:
            wait = lib.jo_live_serve(self._page, seconds)
        finally:
            self._busy = False
        failure, self._words.failure = self._words.failure, None
        if failure:  # raised by nobody's call
            sys.stderr.write(f"a word of the program failed: {failure!r}\n")
        return max(0.005, wait) if lib.jo_live_watchers(self._page) else 0.2

    def _close_page(self) -> None:
        if self._page:
            self._page = ffi.NULL
            self._page_end()

    def _repr_svg_(self) -> Optional[str]:
        return picture_of_scene(self, 800, 600).svg if self._scene else None

    def _repr_html_(self) -> Optional[str]:
        return picture_of_scene(self, 800, 600).html if self._scene else None

    def __iter__(self) -> Iterator["Agent"]:
        return iter(self.agents())

    def __repr__(self) -> str:
        return f"<jostle.Scene {self.path!r}, closed>" if not self._scene else (
            f"<jostle.Scene {self.path!r}, {len(self)} agents, t = {self.time:.2f} s>")


def _nested(figures: Sequence[Any]) -> dict:
    """Figures in their order, as dicts and lists within each other."""
    top: dict = {}
    open_: list = [top]
    for figure in figures:
        del open_[figure.depth:]
        kind = figure.kind
        value: Any = ({} if kind == lib.JO_FIGURE_TABLE else [] if kind == lib.JO_FIGURE_LIST
                      else text_of(figure.text) if kind == lib.JO_FIGURE_TEXT
                      else bool(figure.number) if kind == lib.JO_FIGURE_TRUTH
                      else _number(figure.number) if kind == lib.JO_FIGURE_NUMBER else None)
        if isinstance(open_[-1], dict):
            open_[-1][text_of(figure.name)] = value
        else:
            open_[-1].append(value)
        if isinstance(value, (dict, list)):
            open_.append(value)
    return top


def _number(number: float) -> Union[int, float]:
    return int(number) if number.is_integer() and abs(number) < 2**53 else number


def _table(table: Any) -> Table:
    """The columns of a table by name and unit, as arrays."""
    columns = {}
    for column in table.columns[0:table.column_count]:
        name, unit = text_of(column.name), text_of(column.unit)
        numbers = np.array([column.numbers[row] for row in range(table.row_count)], dtype=float)
        values = numbers if not column.texts else np.array(
            [text_of(column.texts[row]) for row in range(table.row_count)], dtype=object)
        columns[f"{name} [{unit}]" if unit else name] = values
    return Table(columns)


class Agent:
    """An agent of a scene, by its id. What it is asked for raises Error once it has left."""

    __slots__ = ("scene", "id")

    def __init__(self, scene: Scene, id: int) -> None:
        self.scene, self.id = scene, id

    def _handle(self) -> Any:
        return lib.jo_world_agent_of(self.scene._live(), self.id)

    def _state(self) -> Any:
        handle = self._handle()
        if not handle.generation:
            raise Error(f"agent {self.id} has left", 3)
        return lib.jo_agent_state(self.scene._world, handle)

    def _do(self, call: Any, *arguments: Any) -> None:
        self.scene._do(call, self.scene._world, self._handle(), *arguments)

    @property
    def is_there(self) -> bool:
        """Whether it has not left."""
        return self._handle().generation != 0

    @property
    def position(self) -> tuple:
        """x, y, m, in plan."""
        state = self._state()
        return state.x, state.y

    @property
    def where(self) -> Where:
        """Its position in plan, with storey, stair and height, and the lift that it uses."""
        self._state()
        return _where(lib.jo_agent_where(self.scene._world, self._handle()))

    @property
    def storey(self) -> int:
        """The number of its storey, 0 without storeys; on a stair, that which is nearer in height."""
        return self._state().storey

    @property
    def velocity(self) -> tuple:
        """m/s."""
        state = self._state()
        return state.vx, state.vy

    @property
    def force(self) -> tuple:
        """Net force of the last step, N."""
        state = self._state()
        return state.fx, state.fy

    @property
    def state(self) -> str:
        """The state of its behaviour that it is in."""
        return text_of(self._state().state)

    def set_state(self, state: str) -> None:
        """Puts it into a state."""
        self._do(lib.jo_agent_set_state, named(state))

    def set_goal(self, place: str) -> None:
        """Has it aim at a place."""
        self._do(lib.jo_agent_set_goal, named(place))

    def teleport(self, x: float, y: float, storey: Union[int, str, None] = None) -> None:
        """Moves it to a point, m, or to the nearest free spot, on a storey; without one, on the storey where it is."""
        self._do(lib.jo_agent_teleport_on, self.storey if storey is None else self.scene.storey(storey), x, y)

    def push(self, fx: float, fy: float) -> None:
        """A force during the next step, N, up to 10,000 along each axis."""
        self._state()
        self.scene.input(f"push {self.id} {float(fx)!r} {float(fy)!r}")

    def remove(self) -> None:
        """Takes it out."""
        self._state()
        lib.jo_world_remove_agent(self.scene._world, self._handle())

    def memory(self, name: str) -> float:
        """A value that it remembers. KeyError where there is none."""
        return self._value(lib.jo_agent_memory, name)

    def set_memory(self, name: str, value: float) -> None:
        """Sets a value that it remembers."""
        self._do(lib.jo_agent_set_memory, named(name), value)

    def parameter(self, name: str) -> float:
        """A parameter at present. KeyError where there is none."""
        return self._value(lib.jo_agent_parameter, name)

    def set_parameter(self, name: str, value: float) -> None:
        """Its own value of a parameter, in all states that set none."""
        self._do(lib.jo_agent_set_parameter, named(name), value)

    def _value(self, call: Any, name: str) -> float:
        self._state()
        value = ffi.new("double *")
        if not call(self.scene._world, self._handle(), named(name), value):
            raise KeyError(name)
        return value[0]

    def __repr__(self) -> str:
        return f"<jostle.Agent {self.id}>"


class Body:
    """A rigid body of a scene."""

    __slots__ = ("scene", "_body")

    def __init__(self, scene: Scene, body: Any) -> None:
        self.scene, self._body = scene, body

    @property
    def is_there(self) -> bool:
        """Whether it was not taken out."""
        return lib.jo_body_is_live(self.scene._live(), self._body)

    def _state(self) -> Any:
        if not self.is_there:
            raise Error("the body is not there any more", 3)
        return lib.jo_body_state(self.scene._world, self._body)

    @property
    def position(self) -> tuple:
        """Of its centre of mass: x, y, z, m."""
        state = self._state()
        return state.x, state.y, state.z

    @property
    def velocity(self) -> tuple:
        """m/s."""
        state = self._state()
        return state.vx, state.vy, state.vz

    def impulse(self, impulse: Sequence[float], at: Optional[Sequence[float]] = None, storey: Union[int, str] = 0) -> None:
        """N s, at a point of a storey, m, or at its centre of mass."""
        world, body, push = self.scene._world, self._body, _vector(impulse, 3)
        if at is None:
            self.scene._do(lib.jo_body_impulse, world, body, push, ffi.NULL)
        else:
            self.scene._do(lib.jo_body_impulse_on, world, body, push, self.scene.storey(storey), _vector(at, 3))

    def place(self, at: Sequence[float], turn: Optional[Sequence[float]] = None, storey: Union[int, str] = 0) -> None:
        """Moves it to a point of a storey, m, turned by a unit quaternion x, y, z, w or as it is, at rest."""
        self.scene._do(lib.jo_body_place_on, self.scene._world, self._body, self.scene.storey(storey), _vector(at, 3), _vector(turn, 4))

    def set_velocity(self, velocity: Sequence[float], spin: Optional[Sequence[float]] = None) -> None:
        """m/s and rad/s."""
        self.scene._do(lib.jo_body_set_velocity, self.scene._world, self._body, _vector(velocity, 3), _vector(spin, 3))

    def remove(self) -> None:
        """Takes it out."""
        self.scene._do(lib.jo_body_remove, self.scene._world, self._body)
