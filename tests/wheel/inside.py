"""inside.py WHEEL HASH-OF-EVACUATION HASH-OF-DODGEBALL: installs the wheel into a new environment, and uses what is in it as
its users do. The hashes are those of 10 s of the scenes by a program built here. Runs where no compiler is found; prints
"ok NAME" or "not ok NAME" for each case."""
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import urllib.request
from pathlib import Path

WHEEL, WANTED = sys.argv[1], dict(zip(("evacuation", "dodgeball"), sys.argv[2:]))
# Shared libraries that the process may have from the system: those of Python and NumPy, and the C and C++ libraries.
OF_ENGINE = r"/lib(jostle|lua|yaml|cjson|zip|Bullet|LinearMath|cairo|pixman|fontconfig|freetype|png|websockets|X11|xcb)[^/]*\.so"


def case(name, good, why=""):
    """Prints the verdict on a case."""
    print(f"ok {name}" if good else f"not ok {name}\n    {str(why)[-600:]}", flush=True)
    return good


def run(*command, folder=None):
    """Runs a program; returns its status, and all that it printed."""
    done = subprocess.run([str(part) for part in command], check=False, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def try_package():
    """The second process, of the new environment: the package alone, from a folder with nothing in it."""
    import jostle  # first, so that its libraries are not found by the names of others
    import numpy

    for name, wanted in WANTED.items():
        with jostle.Scene(name) as scene:
            scene.run(10)
            case(f"the scene {name} has the hash that the program has", f"{scene.hash}" == wanted, scene.hash)
            x = scene["x"]
            case("  its columns are arrays of NumPy", isinstance(x, numpy.ndarray) and x.dtype == numpy.float32 and len(x) == len(scene))
    scene = jostle.Scene("running-through")
    page = scene.live(running=True)
    answer = []
    thread = threading.Thread(target=lambda: answer.append(urllib.request.urlopen(page.address, timeout=20).read()))
    thread.start()
    while thread.is_alive():
        page.serve(0.1)
    case("the live page is inside", answer and b"<html" in answer[0].lower(), answer)
    page.stop()
    case("pictures are drawn", scene.show()._repr_svg_().count("<circle") > 10 or "<path" in scene.show()._repr_svg_())
    import pyexpat
    import sqlite3

    scene.record("run.sqlite")
    scene.run(1)
    scene.finish()
    rows = sqlite3.connect("run.sqlite").execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
    pyexpat.ParserCreate().Parse("<a/>", True)
    case("SQLite and Expat of Python work beside it", rows > 0)
    mapped = {line.split()[-1] for line in open("/proc/self/maps", encoding="utf-8") if ".so" in line}
    foreign = [path for path in mapped if re.search(OF_ENGINE, path) and "/jostle/engine/" not in path]
    case("no library of the engine is the system's", not foreign, foreign)
    try:
        jostle.Scene("evacuatoin")
    except jostle.Error as error:
        case("a scene that is not there is an error with a way out", "did you mean 'evacuation'" in str(error), error)


def try_wheel(work):
    """The first process: installs, and runs what was installed."""
    case("there is no compiler", not any(shutil.which(name) for name in ("cc", "gcc", "c++", "g++", "clang", "make")))
    environment = work / "environment"
    status, said = run(sys.executable, "-m", "venv", "--system-site-packages", environment)
    if not case("a virtual environment is made", status == 0, said):
        return
    python, program = environment / "bin" / "python", environment / "bin" / "jostle"
    status, said = run(python, "-m", "pip", "install", "--quiet", "--no-index", "--disable-pip-version-check", WHEEL)
    if not case("pip installs the wheel without an index", status == 0, said):
        return
    empty = work / "empty"
    empty.mkdir()
    status, said = run(python, Path(__file__).resolve(), *sys.argv[1:], "--package", folder=empty)
    print(said, end="")
    case("the package ran to its end", status == 0, said)
    for name, wanted in WANTED.items():
        status, said = run(program, "run", name, "--for", 10, "--quiet", "--summary", "-", folder=empty)
        case(f"the program runs the scene {name}", status == 0 and f'"hash": "{wanted}"' in said, said)
    status, said = run(program, "new", "scene", "mine", folder=empty)
    status, said = run(program, "check", ".", folder=empty) if status == 0 else (status, said)
    case("a new scene is made and checked", status == 0, said)
    status, said = run(program, "render", "evacuation", "--out", "e.png", "--quiet", folder=empty)
    picture = empty / "e.png"
    case("a PNG is drawn", status == 0 and picture.is_file() and picture.stat().st_size > 3000, said)
    status, said = run(python, "-c", "import sys; sys.modules['_cffi_backend'] = None; import jostle", folder=empty)
    case("without cffi the error names what to install", status == 1 and "pip install cffi" in said, said)
    status, said = run(python, "-m", "pip", "uninstall", "--quiet", "--yes", "jostle")
    left = [path for path in environment.rglob("*jostle*") if path.name != "__pycache__"]
    case("pip removes all of it", status == 0 and not left, said or left)


if sys.argv[-1] == "--package":
    try_package()
else:
    with tempfile.TemporaryDirectory() as folder:
        try_wheel(Path(folder))
