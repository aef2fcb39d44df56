"""Recordings of runs: SQLite files in the format of JuPedSim, version 2, which PedPy reads too."""
from __future__ import annotations

import os
import sqlite3
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any, Iterator, Optional, Sequence, Union
from urllib.parse import quote

import numpy as np

from ._library import Error, whole
from .live import RecordingPage
from .picture import Picture
from .plan import picture_of_recording
from .table import frame_of

__all__ = ["Recording"]


UNITS = {"x": "m", "y": "m", "force": "N", "load": "N", "compression": "N/m", "radius": "m", "breadth": "m", "depth": "m", "chest": "rad",
         "fallen": "s"}


class Recording:
    """A recording as arrays. Columns: frame, id, x, y (m), ori_x, ori_y, and where the run wrote them more, as
    force and load (N), compression (N/m)."""

    def __init__(self, path: Union[str, Path]) -> None:
        self.path = os.fsdecode(path)
        if not Path(path).is_file():
            raise Error("there is no such recording", 3, self.path)
        try:
            with self.opened() as database:
                virtual = database.execute("SELECT name FROM sqlite_master WHERE type = 'table' AND rootpage = 0 AND "
                                           "lower(name) IN ('metadata', 'trajectory_data', 'jostle_row')").fetchall()
                if virtual:
                    raise Error(f"its '{virtual[0][0]}' is a virtual table, which is not read", 3, self.path)
                self.metadata = dict(database.execute("SELECT key, value FROM metadata"))
                rows = database.execute("SELECT * FROM trajectory_data ORDER BY frame, id")
                names = [column[0] for column in rows.description]
                table = rows.fetchall()
        except sqlite3.Error as error:
            raise Error(str(error), 3, self.path) from error
        self._columns = {name.replace("pos_", ""): np.array([row[n] for row in table]) for n, name in enumerate(names)}
        for name in ("frame", "id", "x", "y"):
            if name not in self._columns:
                raise Error(f"its trajectory_data has no column for {name}", 3, self.path)
            if self._columns[name].dtype.kind not in "iuf":
                raise Error(f"somebody's {name} is no number", 3, self.path)

    @contextmanager
    def opened(self) -> Iterator[sqlite3.Connection]:
        """The file as a database that is only read."""
        with closing(sqlite3.connect(f"file:{quote(os.fsencode(self.path))}?mode=ro", uri=True)) as database:
            yield database

    @property
    def fps(self) -> float:
        """Frames a second."""
        try:
            return float(self.metadata["fps"])
        except (KeyError, TypeError, ValueError):
            raise Error("it does not say how many frames a second it has", 3, self.path) from None

    @property
    def title(self) -> str:
        """The name of the file."""
        return os.path.basename(self.path)

    def names(self) -> list:
        """Of the columns."""
        return list(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        return self._columns[name]

    def __len__(self) -> int:
        return len(self._columns["frame"])

    def frames(self) -> Iterator[tuple]:
        """For each frame its number and the slice of its rows."""
        frame = self._columns["frame"]
        starts = np.flatnonzero(np.r_[True, frame[1:] != frame[:-1]]) if len(frame) else np.empty(0, int)
        for begin, end in zip(starts, np.r_[starts[1:], len(frame)]):
            yield int(frame[begin]), slice(int(begin), int(end))

    def path_of(self, agent: int) -> np.ndarray:
        """Where an agent was: an array of rows x, y, one for each frame that it is in."""
        rows = self._columns["id"] == agent
        return np.column_stack([self._columns["x"][rows], self._columns["y"][rows]])

    def table(self, names: Optional[Sequence[str]] = None, units: bool = False) -> Any:
        """Columns as a pandas DataFrame where pandas is installed, else as a Table: a dict of arrays. Units are in
        `attrs["units"]` of the DataFrame, or in `units` of the Table; with `units` in the names: "x [m]"."""
        return frame_of({name: self._columns[name] for name in (names or self.names())}, UNITS, self.path, units)

    # ---- looking at it ----

    def show(self, time: Optional[float] = None, paths: bool = False, width: int = 800, height: int = 600) -> Picture:
        """In a notebook a picture of how people stood at a time, s (without: at the end), seen from above; `paths`: and
        the ways that they took until then."""
        width, height = (max(100, whole("a size in pixels", size, 10000)) for size in (width, height))
        return picture_of_recording(self, time, paths, width, height)

    def live(self, width: Union[int, str] = "100%", height: int = 600, port: int = 0, frame: Optional[str] = None) -> RecordingPage:
        """In a notebook a frame in which the recording plays; `port` and `frame` are as in `Scene.live`."""
        return RecordingPage(self.path, frame, port, width, height)

    def _repr_svg_(self) -> str:
        return self.show(paths=True).svg

    def _repr_html_(self) -> str:
        return self.show(paths=True).html

    def __repr__(self) -> str:
        return f"<jostle.Recording {self.path!r}, {len(self)} rows>"
