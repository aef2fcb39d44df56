"""Recordings of runs: SQLite files in the format of JuPedSim, version 2, which PedPy reads too."""
from __future__ import annotations

import os
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any, Iterator, Optional, Union
from urllib.parse import quote

import numpy as np

from ._library import Error

__all__ = ["Recording"]


class Recording:
    """A recording as arrays. Columns: frame, id, x, y (m), ori_x, ori_y, and where the run wrote them more, as
    force and load (N), compression (N/m)."""

    def __init__(self, path: Union[str, Path]) -> None:
        self.path = os.fsdecode(path)
        if not Path(path).is_file():
            raise Error("there is no such recording", 3, self.path)
        try:
            with closing(sqlite3.connect(f"file:{quote(os.fsencode(path))}?mode=ro", uri=True)) as database:
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

    @property
    def fps(self) -> float:
        """Frames a second."""
        try:
            return float(self.metadata["fps"])
        except (KeyError, TypeError, ValueError):
            raise Error("it does not say how many frames a second it has", 3, self.path) from None

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

    def table(self, names: Optional[list] = None) -> Any:
        """A pandas DataFrame where pandas is installed, else a dict of arrays."""
        chosen = {name: self._columns[name] for name in (names or self.names())}
        try:
            import pandas
        except ImportError:
            return chosen
        return pandas.DataFrame(chosen)
