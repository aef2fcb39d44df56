"""Makes a wheel of the package with all that it needs inside: the program, the library with tools, the libraries that these
load, the Lua library, behaviours, scenes and the live page. `make wheel` calls it, twice.

    wheel.py --libraries                  prints how the wheel's program and library are linked
    wheel.py BUILD PAGE OUT               BUILD: folder of that program and library; PAGE: of the page; OUT: of the wheel

Shared libraries get names of their own (a checksum of their content), so that none is taken for another one of the process.
SQLite, Expat and libyaml are linked in with hidden symbols, as the Python interpreter may have another Expat, whose symbols
the loader would take for ours. The C and C++ libraries stay outside.
The same sources on the same system give the same bytes: times in the wheel are SOURCE_DATE_EPOCH, or 1980.
"""
import base64
import hashlib
import importlib.metadata
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TREE = HERE.parents[1]
# Libraries that every system with glibc has: PEP 600 lets wheels expect them.
OUTSIDE = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|nsl|gcc_s|stdc\+\+))\.so(\..*)?$")
# Libraries that are linked in where the system has them as archives, which must be fit for a shared library.
LINKED_IN = ("yaml", "sqlite3", "expat")
PACKAGES = ("lua5.4", "yaml-0.1", "sqlite3", "expat", "libcjson", "libzip", "bullet", "cairo", "libwebsockets")
LAUNCHER = '''#!python
"""Runs the program of the package `jostle`."""
import importlib.util
import os
import sys

program = os.path.join(os.path.dirname(importlib.util.find_spec("jostle").origin), "engine", "jostle")
os.execv(program, ["jostle", *sys.argv[1:]])
'''


def output_of(*command: str) -> str:
    """What a program prints."""
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def archive_of(name: str) -> Path:
    """The archive of a library, which need not exist."""
    return Path(output_of("gcc", f"-print-file-name=lib{name}.a"))


def link_flags() -> str:
    """Flags of the linker for all libraries of the engine and the tools."""
    flags = []
    for flag in output_of("pkg-config", "--libs", *PACKAGES).split():
        name = flag[2:] if flag.startswith("-l") else ""
        if name in LINKED_IN and archive_of(name).is_absolute():
            flags.append(f"-l:lib{name}.a")
        else:
            flags.append(flag)
    return " ".join(flags)


def libraries_of(files: list) -> dict:
    """Name and path of each shared library that files load, directly or not, except those outside."""
    found = {}
    for file in files:
        for name, path in re.findall(r"^\s+(\S+) => (\S+) ", output_of("ldd", str(file)), re.M):
            if path == "not":
                sys.exit(f"{file} needs {name}, which is not installed")
            if not OUTSIDE.match(name):
                found[name] = Path(path).resolve()
    return found


def bundle_libraries(engine: Path) -> list:
    """Copies shared libraries into the folder of the program, under names of their own, and lets all files there find them
    beside themselves. Returns the paths of what was copied."""
    own = [engine / "jostle", engine / "libjostle-tools.so"]
    libraries = libraries_of(own)
    names = {}
    for name, path in libraries.items():
        stem, _, rest = name.partition(".so")
        names[name] = f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{rest}"
        shutil.copyfile(path, engine / names[name])
    digest = hashlib.sha256(own[1].read_bytes()).hexdigest()[:8]
    own[1] = own[1].rename(engine / f"libjostle-tools-{digest}.so")
    for file in own + [engine / name for name in names.values()]:
        needed = output_of("patchelf", "--print-needed", str(file)).split()
        changes = [["--replace-needed", name, names[name]] for name in needed if name in names] + [["--set-rpath", "$ORIGIN"]]
        if file != own[0]:
            changes.append(["--set-soname", file.name])
        for change in changes:  # one at a time: patchelf 0.14 mixes up the names of several
            subprocess.run(["patchelf", *change, str(file)], check=True)
        file.chmod(0o755)
    return list(libraries.values())


def package_of(path: Path) -> str:
    """The Debian package that a file is of."""
    for name in (path, Path("/usr") / path.relative_to("/"), Path("/") / path.relative_to("/usr") if path.is_relative_to("/usr") else path):
        found = subprocess.run(["dpkg-query", "-S", str(name)], check=False, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
        if found:
            return found.split(": ")[0].split(",")[0]
    sys.exit(f"{path} is of no Debian package, so its licence is not known; make the wheel on Debian, with Debian's libraries")


def write_licences(folder: Path, bundled: list) -> None:
    """Writes the licences of what is inside, and a table of it."""
    folder.mkdir(parents=True)
    shutil.copyfile(TREE / "LICENSE", folder / "LICENSE")
    linked = [path for path in map(archive_of, LINKED_IN) if path.is_absolute()]
    rows, general = [], set()
    for path in sorted(set(bundled + [path.resolve() for path in linked])):
        package = package_of(path)
        plain = package.partition(":")[0]
        source, version = output_of("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}", package).split()
        text = Path(f"/usr/share/doc/{plain}/copyright").read_text(encoding="utf-8")
        (folder / f"{source}.txt").write_text(text, encoding="utf-8")
        general |= set(re.findall(r"/usr/share/common-licenses/([A-Za-z0-9.-]*[A-Za-z0-9])", text))
        rows.append(f"{path.name:<28} {source:<16} {version:<28} {source}.txt")
    for name in sorted(general):
        shutil.copyfile(f"/usr/share/common-licenses/{name}", folder / f"{name}.txt")
    (folder / "BUNDLED.txt").write_text(
        "Libraries inside this wheel, as Debian built them. Nothing was changed but names of files. The sources are Debian's: `apt-get\n"
        "source SOURCE=VERSION`, or snapshot.debian.org. Cairo is used under the Mozilla Public License 1.1. The live page contains\n"
        "three.js: jostle/engine/page/three.LICENSE.txt.\n\n"
        f"{'library':<28} {'source':<16} {'version':<28} licence\n" + "\n".join(rows) + "\n", encoding="utf-8")


def stage_engine(engine: Path, build: Path, page: Path) -> list:
    """Fills the folder of the program, library and data; returns the libraries that were copied."""
    engine.mkdir(parents=True)
    for built, name in ((build / "jostle", "jostle"), (next(build.glob("libjostle-tools.so.*")), "libjostle-tools.so")):
        shutil.copyfile(built, engine / name)
        subprocess.run(["strip", str(engine / name)], check=True)
    bundled = bundle_libraries(engine)
    for name in ("scripts/editor", "scripts/cluster", "behaviours", "scenes"):
        shutil.copytree(TREE / name, engine / name)
    for file in (TREE / "scripts").glob("*.*"):
        shutil.copyfile(file, engine / "scripts" / file.name)
    shutil.copytree(page, engine / "page")
    return bundled


def stage_package(stage: Path, work: Path) -> tuple:
    """Builds the Python part; returns the name with version, and the metadata."""
    shutil.copytree(HERE, work / "python")
    environment = dict(os.environ, JOSTLE_INCLUDE=str(TREE / "core" / "include"))
    for step in (["build", "--build-lib", str(stage)], ["egg_info"]):
        made = subprocess.run([sys.executable, "setup.py", "-q", *step], cwd=work / "python", env=environment, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if made.returncode:
            sys.exit(made.stdout)
    package = importlib.metadata.PathDistribution(work / "python" / "jostle.egg-info")
    head, _, body = (package.read_text("PKG-INFO") or "").partition("\n\n")
    head = "\n".join(line for line in head.splitlines() if not line.startswith(("Requires-Dist", "License-File")))
    needs = "".join(f"Requires-Dist: {needed}\n" for needed in package.requires or ())
    return f"jostle-{package.version}", f"{head}\n{needs}\n{body}"


def tag_of_system() -> str:
    """The tag of wheels that run on this system's glibc, or a later one."""
    name, _, version = (os.confstr("CS_GNU_LIBC_VERSION") or "another C library ").partition(" ")
    if name != "glibc":
        sys.exit("the wheel is for glibc, which this system does not have")
    return f"py3-none-manylinux_{version.replace('.', '_')}_{platform.machine()}"


def write_wheel(stage: Path, wheel: Path, name: str) -> None:
    """Packs a folder, with the list of its files; times are those of the sources."""
    seconds = max(int(os.environ.get("SOURCE_DATE_EPOCH") or 0), 315532800)
    record, files = f"{name}.dist-info/RECORD", sorted(path for path in stage.rglob("*") if path.is_file())
    times = tuple(map(int, output_of("date", "-u", "-d", f"@{seconds}", "+%Y %m %d %H %M %S").split()))
    lines = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:

        def add(path: str, content: bytes, mode: int) -> None:
            entry = zipfile.ZipInfo(path, times)
            entry.external_attr, entry.compress_type = (0o100000 | mode) << 16, zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)

        for file in files:
            path, content = file.relative_to(stage).as_posix(), file.read_bytes()
            add(path, content, 0o755 if os.access(file, os.X_OK) else 0o644)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            lines.append(f"{path},sha256={digest},{len(content)}")
        add(record, ("\n".join(lines + [f"{record},,"]) + "\n").encode(), 0o644)


def main() -> None:
    """Makes the wheel, or prints how to link."""
    if sys.argv[1:] == ["--libraries"]:
        print(link_flags())
        return
    build, page, out = (Path(argument) for argument in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        stage = work / "stage"
        name, metadata = stage_package(stage, work)
        bundled = stage_engine(stage / "jostle" / "engine", build, page)
        info, tag = stage / f"{name}.dist-info", tag_of_system()
        write_licences(info / "licenses", bundled)
        (info / "METADATA").write_text(metadata, encoding="utf-8")
        (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: jostle\nRoot-Is-Purelib: false\nTag: {tag}\n", encoding="utf-8")
        scripts = stage / f"{name}.data" / "scripts"
        scripts.mkdir(parents=True)
        (scripts / "jostle").write_text(LAUNCHER, encoding="utf-8")
        (scripts / "jostle").chmod(0o755)
        out.mkdir(parents=True, exist_ok=True)
        wheel = out / f"{name}-{tag}.whl"
        write_wheel(stage, wheel, name)
    print(f"{wheel}  {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
