"""What the tests of the page share: a browser, a served session, and waiting for things."""
import functools
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback

from selenium import webdriver
from selenium.common.exceptions import TimeoutException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import look

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
JOSTLE = os.path.abspath(os.environ.get("JOSTLE", "build/release/jostle"))
PICTURES = os.path.join(os.path.abspath(os.environ.get("B", "build/release")), "page")
PATIENCE = 40  # s, for what should happen soon; much, as machines may be busy
# The loop goes round each 0.4 s, or each `window.between` ms. What it does is done, but of its pictures only the first
# `window.pictures` are drawn, by a processor, which takes up to a second for one; what a test draws itself always is.
BETWEEN = 400
FIRST = 2 # pictures of a page that show a session not shown before
SELDOM = """
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), window.between ?? %d);
window.pictures = %d;
Object.defineProperty(window, 'page', { configurable: true, set(page) {
    Object.defineProperty(window, 'page', { value: page, writable: true, configurable: true });
    const { view } = page, loop = page.loop.bind(page);
    let looping = false, drawn = false;
    view.coming = null; // all of a picture is in the first one
    page.loop = () => {
        looping = true;
        drawn = false;
        try { loop(); } finally { looping = false; }
        if (drawn && page.crowd.next) window.pictures--;
    };
    for (const [of, name] of [[view.renderer, 'render'], [view.people, 'bakeIfNeeded'], [view, 'compile']]) {
        const does = of[name].bind(of);
        of[name] = (...given) => {
            if (looping && !(window.pictures > 0)) return;
            drawn = true;
            does(...given);
        };
    }
} });
"""


# As browsers do without a graphics card. Drawn and put together by software graphics, too, the page itself costs more than its
# picture: 4 s of a processor to open, and as much as a picture for each change.
UNCOMPOSED = ("--disable-gpu-rasterization", "--disable-gpu-compositing")


class Failure(Exception):
    """A test's expectation that did not hold."""


def expect(holds, text):
    if not holds:
        raise Failure(text)


def wait_for(probe, text, patience=PATIENCE):
    """What `probe` returns once it is true; fails with `text` after `patience` seconds."""
    until = time.monotonic() + patience
    while True:
        value = probe()
        if value:
            return value
        if time.monotonic() > until:
            raise Failure(f"{text} (after {patience} s)")
        time.sleep(0.05)


class Session:
    """A run or a recording on its live page, in a process of its own."""

    def __init__(self, *arguments):
        self.arguments = arguments
        self.process = subprocess.Popen([JOSTLE, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        stdin=subprocess.DEVNULL, text=True, cwd=ROOT)
        self.said = []
        threading.Thread(target=self.read, daemon=True).start()
        self.address = wait_for(lambda: next((line for line in self.said if line.startswith("http://")), None),
                                f"no address from jostle {' '.join(arguments)}")

    def read(self):
        for line in self.process.stdout:
            self.said.append(line.strip())

    def pause(self):
        """Stops the time before any browser is there, which would come late on a busy machine."""
        there = look.join(*look.parts(self.address))
        look.say(there, '{"do": "pause", "on": true}')
        look.leave(there)

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.process.stdout.close()
        return self.process.returncode


class Browser:
    """Chromium without a display, and short ways to ask the page."""

    def __init__(self):
        options = Options()
        options.binary_location = shutil.which("chromium")
        for argument in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                         "--enable-unsafe-swiftshader", *UNCOMPOSED, "--window-size=1280,940", "--hide-scrollbars",
                         "--disable-dev-shm-usage", "--force-prefers-reduced-motion"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_script_timeout(120)
        self.shown = set()  # arguments of sessions whose pages were drawn
        self.script = None
        self.driver.set_page_load_timeout(150)

    def size(self, wide, high, ratio=1):
        """The page's own size, in CSS pixels; a ratio of 2 is a page enlarged to 200 %."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": wide, "height": high, "deviceScaleFactor": ratio, "mobile": False})

    def dark(self, on):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "dark" if on else "light"}]})

    def draw_few(self, pictures):
        """Makes the loops of pages that are opened from now on draw so many pictures."""
        if self.script:
            self.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": self.script})
        self.script = self.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": SELDOM % (BETWEEN, pictures)})["identifier"]

    def open(self, session, people=True):
        """Opens the page of a session, and waits for its first frame: with somebody in it, where `people`."""
        self.draw_few(0 if session.arguments in self.shown else FIRST)
        self.shown.add(session.arguments)
        self.driver.get("about:blank")  # the page before would try the new server, with its old token
        self.driver.get_log("browser")
        self.driver.get(session.address)
        # Until the loop has gone round with a frame, only the loading note is shown.
        self.wait("return window.page && page.scene && page.crowd.next && page.crowd.next.slots >= arguments[0]"
                  " && !document.getElementById('stage').classList.contains('empty')", "no frame reached the page", int(people))

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script, text, *arguments, patience=PATIENCE):
        return wait_for(lambda: self.run(script, *arguments), text, patience)

    def complaints(self):
        """What the console says against the page; that the browser itself reads pictures back is not against it."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING") and "GPU stall due to ReadPixels" not in entry["message"]]

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def button(self, text):
        """The button with this text that is in sight: found at once, as panels are built anew at any time."""
        node = self.run("return [...document.querySelectorAll('button')].find((b) => b.textContent.trim() === arguments[0]"
                        " && b.getClientRects().length)", text)
        if not node:
            raise Failure(f"no button {text!r}")
        return node

    def press(self, *keys):
        """Keys for whatever has the focus."""
        self.driver.switch_to.active_element.send_keys(*keys)

    def canvas(self):
        return self.find("#picture")

    def picture(self, name):
        """Saves what is seen, for people to look at, if PICTURES is set: each costs a second of the processor."""
        if not (os.environ.get("PICTURES") or name.startswith("failed-")):
            return
        os.makedirs(PICTURES, exist_ok=True)
        self.run("window.kept = window.pictures; window.pictures = 2; if (window.page) page.view.dirty = true")
        time.sleep(3 * BETWEEN / 1000)
        self.run("window.between = 2000")  # on a busy machine the browser would wait for its turn for minutes
        for attempt in range(3):  # software graphics on a busy machine may be late for one
            try:
                self.driver.save_screenshot(os.path.join(PICTURES, f"{name}.png"))
                break
            except TimeoutException:
                print(f"  the picture {name}.png is late ({attempt + 1})", file=sys.stderr)
        self.run("delete window.between; window.pictures = window.kept")

    def close(self):
        self.driver.quit()


def settle(browser, tool):
    """Chooses a tool and waits until the page, which it lays out anew, has the picture in its place."""
    browser.button(tool).click()
    spot = last = None
    while spot is None or spot != last:
        time.sleep(0.3)
        spot, last = browser.run("return page.view.project(0, 0, 0)"), spot


def draw(browser, tool, start, end, hold):
    """Presses at one place of the scene (x, y, z in m), draws to another, holds `hold` s or until the loop is left, lets go."""
    browser.button(tool).click()
    spots = [browser.run("return page.view.project(...arguments[0])", list(place)) for place in (start, end)]
    box = browser.canvas().rect
    (x0, y0), (x1, y1) = [(int(s[0] - box["width"] / 2), int(s[1] - box["height"] / 2)) for s in spots]
    hand = ActionChains(browser.driver, duration=50)
    hand.move_to_element_with_offset(browser.canvas(), x0, y0).click_and_hold()
    hand.move_to_element_with_offset(browser.canvas(), x1, y1).perform()
    until = time.monotonic() + hold
    try:
        while time.monotonic() < until:
            yield
            time.sleep(0.1)
    finally:
        ActionChains(browser.driver).release().perform()


def served(*arguments):
    """A test with a session of its own, which has to end well."""
    def decorate(test):
        @functools.wraps(test)
        def run(browser):
            session = Session(*arguments)
            try:
                browser.open(session)
                test(browser)
                expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
            finally:
                status = session.stop()
            expect(status == 130, f"the program ended with status {status}, not that of SIGINT: {session.said[-3:]}")
        return run
    return decorate


def temporary_copy(files):
    """A folder with the files {name: text}."""
    folder = tempfile.mkdtemp(prefix="jostle-page-")
    for name, text in files.items():
        write(folder, name, text)
    return folder


def write(folder, name, text):
    """Saves as editors do: a new file in the place of the old one."""
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path + ".new", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".new", path)


def read(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def run_all(tests, names):
    """Runs tests (functions of a browser) by name; returns the exit status."""
    browser = Browser()
    failed = 0
    try:
        for test in tests:
            name = test.__name__
            if names and name not in names:
                continue
            begun = time.monotonic()
            try:
                browser.size(1280, 800)
                browser.dark(False)
                test(browser)
                print(f"ok {test.__doc__.strip()} ({time.monotonic() - begun:.1f} s)", flush=True)
            except Exception as error:  # whatever it was, the next test runs
                failed += 1
                print(f"not ok {test.__doc__.strip()}: {str(error).splitlines()[0] if str(error) else error!r}", flush=True)
                if not isinstance(error, Failure):
                    traceback.print_exc()
                try:
                    browser.picture(f"failed-{name}")
                except Exception:  # the browser itself is gone
                    pass
    finally:
        browser.close()
    return 1 if failed else 0
