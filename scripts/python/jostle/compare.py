"""Comparisons of variants: files of `jostle sweep`, and recordings, as `jostle compare` compares them."""
from __future__ import annotations

import json
import os
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any, NamedTuple, Optional, Sequence, Union
from urllib.parse import quote

from ._library import Error, check, ffi, lib, named, path_named, text_of
from .table import Table, frame_of

__all__ = ["Comparison", "compare"]


class Comparison(NamedTuple):
    """`sides`: what is compared, dicts with name, settings, runs and seeds; `base`: the index of the one that the others
    are held against. `figures`: by their paths in the summary dicts with "words", "unit" and "sides", each with mean,
    deviation and, but for the base, difference, its interval from low to high, and a verdict. `text`: the result in words."""

    sides: list
    base: int
    figures: dict
    text: str

    def table(self, all: bool = False) -> Any:
        """A row for each figure and side but the base: a pandas DataFrame where pandas is installed, else a Table. Without
        `all`: the main figures that are not 0 everywhere, as far as there are runs with them."""
        return self._rows(all)[0]

    def _rows(self, all: bool) -> tuple:
        names = ("figure", "unit", "side", "base mean", "mean", "difference", "low", "high", "verdict")
        columns: dict = {name: [] for name in names}
        for path, figure in self.figures.items():
            base = figure["sides"][self.base]
            for side, one in zip(self.sides, figure["sides"]):
                is_main = figure["words"] != path and one.get("difference") is not None and (base["mean"] or one["mean"])
                if one is base or not (all or is_main):
                    continue
                row = (figure["words"], figure["unit"], side["name"], base["mean"], one["mean"], one.get("difference"),
                       one.get("low"), one.get("high"), one.get("verdict"))
                for name, value in zip(names, row):
                    columns[name].append(value)
        title = f"differences from {self.sides[self.base]['name']}"
        return frame_of(columns, {}, title), Table(columns, {}, title)

    def _repr_html_(self) -> str:
        return self._rows(False)[1].html(most=100)

    def __repr__(self) -> str:
        return self.text


def _is_sweep(path: str) -> bool:
    try:
        with closing(sqlite3.connect(f"file:{quote(os.fsencode(path))}?mode=ro", uri=True)) as database:
            return bool(database.execute("SELECT 1 FROM sqlite_master WHERE name = 'variant'").fetchone())
    except sqlite3.Error:
        return False


def _report(path: str) -> Any:
    """The figures of a recording as JSON, to be freed."""
    definition = ffi.new("JoReportDef *", lib.jo_default_report_def())
    error, name = ffi.new("JoError *"), ffi.new("char[]", path_named(path))
    definition.recording = name
    return check(lib.jo_report(definition, error), error)


def compare(*paths: Union[str, Path], labels: Sequence[str] = (), base: Optional[str] = None, out: Union[str, Path, None] = None,
            share: float = 0.95) -> Comparison:
    """Compares the variants of files of `jostle sweep`, and recordings, each a side. labels: names of the sides; base: number
    from 1, name or file of the side that the others are held against (the first); out: a folder for a page; share: the
    confidence of the intervals."""
    if not paths:
        raise ValueError("name the files of sweeps, or recordings, that are compared")
    try:
        lib.jo_compare
    except AttributeError:
        raise Error("comparisons are in libjostle-tools, and libjostle was found alone; JOSTLE_LIBRARY may name it", 2) from None
    texts = [os.fsdecode(path) for path in paths]
    for text in texts:
        if not Path(text).is_file():
            raise Error("there is no such file", 3, text)
    summaries: list = []
    made, error, kept = ffi.new("char **"), ffi.new("JoError *"), [ffi.new("char[]", path_named(text)) for text in texts]
    kept += [ffi.new("char[]", named(label)) for label in labels]
    definition = ffi.new("JoCompareDef *", lib.jo_default_compare_def())
    sides, names = ffi.new("char *[]", kept[: len(texts)]), ffi.new("char *[]", kept[len(texts):] or [ffi.NULL])
    definition.sides, definition.side_count = ffi.cast("const char *const *", sides), len(texts)
    definition.labels, definition.label_count = ffi.cast("const char *const *", names), len(labels)
    definition.share = share
    for field, value in (("base", base), ("out", out)):
        if value is not None:
            kept.append(ffi.new("char[]", path_named(str(value))))
            setattr(definition, field, kept[-1])
    try:
        summaries += [ffi.NULL if _is_sweep(text) else _report(text) for text in texts]
        figures = ffi.new("char *[]", summaries)
        definition.summaries = ffi.cast("const char *const *", figures)
        text = check(lib.jo_compare(definition, made, error), error)
        summaries += [text, made[0]]
        said = json.loads(text_of(made[0]))
        return Comparison(said["sides"], said["base"] - 1, said["figures"], text_of(text))
    finally:
        for one in summaries:
            lib.jo_free(one)
