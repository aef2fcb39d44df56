"""Prints how long the playground takes until a crowd moves in the picture, from the first byte, ms: by software graphics, without a
cache; and the time of processors that all of the browser's processes take meanwhile, which other programs change less. Figures to
compare with others of the same machine, and no test.

    startup.py [SCENE...]    default: dodgeball evacuation circle; TIMES: runs of each, default 5"""
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "page"))

from harness import Browser  # noqa: E402
from server import Server  # noqa: E402

TIMES = int(os.environ.get("TIMES", "5"))
TICKS = os.sysconf("SC_CLK_TCK")


def processor_time(root):
    """Seconds that a process and all that it has started have run."""
    stats = {}
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="utf-8", errors="replace") as file:
                fields = file.read().rpartition(")")[2].split()
        except OSError:
            continue  # it has ended
        stats[int(name)] = (int(fields[1]), sum(map(int, fields[11:15])) / TICKS)
    family = {root}
    while more := {pid for pid, (parent, _) in stats.items() if parent in family} - family:
        family |= more
    return sum(stats[pid][1] for pid in family if pid in stats)


def measure(server, scene):
    """Milliseconds until the crowd moves, and of processors, in a browser of its own that has started before."""
    browser = Browser()
    try:
        browser.size(1280, 800)
        browser.driver.get(server.address("site.css"))
        time.sleep(1)  # what starts with the browser
        root = browser.driver.service.process.pid
        before = processor_time(root)
        browser.driver.get(server.address(f"workbench.html#scene={scene}"))
        moved = browser.wait("return performance.getEntriesByName('moved').map((e) => e.startTime)[0]", "no crowd moves")
        return round(moved), round(1000 * (processor_time(root) - before))
    finally:
        browser.close()


def main():
    server = Server()
    for scene in sys.argv[1:] or ["dodgeball", "evacuation", "circle"]:
        runs = [measure(server, scene) for _ in range(TIMES)]
        wall, used = (sorted(column) for column in zip(*runs))
        middle = TIMES // 2
        print(f"{scene}: {wall[middle]} ms ({wall[0]} to {wall[-1]}), processors {used[middle]} ms ({used[0]} to {used[-1]}), "
              f"load {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors", flush=True)
    server.stop()


if __name__ == "__main__":
    main()
