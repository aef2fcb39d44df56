"""Makes the pictures of the READMEs anew: a moving one of the Tawaf, and the page with an office, a person, a machine and storeys.

    readme.py [NAME...]    tawaf, office, person, machine, storeys; without: all

Look at them before you commit them. Needs ffmpeg."""
import os
import subprocess
import sys
import tempfile
import time

from gallery import Shown
from harness import ROOT, Browser, Session

OUT = os.path.join(ROOT, "core", "view", "page", "pictures")
SIZE, FRAMES, EVERY = (560, 350), 20, 0.2  # of the moving picture: pixels; count; s between two
PERSON = 40  # number of the person who is shown


def write(pictures, name, *how):
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", str(1 / EVERY), "-i", pictures, *how, os.path.join(OUT, name)], check=True)


def tawaf(browser):
    shown = Shown(browser, "tawaf")
    try:
        shown.size(*SIZE)
        shown.advance(20)
        with tempfile.TemporaryDirectory() as folder:
            for frame in range(FRAMES):
                shown.shoot(os.path.join(folder, f"{frame:03}.jpg"))
                shown.advance(EVERY)
            write(os.path.join(folder, "%03d.jpg"), "tawaf.webp", "-c:v", "libwebp_anim", "-loop", "0", "-quality", "45", "-compression_level", "6")
    finally:
        shown.session.stop()


# Looks from one place (m) at another.
LOOK = """
const place = (eye, at) => {
    page.view.perspective.position.set(...eye);
    page.view.orbit.target.set(...at);
    page.view.orbit.update();
    page.view.handled = true;
    page.view.moved();
};
"""


def page(browser, scene, seconds, name, script):
    """The whole page of a scene at a time, after a script."""
    session = Session("run", f"scenes/{scene}.yaml", "--view")
    try:
        session.pause()
        browser.open(session)
        browser.wait("return page.bar.paused", "no pause")
        browser.run("page.about.close(); window.pictures = Infinity")
        browser.run("page.connection.send({do: 'step', n: arguments[0]})", round(seconds / browser.run("return page.scene.dt")))
        browser.wait("return page.crowd.next.time >= arguments[0]", "the steps were not made", seconds - 0.06, patience=120)
        browser.run(LOOK + script)
        time.sleep(6)  # all of the screen's pixels are drawn once nothing moves
        with tempfile.TemporaryDirectory() as folder:
            browser.driver.save_screenshot(os.path.join(folder, "page.png"))
            write(os.path.join(folder, "page.png"), f"{name}.webp", "-c:v", "libwebp", "-quality", "86")
    finally:
        session.stop()


def office(browser):
    page(browser, "office", 7, "office", "place([31, -9, 8], [22, 5.5, 0]);")


def person(browser):
    page(browser, "tawaf-few", 13, "person", f"""
page.inspect({PERSON});
page.panel.show("agent");
const [x, y] = page.crowd.position({PERSON}, 1);
place([x + 7, y - 8, 4.5], [x, y, 1]);
""")


def machine(browser):
    page(browser, "tawaf-few", 8, "machine", "page.panel.show('machine'); place([26, -46, 20], [2, 2, 2]);")


def storeys(browser):
    page(browser, "office-tower", 72, "storeys", "page.colourBy('group')")


ALL = {"tawaf": tawaf, "office": office, "person": person, "machine": machine, "storeys": storeys}

if __name__ == "__main__":
    made = Browser()
    made.size(1280, 800)
    try:
        for wanted in sys.argv[1:] or ALL:
            ALL[wanted](made)
            made.size(1280, 800)
    finally:
        made.close()
