"""Reads what the C headers declare, for cffi. JOSTLE_INCLUDE names another folder of headers."""
import os
import re
from pathlib import Path

import cffi

HEADERS = ("jostle.h", "jostle_read.h", "jostle_act.h", "jostle_tell.h", "jostle_words.h", "jostle_live.h", "jostle_tools.h")


def include_folder() -> Path:
    """Where the headers lie: as asked for, in this tree, or where they are installed."""
    tree = Path(__file__).resolve().parents[2] / "core" / "include"
    for folder in (os.environ.get("JOSTLE_INCLUDE"), tree, "/usr/local/include", "/usr/include"):
        if folder and (Path(folder) / HEADERS[0]).is_file():
            return Path(folder)
    raise FileNotFoundError("jostle.h was not found; JOSTLE_INCLUDE may name its folder")


def declarations(folder: Path) -> str:
    """The declarations of all headers, without comments, directives and what C++ needs."""
    text = "".join((folder / name).read_text(encoding="utf-8") for name in HEADERS)
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    text = re.sub(r"#ifdef __cplusplus.*?#endif\n", "", text, flags=re.S)
    text = re.sub(r"^#.*\n", "", text, flags=re.M)
    return text.replace("JO_API ", "")


ffi = cffi.FFI()
ffi.set_source("jostle._declarations", None)
ffi.cdef(declarations(include_folder()))

if __name__ == "__main__":
    ffi.compile(verbose=False)
