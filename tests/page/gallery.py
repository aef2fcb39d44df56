"""A picture and a short clip of shipped scenes, as the live page draws them, and a page of them.

    gallery.py OUT [SCENE...]    scenes by name; without: all of the folder scenes

The page shows all that OUT holds. Time is stepped by hand, so that a clip runs in real time however slowly it is drawn. Two
browsers work side by side, as a scene is stepped by one processor and drawn by another. A scene that fails is named, and
the others go on; then the status is 1. Needs ffmpeg."""
import base64
import glob
import html
import json
import os
import queue
import resource
import subprocess
import sys
import tempfile
import threading
import time

from harness import ROOT, Browser, Failure, Session
from selenium.common.exceptions import WebDriverException

PICTURE, CLIP = (960, 600), (480, 300)  # pixels: clips are small, as the processor may have to draw them
FRAMES, RATE = 24, 8  # of a clip; a second
BROWSERS = 2
# s before the picture, where the first one shows little
BEFORE = {"tawaf": 30, "office": 6, "wall-breaking": 14, "wall-heavy": 14, "wall-tight": 14, "circle": 30, "two-bottlenecks": 30,
          "evacuation": 16, "counterflow": 40, "running-through": 3, "hurried-polite": 3, "giving-way": 4, "train-doors": 13, "tackle": 7, "push-row": 2, "bottleneck": 15, "arena": 10, "san-fermin": 20,
          "metro": 70, "dodgeball": 3, "premovement": 40, "premovement-many": 30, "gates": 12, "exit-lost": 12, "rimea-10": 5,
          "rimea-15": 30, "rescue": 22, "rimea-15-straight": 30, "rimea-07": 30, "outbreak": 30, "station": 20, "tour": 12}
OTHERWISE = 8  # s

# Clips play while the pointer or the focus is on them, or a finger was last.
PLAY = "for (const v of document.querySelectorAll('video')) { v.onmouseenter = v.onfocus = () => v.play(); v.onmouseleave = v.onblur = () => v.pause(); }"

PREPARE = """
document.querySelectorAll('#bar, #menu, #panel, #legend, #replay, .messages, .hint').forEach((n) => n.hidden = true);
document.body.style.display = 'block';
document.getElementById('stage').style.cssText = 'position: fixed; inset: 0; height: auto';
page.loop = () => {}; // only what is shot is drawn
page.resize();
"""
SHOOT = """
page.crowd.snap = true;
page.redraw();
page.view.sharpen(true); // a slow processor draws fewer pixels while things move, and fewer people as meshes
page.view.people.detail = 1;
page.view.people.allow();
page.view.render(performance.now(), performance.now(), 1);
const c = document.createElement('canvas'), p = c.getContext('2d');
[c.width, c.height] = [page.view.canvas.width, page.view.canvas.height];
p.drawImage(page.view.canvas, 0, 0);
return c.toDataURL('image/jpeg', 0.92).split(',')[1];
"""


class Shown:
    """A scene whose time stands still between pictures."""

    def __init__(self, browser, name):
        self.browser = browser
        browser.driver.set_script_timeout(120)  # s: 35,000 people on a busy processor
        self.session = Session("run", os.path.join("scenes", f"{name}.yaml"), "--view")
        try:
            self.session.pause()
            browser.open(self.session, people=False)
            browser.wait("return page.bar.paused", "no pause")
            browser.run(PREPARE)
            self.size(*PICTURE)
            self.dt, self.title, self.about, until = browser.run("return [page.scene.dt, page.scene.title, page.scene.about, page.scene.duration]")
            self.steps = int(until / self.dt)  # of the whole scene
        except BaseException:
            self.session.stop()
            raise

    def size(self, wide, high):
        self.browser.size(wide, high)
        self.browser.wait("return page.view.wide === arguments[0] && page.view.high === arguments[1]", "the picture keeps its size", wide, high)
        self.browser.run("page.view.goHome()")

    def advance(self, seconds, least=0):
        """Steps so many seconds on, but for `least` s before the scene's end."""
        tick = self.browser.run("return page.crowd.next.tick")
        steps = min(max(1, round(seconds / self.dt)), self.steps - round(least / self.dt) - tick)
        if steps <= 0:
            return
        self.browser.run("page.connection.send({do: 'step', n: arguments[0]})", steps)
        self.browser.wait("return page.crowd.next.tick >= arguments[0]", "the steps were not made", tick + steps, patience=300)

    def shoot(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.browser.run(SHOOT)))


def show(browser, name, out):
    """Makes OUT/NAME.jpg, OUT/NAME.webm, and OUT/NAME.json with its title and what it shows."""
    shown = Shown(browser, name)
    try:
        shown.advance(BEFORE.get(name, OTHERWISE), least=FRAMES / RATE)
        browser.run("page.view.goHome()")  # fits who is there now
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
    with open(os.path.join(out, f"{name}.json"), "w", encoding="utf-8") as file:
        json.dump({"title": shown.title, "about": shown.about}, file)


def write_page(out):
    """OUT/index.html, of all scenes that OUT holds; returns how many there are."""
    items = []
    for path in sorted(glob.glob(os.path.join(out, "*.json"))):
        name = os.path.basename(path)[:-5]
        with open(path, encoding="utf-8") as file:
            told = json.load(file)
        items.append(f"<figure><video src='{name}.webm' poster='{name}.jpg' tabindex='0' aria-label='{html.escape(told['title'])}' muted loop playsinline preload='none'></video>"
                     f"<figcaption><b>{html.escape(told['title'])}</b> {html.escape(told['about'])} <code>jostle run {name} --view</code></figcaption></figure>")
    with open(os.path.join(out, "index.html"), "w", encoding="utf-8") as file:
        file.write("<!DOCTYPE html><html lang='en'><meta charset='utf-8'><meta name='viewport' content='width=device-width'><title>Jostle: gallery</title><style>"
                   ":root{color-scheme:light dark}body{font:1rem/1.4 system-ui,sans-serif;margin:1.5rem;display:grid;gap:1.5rem;grid-template-columns:repeat(auto-fill,minmax(min(22rem,100%),1fr))}"
                   "h1{grid-column:1/-1;margin:0}figure{margin:0}video{width:100%;aspect-ratio:8/5;border-radius:.5rem}code{display:block;opacity:.75}</style>"
                   f"<h1>Jostle: gallery</h1>{''.join(items)}<script>{PLAY}</script></html>\n")
    return len(items)


def scenes_named(chosen):
    """The scenes chosen, else all shipped ones."""
    return chosen or sorted(os.path.basename(path)[:-5] for path in glob.glob(os.path.join(ROOT, "scenes", "*.yaml")))


def work(names, make, failed):
    """Calls make(browser, name) for scenes of the queue until it is empty."""
    browser = Browser()
    try:
        while True:
            name, begun = names.get_nowait(), time.monotonic()
            try:
                make(browser, name)
                print(f"{name}: {time.monotonic() - begun:.0f} s", flush=True)
            except (Failure, WebDriverException, OSError, subprocess.CalledProcessError) as error:
                failed.append(name)
                print(f"{name} failed: {str(error).splitlines()[0]}", flush=True)
    except queue.Empty:
        pass
    finally:
        browser.close()


def make_all(chosen, make):
    """Calls make(browser, name) for each scene, in two browsers; returns the scenes that failed."""
    names, failed = queue.Queue(), []
    for name in chosen:
        names.put(name)
    workers = [threading.Thread(target=work, args=(names, make, failed)) for _ in range(min(BROWSERS, len(chosen)))]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return failed + [names.get() for _ in range(names.qsize())]


def main():
    out, chosen, begun = os.path.abspath(sys.argv[1]), scenes_named(sys.argv[2:]), time.monotonic()
    os.makedirs(out, exist_ok=True)
    failed = make_all(chosen, lambda browser, name: show(browser, name, out))
    count, used = write_page(out), resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{os.path.join(out, 'index.html')}: {count} scenes; {len(chosen)} made in {(time.monotonic() - begun) / 60:.1f} minutes, "
          f"{(used.ru_utime + used.ru_stime) / 60:.0f} of a processor")
    if failed:
        sys.exit(f"without {', '.join(failed)}")


if __name__ == "__main__":
    main()
