"""A picture and a short clip of shipped scenes, as the live page draws them, and a page of them.

    gallery.py OUT [SCENE...]    scenes by name; without: all of the folder scenes

Time is stepped by hand, so that a clip runs in real time however slowly it is drawn. A scene that fails is named, and the
others go on; then the status is 1. Needs ffmpeg."""
import base64
import glob
import html
import os
import resource
import subprocess
import sys
import tempfile

from harness import ROOT, Browser, Failure, Session
from selenium.common.exceptions import WebDriverException

PICTURE, CLIP = (960, 600), (480, 300)  # pixels: clips are small, as the processor may have to draw them
FRAMES, RATE = 24, 8  # of a clip; a second
# s before the picture, where the first one shows little
BEFORE = {"tawaf": 30, "office": 6, "wall-breaking": 9, "circle": 14, "two-bottlenecks": 30, "evacuation": 16, "counterflow": 40,
          "running-through": 3, "bottleneck": 15, "arena": 10, "station": 8, "san-fermin": 20}
OTHERWISE = 8  # s

PREPARE = """
document.querySelectorAll('#bar, #tools, #panel, #legend, #replay, .messages, .hint').forEach((n) => n.hidden = true);
document.body.style.display = 'block';
document.querySelector('main').style.height = '100vh';
page.loop = () => {}; // only what is shot is drawn
page.resize();
"""
SHOOT = """
page.crowd.snap = true;
page.redraw();
page.view.draw(performance.now());
const c = document.createElement('canvas'), p = c.getContext('2d');
[c.width, c.height] = [page.view.canvas.width, page.view.canvas.height];
p.drawImage(page.view.canvas, 0, 0);
return c.toDataURL('image/jpeg', 0.92).split(',')[1];
"""


class Shown:
    """A scene whose time stands still between pictures."""

    def __init__(self, browser, name):
        self.browser = browser
        self.session = Session("run", os.path.join("scenes", f"{name}.yaml"), "--view")
        self.session.pause()
        browser.open(self.session)
        browser.wait("return page.bar.paused", "no pause")
        browser.run(PREPARE)
        self.size(*PICTURE)
        self.dt, self.title, self.about = browser.run("return [page.scene.dt, page.scene.title, page.scene.about]")

    def size(self, wide, high):
        self.browser.size(wide, high)
        self.browser.wait("return innerWidth === arguments[0] && page.view.wide === innerWidth", "the window keeps its size", wide)
        self.browser.run("page.view.goHome()")

    def advance(self, seconds):
        steps = max(1, round(seconds / self.dt))
        tick = self.browser.run("return page.crowd.next.tick")
        self.browser.run("page.connection.send({do: 'step', n: arguments[0]})", steps)
        self.browser.wait("return page.crowd.next.tick >= arguments[0]", "the steps were not made", tick + steps, patience=600)

    def shoot(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.browser.run(SHOOT)))


def show(browser, name, out):
    """Makes OUT/NAME.jpg and OUT/NAME.webm; returns its title and what it shows."""
    shown = Shown(browser, name)
    try:
        shown.advance(BEFORE.get(name, OTHERWISE))
        shown.shoot(os.path.join(out, f"{name}.jpg"))
        with tempfile.TemporaryDirectory() as folder:
            shown.size(*CLIP)
            for frame in range(FRAMES):
                shown.shoot(os.path.join(folder, f"{frame:03}.jpg"))
                shown.advance(1 / RATE)
            subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", str(RATE), "-i", os.path.join(folder, "%03d.jpg"),
                            "-c:v", "libvpx-vp9", "-cpu-used", "6", "-crf", "36", "-b:v", "0", "-pix_fmt", "yuv420p", os.path.join(out, f"{name}.webm")], check=True)
    finally:
        shown.session.stop()
    return shown.title, shown.about


def write_page(out, shown):
    items = "".join(f"<figure><video src='{name}.webm' poster='{name}.jpg' controls muted loop preload='none'></video>"
                    f"<figcaption><b>{html.escape(title)}</b> {html.escape(about)} <code>jostle run {name} --view</code></figcaption></figure>"
                    for name, (title, about) in shown.items())
    with open(os.path.join(out, "index.html"), "w", encoding="utf-8") as file:
        file.write("<!DOCTYPE html><html lang='en'><meta charset='utf-8'><title>Jostle: gallery</title><style>"
                   ":root{color-scheme:light dark}body{font:1rem/1.4 system-ui,sans-serif;margin:1.5rem;display:grid;gap:1.5rem;grid-template-columns:repeat(auto-fill,minmax(22rem,1fr))}"
                   "h1{grid-column:1/-1;margin:0}figure{margin:0}video{width:100%;border-radius:.5rem}code{display:block;opacity:.75}</style>"
                   f"<h1>Jostle: gallery</h1>{items}</html>\n")


def main():
    out, names = os.path.abspath(sys.argv[1]), sys.argv[2:]
    names = names or sorted(os.path.basename(path)[:-5] for path in glob.glob(os.path.join(ROOT, "scenes", "*.yaml")))
    os.makedirs(out, exist_ok=True)
    browser, shown, failed = Browser(), {}, []
    try:
        for done, name in enumerate(names, 1):
            try:
                shown[name] = show(browser, name, out)
                write_page(out, shown)
                print(f"{done} of {len(names)}: {name}", flush=True)
            except (Failure, WebDriverException, OSError, subprocess.CalledProcessError) as error:
                failed.append(name)
                print(f"{done} of {len(names)}: {name} failed: {str(error).splitlines()[0]}", flush=True)
    finally:
        browser.close()
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{os.path.join(out, 'index.html')}: {len(shown)} scenes in {(used.ru_utime + used.ru_stime) / 60:.0f} minutes of processor time")
    if failed:
        sys.exit(f"without {', '.join(failed)}")


main()
