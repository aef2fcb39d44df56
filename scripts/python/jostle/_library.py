"""The shared library, and its errors as exceptions."""
from __future__ import annotations

import difflib
import operator
import os
import re
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Iterator, Union

try:
    from ._declarations import ffi
except ModuleNotFoundError as missing:
    if missing.name != "_cffi_backend":
        raise
    raise ModuleNotFoundError("jostle needs cffi, which is not installed: pip install cffi, or on Debian python3-cffi",
                              name=missing.name) from None

__all__ = ["Error", "check", "data_folder", "ffi", "lib", "named", "path_named", "scene_file", "text_of", "told", "whole"]


def _candidates() -> list[str]:
    """Where the library may be, the first that is there is taken: inside the package (a wheel), in the source tree, of the
    system; with the tools, or the engine alone."""
    named = os.environ.get("JOSTLE_LIBRARY")
    if named:
        return [named]
    bundled = [str(path) for path in (Path(__file__).resolve().parent / "engine").glob("libjostle-tools-*.so*")]
    if bundled:
        return bundled
    found = ["libjostle-tools.so.0", "libjostle.so.0"]
    for folder in Path(__file__).resolve().parents:
        if (folder / "core" / "include" / "jostle.h").is_file():
            found = [str(path) for path in sorted((folder / "build" / "release").glob("libjostle-tools.so.*"))] + found
    return found


def _open() -> Any:
    reasons = []
    for name in _candidates():
        try:
            return ffi.dlopen(name)
        except OSError as error:
            reasons.append(str(error))
    raise ImportError("libjostle was not found; JOSTLE_LIBRARY may name it: " + "; ".join(reasons))


lib = _open()


class Error(Exception):
    """What the library refused, with where in which file.

    str() has the place, the message and the way out ("Did you mean ...?"); `text` has no place. `code` is 1 where a run failed, 2 where the call makes no sense, 3 where a scene, behaviour or value is
    wrong; `file` is "" and `line` and `column` are 0 where there is no such place.
    """

    def __init__(self, text: str, code: int = 1, file: str = "", line: int = 0, column: int = 0) -> None:
        self.text, self.code, self.file, self.line, self.column = text, code, file, line, column
        super().__init__(text, code, file, line, column)

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}: " if self.file and self.line else f"{self.file}: " if self.file else ""
        return place + self.text


def named(text: str) -> bytes:
    """A text for C, which would end at a zero byte."""
    if not isinstance(text, str):
        raise TypeError(f"a text is expected, not {text!r}")
    if "\0" in text:
        raise ValueError(f"a text with a zero byte names nothing: {text!r}")
    return text.encode()


def path_named(path: Union[str, "os.PathLike[str]"]) -> bytes:
    """A path for C, as the system has it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError(f"a path with a zero byte names nothing: {path!r}")
    return name


def data_folder() -> Path:
    """The folder of the scenes, behaviours and Lua library that come with Jostle."""
    return Path(os.fsdecode(ffi.string(lib.jo_data_folder())))


def scene_file(path: Union[str, "os.PathLike[str]"]) -> Union[str, "os.PathLike[str]"]:
    """The path of a scene: a plain name such as "evacuation" that is no file here is that of a shipped scene."""
    if isinstance(path, str) and re.fullmatch(r"[\w-]+", path) and not os.path.exists(path):
        shipped = data_folder() / "scenes" / f"{path}.yaml"
        if shipped.is_file():
            return shipped
        names = sorted(file.stem for file in shipped.parent.glob("*.yaml"))
        near = difflib.get_close_matches(path, names, 1)
        hint = f"did you mean {near[0]!r}?" if near else f"they are in {shipped.parent}"
        raise Error(f"there is no file and no shipped scene {path!r}; {hint}", 3)
    return path


def whole(what: str, number: Any, most: int = 2**64 - 1) -> int:
    """A whole number from 0 to `most`."""
    try:
        value = operator.index(number)
    except TypeError:
        raise TypeError(f"{what} is a whole number, not {number!r}") from None
    if not 0 <= value <= most:
        raise ValueError(f"{what} is from 0 to {most}, not {number!r}")
    return value


def text_of(pointer: Any) -> str:
    """A C string that the library keeps."""
    return ffi.string(pointer).decode("utf-8", "replace") if pointer else ""


@contextmanager
def told(pointer: Any) -> Iterator[Any]:
    """A struct of jostle_tell.h, which is freed at the end of the block."""
    if not pointer:
        raise MemoryError("out of memory")
    try:
        yield pointer
    finally:
        lib.jo_free(pointer)


def check(good: Any, error: Any) -> Any:
    """Returns what a call returned, or raises what it refused."""
    if good:
        return good
    refused = Error(text_of(error.text) or "this call makes no sense with these values, or at this time", error.code or 2,
                    text_of(error.file), error.line, error.column)
    ffi.buffer(error)[:] = bytes(ffi.sizeof("JoError"))  # a later call need not fill it
    raise refused
