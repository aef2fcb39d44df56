"""Tables of columns with units, which notebooks show, and which become pandas DataFrames."""
from __future__ import annotations

import html
from typing import Any, Mapping, Optional, Sequence

import numpy as np

from ._library import Error

__all__ = ["Table", "frame_of", "html_table", "text_of_value"]

MOST_ROWS = 12  # shown in a notebook


class Table(dict):
    """Columns by name, arrays of one length. `units` has the unit of each column that has one."""

    def __init__(self, columns: Mapping[str, Any], units: Optional[Mapping[str, str]] = None, title: str = "") -> None:
        super().__init__(columns)
        self.units = {name: unit for name, unit in (units or {}).items() if unit and name in self}
        self.title = title

    def frame(self) -> Any:
        """A pandas DataFrame of the columns; its `attrs` have "units" and "title"."""
        try:
            import pandas
        except ImportError:
            raise Error("a DataFrame needs pandas: install python3-pandas (Debian) or `pip install pandas`; without it a "
                        "table is a dict of arrays", 2) from None
        frame = pandas.DataFrame(dict(self))
        frame.attrs.update(units=dict(self.units), title=self.title)
        return frame

    def __reduce__(self) -> Any:
        return Table, (dict(self), self.units, self.title)

    def _repr_html_(self) -> str:
        return self.html()

    def html(self, most: int = MOST_ROWS) -> str:
        """The table as HTML, with at most so many rows."""
        names = list(self)
        count = len(self[names[0]]) if names else 0
        shown = range(count) if count <= most else range(most - 2)
        rows = [[self[name][row] for name in names] for row in shown]
        heads = [f"{name} [{self.units[name]}]" if name in self.units else name for name in names]
        note = "" if count == len(rows) else f"… {count} rows"
        return html_table(heads, rows, self.title, note)


def frame_of(columns: Mapping[str, Any], units: Mapping[str, str], title: str = "", with_units: bool = False) -> Any:
    """A DataFrame where pandas is installed, else a Table. `with_units`: columns are called "x [m]"."""
    if with_units:
        columns = {f"{name} [{units[name]}]" if units.get(name) else name: column for name, column in columns.items()}
    table = Table(columns, {} if with_units else units, title)
    try:
        import pandas  # noqa: F401
    except ImportError:
        return table
    return table.frame()


def text_of_value(value: Any) -> str:
    """A number with four digits, whole where it is; other values as they are."""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (int, np.integer)):
        return f"{value}"
    if isinstance(value, (float, np.floating)):
        return "–" if value != value else f"{value:.0f}" if abs(value) < 1e6 and value == int(value) else f"{value:.4g}"
    return "–" if value is None else str(value)


def html_table(heads: Sequence[str], rows: Sequence[Sequence[Any]], title: str = "", note: str = "",
               marks: Optional[Sequence[str]] = None) -> str:
    """A table of HTML; numbers are aligned to the right. `marks`: a colour before the first cell of each row, or ""."""
    def is_number(value: Any) -> bool:
        return value is None or isinstance(value, (int, float, np.number)) and not isinstance(value, bool)

    def side(value: Any) -> str:
        return f'style="text-align:{"right" if is_number(value) else "left"}"'

    def cell(value: Any, mark: str = "") -> str:
        dot = f'<span style="color:{html.escape(mark)}">&#9679;</span> ' if mark else ""
        return f'<td {side(value)}>{dot}{html.escape(text_of_value(value))}</td>'

    parts = ['<table>']
    if title:
        parts.append(f'<caption style="text-align:left">{html.escape(title)}</caption>')
    parts.append("<thead><tr>" + "".join(
        f'<th {side(rows[0][k]) if rows else ""}>{html.escape(head)}</th>' for k, head in enumerate(heads)) + "</tr></thead><tbody>")
    for n, row in enumerate(rows):
        parts.append("<tr>" + "".join(cell(value, marks[n] if marks and not k else "") for k, value in enumerate(row)) + "</tr>")
    parts.append("</tbody></table>")
    if note:
        parts.append(f"<p>{html.escape(note)}</p>")
    return "".join(parts)
