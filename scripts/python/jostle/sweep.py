"""Several runs of a scene: over values of its keys, and over seeds."""
from __future__ import annotations

import itertools
import json
from typing import Any, Mapping, NamedTuple, Optional, Sequence

import numpy as np

from .scene import Scene
from .table import Table, frame_of, html_table, text_of_value

# Figures that a notebook shows of a sweep, and their units.
MAIN = {"danger.left": "", "danger.last_left_s": "s", "danger.clearance_s": "s", "density_max": "1/m2", "simulated_s": "s"}


class Sweep(NamedTuple):
    """One record for each run: `values` of the keys, its `seed`, and its `summary`."""

    runs: list

    def column(self, figure: str) -> np.ndarray:
        """A figure of each run by its path in the summary, as "density_max" or "probes.door.flow"; NaN where none is."""
        return np.array([_figure(run["summary"], figure) for run in self.runs])

    def table(self, *figures: str) -> Any:
        """Keys, seed and figures of all runs: a pandas DataFrame where pandas is installed, else a Table: a dict of
        arrays."""
        columns = {key: np.array([run["values"][key] for run in self.runs]) for key in (self.runs[0]["values"] if self.runs else ())}
        columns["seed"] = np.array([run["seed"] for run in self.runs])
        columns.update({figure: self.column(figure) for figure in figures})
        return frame_of(columns, {name: unit_of(name) for name in columns}, "runs of a sweep")

    def variants(self, *figures: str) -> Table:
        """A row for each variant: its values, number of runs, and of each figure the mean and the standard deviation over
        the seeds. Without figures: the main ones."""
        chosen = figures or tuple(figure for figure in MAIN if np.isfinite(self.column(figure)).any())
        keys = list(self.runs[0]["values"]) if self.runs else []
        rows: dict = {}
        for n, run in enumerate(self.runs):
            rows.setdefault(json.dumps(list(run["values"].values()), default=str), []).append(n)
        columns: dict = {key: np.array([self.runs[of[0]]["values"][key] for of in rows.values()]) for key in keys}
        columns["runs"] = np.array([len(of) for of in rows.values()], dtype=int)
        units = {}
        for figure in chosen:
            values = self.column(figure)
            known = [values[of][np.isfinite(values[of])] for of in rows.values()]
            columns[figure] = np.array([some.mean() if len(some) else np.nan for some in known])
            columns[f"{figure} ±"] = np.array([some.std(ddof=1) if len(some) > 1 else np.nan for some in known])
            units[figure] = units[f"{figure} ±"] = unit_of(figure)
        return Table(columns, units, "mean and standard deviation over the seeds of each variant")

    def _repr_html_(self) -> str:
        table = self.variants()
        figures = [name for name in table if f"{name} ±" in table]
        keys = [name for name in table if name not in figures and not name.endswith(" ±")]
        rows = [[table[name][n] for name in keys] + [_spread(table[name][n], table[f"{name} ±"][n]) for name in figures]
                for n in range(len(table["runs"]))]
        heads = keys + [f"{name} [{table.units[name]}]" if name in table.units else name for name in figures]
        return html_table(heads, rows, table.title)


def _spread(mean: float, deviation: float) -> str:
    return text_of_value(mean) + (f" ± {deviation:.2g}" if np.isfinite(deviation) else "")


def unit_of(figure: str) -> str:
    """The unit of a figure of the summary, as far as its name or this table tells."""
    return MAIN.get(figure, "s" if figure.endswith("_s") else "m" if figure.endswith("_m") else "")


def _figure(summary: Any, path: str) -> float:
    for key in path.split("."):
        summary = summary.get(key) if isinstance(summary, Mapping) else None
    return float(summary) if isinstance(summary, (int, float)) else float("nan")


def sweep(path: str, values: Mapping[str, Sequence[Any]], seeds: Sequence[int] = (1,), seconds: Optional[float] = None,
          set: Optional[Mapping[str, Any]] = None, **options: Any) -> Sweep:
    """Runs a scene for every combination of values and every seed, for `seconds` or as long as the scene says."""
    runs = []
    for combination in itertools.product(*values.values()):
        chosen = dict(zip(values, combination))
        for seed in seeds:
            with Scene(path, seed=seed, set={**(set or {}), **chosen}, **options) as scene:
                scene.run(seconds)
                runs.append({"values": chosen, "seed": seed, "summary": scene.summary()})
    return Sweep(runs)
