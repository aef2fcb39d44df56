"""Prints how long the playground takes until a crowd moves in the picture, from the first byte, ms: by software graphics, without a
cache. A figure to compare with another one of the same machine, and no test.

    startup.py [SCENE...]    default: dodgeball evacuation circle"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "page"))

from harness import Browser  # noqa: E402
from server import Server  # noqa: E402

TIMES = 3


def measure(server, scene):
    """Milliseconds until the crowd moves, in a browser of its own that has started before."""
    browser = Browser()
    try:
        browser.size(1280, 800)
        browser.driver.get(server.address("site.css"))
        browser.driver.get(server.address(f"workbench.html#scene={scene}"))
        return round(browser.wait("return performance.getEntriesByName('moved').map((e) => e.startTime)[0]", "no crowd moves"))
    finally:
        browser.close()


def main():
    server = Server()
    for scene in sys.argv[1:] or ["dodgeball", "evacuation", "circle"]:
        times = sorted(measure(server, scene) for _ in range(TIMES))
        print(f"{scene}: {times[len(times) // 2]} ms ({times[0]} to {times[-1]}), load {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    server.stop()


if __name__ == "__main__":
    main()
