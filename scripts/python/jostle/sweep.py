"""Several runs of a scene: over values of its keys, and over seeds."""
from __future__ import annotations

import itertools
from typing import Any, Mapping, NamedTuple, Optional, Sequence

import numpy as np

from .scene import Scene


class Sweep(NamedTuple):
    """One record for each run: `values` of the keys, its `seed`, and its `summary`."""

    runs: list

    def column(self, figure: str) -> np.ndarray:
        """A figure of each run by its path in the summary, as "density_max" or "probes.door.flow"; NaN where none is."""
        return np.array([_figure(run["summary"], figure) for run in self.runs])

    def table(self, *figures: str) -> Any:
        """Keys, seed and figures of all runs: a pandas DataFrame where pandas is installed, else a dict of arrays."""
        columns = {key: np.array([run["values"][key] for run in self.runs]) for key in (self.runs[0]["values"] if self.runs else ())}
        columns["seed"] = np.array([run["seed"] for run in self.runs])
        columns.update({figure: self.column(figure) for figure in figures})
        try:
            import pandas
        except ImportError:
            return columns
        return pandas.DataFrame(columns)


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
