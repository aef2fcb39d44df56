"""What notebooks show: tables with units, pictures, and live pages in frames."""
import asyncio
import functools
import gc
import http.server
import os
import re
import shutil
import socket
import sys
import threading
import urllib.error
import urllib.request
import xml.etree.ElementTree

import numpy as np
import pytest

import jostle
from test_jostle import path  # noqa: F401

PATIENCE = 60  # s, for what should happen soon


@pytest.fixture(params=["with pandas", "without pandas"])
def has_pandas(request, monkeypatch):
    if request.param == "with pandas":
        pytest.importorskip("pandas")
    else:
        monkeypatch.setitem(sys.modules, "pandas", None)
    return request.param == "with pandas"


def test_tables_have_units(path, has_pandas):
    scene = jostle.Scene(path)
    scene.record(path.parent / "run.sqlite")
    scene.run(1)
    table = scene.table()
    assert list(table)[:7] == ["id", "x", "y", "vx", "vy", "group", "state"] and list(table["state_name"]) == ["Walk"] * 4
    units = table.attrs["units"] if has_pandas else table.units
    assert units == {"x": "m", "y": "m", "vx": "m/s", "vy": "m/s"}
    assert list(scene.table(["id", "mass", "load", "group_name"], units=True)) == ["id", "mass [kg]", "load [N]", "group_name"]
    assert list(scene.table(["group_name"])["group_name"]) == ["people"] * 4
    probe = scene.probes()["line"]
    assert "time [s]" in probe and isinstance(probe, dict)
    scene.finish()
    recording = jostle.Recording(path.parent / "run.sqlite").table(["frame", "x"], units=True)
    assert list(recording) == ["frame", "x [m]"]
    runs = jostle.sweep(path, {"groups.people.set.mass": [60]}, seconds=0.1).table("density_max")
    assert (runs.attrs["units"] if has_pandas else runs.units) == {"density_max": "1/m2"}
    if has_pandas:
        frame = probe.frame()
        assert frame.shape == (len(probe["time [s]"]), len(probe)) and table.groupby("state_name")["x"].mean().notna().all()
    else:
        assert isinstance(table, dict) and "x [m]" in table._repr_html_() and "<td" in probe._repr_html_()
        with pytest.raises(jostle.Error, match="needs pandas: install"):
            table.frame()


def shapes(svg, name):
    """The elements of a name in an SVG, which must be well-formed."""
    return list(xml.etree.ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}" + name))


def people(svg):
    return [group for group in shapes(svg, "g") if group.get("class") == "people"]


def test_picture_of_a_scene(path):
    scene = jostle.Scene(path)
    scene.agent(0).set_memory("hits", 3)
    scene.step(2)
    svg = scene.show().svg
    assert sorted(len(list(group)) for group in people(svg)) == [1, 3] and "t = 0.10 s" in svg
    assert "agent 0: Call, " in svg and len(shapes(svg, "polyline")) == 1 and "west" in svg
    starts = [re.match(r"M([-\d.]+) ([-\d.]+)", one.get("d")).groups() for group in people(svg) for one in group]
    drawn = np.sort(np.array(starts, dtype=float)[:, 0])
    x = np.sort(scene["x"])
    assert np.allclose(np.diff(drawn) / np.diff(x), np.diff(drawn)[0] / np.diff(x)[0], rtol=0.02)  # one scale for all
    assert scene._repr_svg_() == svg and svg in scene._repr_html_()
    counts = [[cell for cell in re.findall(r"<td[^>]*>(.*?)</td>", row)] for row in scene._repr_html_().split("<tr>")[2:]]
    assert [row[1] for row in counts] == ["1", "3", "4"] and "#9679" in counts[0][0] and counts[2][0] == "all people"
    colours = {group.get("stroke") for group in people(svg)}
    assert all(f"color:{colour}" in scene._repr_html_() for colour in colours) and len(colours) == 2


def test_pictures_of_open_walls_and_odd_names(path):
    (path.parent / "odd.yaml").write_text(path.read_text().replace("jostle: 1", 'jostle: 1\ntitle: "A & <B>"'))
    scene = jostle.Scene(path.parent / "odd.yaml")
    closed = scene.show().svg
    scene.open("gate")
    scene.step()
    assert "stroke-dasharray" in scene.show().svg.split('class="people"')[0].split("polyline")[1] and "A &amp; &lt;B&gt;" in closed
    assert "<B>" not in scene._repr_html_() and shapes(scene.show().svg, "svg") is not None
    scene.close()
    assert scene._repr_html_() is None and scene._repr_svg_() is None
    emptied = jostle.Scene(path)
    for agent in emptied:
        agent.remove()
    emptied.step()
    assert len(emptied) == 0 and people(emptied.show().svg) == [] and "all people" in emptied._repr_html_()


def test_picture_of_a_recording(path):
    scene = jostle.Scene(path)
    scene.record(path.parent / "run.sqlite")
    scene.run()
    scene.finish()
    recording = jostle.Recording(path.parent / "run.sqlite")
    first, last = recording.show(0).svg, recording.show(paths=True).svg
    assert f"t = {recording['frame'][0] / recording.fps:.2f} s" in first and "t = 2.00 s" in last
    assert "agent 3: Walk" in last and len(shapes(last, "polyline")) == 1
    ways = [one for one in shapes(last, "path") if one.get("class") == "ways"]
    assert len(ways) == 1 and ways[0].get("d").count("M") == 4 and not any(one.get("class") for one in shapes(first, "path"))
    assert last in recording._repr_html_() and "frames a second" in recording._repr_html_()


def test_a_sweep_is_shown_by_variants(path):
    runs = jostle.sweep(path, {"groups.people.set.mass": [60, 90]}, seeds=(1, 2), seconds=0.2)
    variants = runs.variants("agents", "density_max")
    assert list(variants["runs"]) == [2, 2] and list(variants["agents"]) == [4, 4] and list(variants["agents ±"]) == [0, 0]
    assert variants.units["density_max"] == "1/m2" and "density_max [1/m2]" in runs._repr_html_() and " ± " in runs._repr_html_()


def test_a_comparison_of_recordings(path, has_pandas):
    files = []
    for seed in (1, 2):
        files.append(path.parent / f"{seed}.sqlite")
        with jostle.Scene(path, seed=seed) as scene:
            scene.record(files[-1])
            scene.run(1)
            scene.finish()
    compared = jostle.compare(*files, labels=["one", "two"])
    assert [side["name"] for side in compared.sides] == ["one", "two"] and compared.base == 0 and "two minus one" in compared.text
    figure = compared.figures["people"]["sides"]
    assert [side["mean"] for side in figure] == [4, 4]
    table = compared.table(all=True)
    assert set(table["side"]) == {"two"} and len(table["figure"]) == len(compared.figures)
    assert "<table>" in compared._repr_html_() and jostle.compare(*files, labels=["one", "two"], base="two").base == 1
    with pytest.raises(jostle.Error, match="no such file"):
        jostle.compare(path.parent / "none.sqlite")
    with pytest.raises(jostle.Error):
        jostle.compare(files[0], path)
    with pytest.raises(ValueError):
        jostle.compare()


# ---- live pages ----


def answer(address):
    """Status and headers of an address; None where nothing listens."""
    try:
        with urllib.request.urlopen(address, timeout=PATIENCE) as got:
            return got.status, got.headers
    except urllib.error.HTTPError as error:
        return error.code, error.headers
    except urllib.error.URLError:
        return None


def port_of(page):
    return int(re.search(r":(\d+)/", page.address)[1])


def test_a_live_page_ends_with_its_scene(path):
    scene = jostle.Scene(path)
    page = scene.live()
    assert page.is_open and f'<iframe src="{page.address}"' in page._repr_html_() and page.html == scene.live().html
    status, headers = answer(page.address)
    assert status == 200 and "frame-ancestors http://localhost:*" in headers["content-security-policy"]
    assert headers["set-cookie"] is None and answer(f"http://127.0.0.1:{port_of(page)}/")[0] == 403
    assert scene.live(width=300).html.count('width="300"') == 1 and "ssh -L" in page.html
    page.stop()
    assert not page.is_open and answer(page.address) is None and "closed" in page._repr_html_()
    other = scene.live()
    assert other.is_open and not page.is_open and other.address != page.address
    address = other.address
    del page, other, scene
    gc.collect()
    assert answer(address) is None
    with jostle.Scene(path) as again:
        address = again.live(port=port_of_free()).address
    assert answer(address) is None


def port_of_free():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def test_only_python_steps_while_python_steps(path):
    alone, shown = jostle.Scene(path), jostle.Scene(path)
    page = shown.live(running=True)  # somebody pressed Play
    for _ in range(10):
        shown.step()
    assert shown.tick == 10 and shown.hash == alone.run(0.5).hash
    page.serve(0.4)
    assert shown.tick > 12
    there = shown.time
    shown.run(0.5)
    assert shown.time == pytest.approx(there + 0.5)


def test_live_pages_tell_what_to_do_elsewhere(path, monkeypatch):
    scene = jostle.Scene(path)
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/a/")
    assert "forward the port first" in scene.live().html
    with pytest.raises(jostle.Error, match="does not name pages"):
        jostle.Scene(path).live(frame="x; script-src *")
    monkeypatch.setitem(sys.modules, "google.colab", sys)
    with pytest.raises(jostle.Error, match="jostle view FILE"):
        jostle.Scene(path).live()


def test_a_recording_plays_until_nobody_holds_its_page(path):
    scene = jostle.Scene(path)
    scene.record(path.parent / "run.sqlite")
    scene.run(1)
    scene.finish()
    page = jostle.Recording(path.parent / "run.sqlite").live()
    address = page.address
    assert answer(address)[0] == 200 and "<iframe" in page._repr_html_()
    del page
    gc.collect()
    assert answer(address) is None
    (path.parent / "bad.sqlite").write_text("no recording")
    with pytest.raises(jostle.Error):
        jostle.live.RecordingPage(str(path.parent / "bad.sqlite"), None, 0, 100, 100)


class Notebook:
    """A page of another origin with frames, as a notebook's: served as localhost, the frames as 127.0.0.1."""

    def __init__(self, folder):
        handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(folder))
        handler.func.log_message = lambda *_: None
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.folder, self.address = folder, f"http://localhost:{self.server.server_port}/"

    def write(self, *pages):
        (self.folder / "notebook.html").write_text('<!doctype html><link rel="icon" href="data:,">' + "".join(page.html for page in pages))


def browser():
    webdriver = pytest.importorskip("selenium.webdriver")
    from selenium.webdriver.chrome.service import Service
    if not (shutil.which("chromium") and shutil.which("chromedriver")):
        pytest.skip("chromium and chromedriver are not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--window-size=1060,900", "--disable-dev-shm-usage", "--force-prefers-reduced-motion"):
        options.add_argument(argument)
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.set_page_load_timeout(PATIENCE)
    seldom = "window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 250);"
    driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": seldom})
    return driver


def test_a_notebook_shows_the_live_page_in_a_frame(path, tmp_path):
    notebook = Notebook(tmp_path)
    scene = jostle.Scene(path)

    async def ask(driver, script, text):
        """What the script in the frame returns once it is true, as the notebook's loop goes on."""
        for _ in range(10 * PATIENCE):
            said = await asyncio.to_thread(driver.execute_script, script)
            if said:
                return said
            await asyncio.sleep(0.1)
        raise AssertionError(text)

    async def use(driver):
        scene.step(3)  # a cell
        page = scene.live(width=1000, height=620)
        stranger = jostle.Scene(path)
        notebook.write(page, stranger.live(width=300, height=100, frame="https://notes.example"))
        await asyncio.to_thread(driver.get, notebook.address + "notebook.html")
        frames = driver.find_elements("tag name", "iframe")
        driver.switch_to.frame(frames[0])
        there = "const s = window.page?.crowd.next; return s && "
        assert await ask(driver, there + "s.slots === 4 && s.tick === 3", "the frame shows the scene as it is")
        assert page.watchers == 1
        await asyncio.sleep(0.5)
        assert scene.tick == 3  # who only looks changes nothing
        scene.step(5)
        assert await ask(driver, there + "s.tick === 8", "steps of Python are shown")
        play = "const b = [...document.querySelectorAll('button')].find((b) => b.textContent.trim() === 'Play'); b?.click(); return !!b"
        assert await ask(driver, play, "there is a button Play")
        assert await ask(driver, there + "s.tick > 12", "people let the scene run between cells")
        assert scene.tick > 12
        if os.environ.get("JOSTLE_PICTURES"):
            await asyncio.to_thread(driver.save_screenshot, os.environ["JOSTLE_PICTURES"] + "/notebook.png")
        driver.switch_to.default_content()
        driver.switch_to.frame(frames[1])
        assert await ask(driver, "return location.href === 'chrome-error://chromewebdata/' || !window.page", "a foreign page may not show it")
        assert stranger._page and jostle._library.lib.jo_live_watchers(stranger._page) == 0
        said = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert len(said) == 1 and "frame-ancestors https://notes.example" in said[0].replace('"', ""), said

    driver = browser()
    try:
        asyncio.run(use(driver))
    finally:
        driver.quit()
        notebook.server.shutdown()
