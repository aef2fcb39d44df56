"""Tests of what a page shows before anybody does anything: camera, names, the first tab, colours."""
import re

from harness import Session, expect, read

# The share of the window that people and walls span, across and up, and whether all people are in it.
SPAN = """
const v = page.view, low = [Infinity, Infinity], high = [-Infinity, -Infinity];
let outside = 0;
const points = page.crowd.everybody().map((p) => [...p, 0.9, true]);
for (const wall of page.scene.walls) for (const p of wall.points) points.push([...p, 0, false]);
for (const [x, y, z, person] of points) {
    const s = v.project(x, y, z);
    if (person && (!s || s[0] < 0 || s[1] < 0 || s[0] > v.wide || s[1] > v.high)) outside++;
    for (let k = 0; s && k < 2; k++) {
        low[k] = Math.min(low[k], s[k]);
        high[k] = Math.max(high[k], s[k]);
    }
}
return {across: (high[0] - low[0]) / v.wide, up: (high[1] - low[1]) / v.high, outside};
"""


def shown(browser, scene, test):
    """Opens a shipped scene, tests what is seen of it, and ends it."""
    session = Session("run", scene, "--view")
    try:
        browser.open(session)
        test()
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()


def fits(browser):
    """a scene fills the window from the side that shows most, a long one diagonally"""
    # Least spans, and least product of both: the office fills as much from its long side as from its end.
    for scene, across, up, both in (("office", 0.6, 0.4, 0.35), ("corridor", 0.65, 0.65, 0.42), ("wall-breaking", 0.65, 0.65, 0.42),
                                    ("dodgeball", 0.7, 0.3, 0.25)):
        def test():
            browser.wait("return page.view.peopled", "nobody is there")
            browser.run("page.view.home = null; page.view.goHome(); page.view.camera.updateMatrixWorld()")  # also where the scene has a camera
            span = browser.run(SPAN)
            expect(span["outside"] == 0, f"{scene}: {span['outside']} people are out of sight")
            expect(across < span["across"] <= 1.05 and up < span["up"] <= 1.05 and span["across"] * span["up"] > both,
                   f"{scene} spans {span['across']:.2f} by {span['up']:.2f} of the window")
            browser.picture(f"first-{scene}")
        shown(browser, f"scenes/{scene}.yaml", test)


def keeps_the_camera(browser):
    """the camera of a scene that has one is where the scene says"""
    given = [float(n) for n in re.findall(r"-?[\d.]+", re.search(r"^camera: (.*)$", read("scenes", "push-row.yaml"), re.M)[1])]
    def test():
        at, look = browser.run("return [page.view.perspective.position.toArray(), page.view.orbit.target.toArray()]")
        expect(max(abs(a - b) for a, b in zip(at + look, given)) < 0.01, f"the eye is at {at} and looks at {look}, not as {given}")
    shown(browser, "scenes/push-row.yaml", test)


def first_tab(browser):
    """the first tab says what this is, what to try and how it stands; nobody is chosen"""
    def test():
        expect(browser.run("return page.panel.front") == "scene", "another tab is in front")
        expect(browser.run("return page.slot") is None, "somebody is chosen")
        expect(browser.find("#tab-agent").is_enabled(), "nobody can be found by id, state or group")
        text = browser.wait("const t = document.getElementById('page-scene').innerText; return /second/.test(t) && t", "no exits")
        expect("two gaps" in text, f"what it shows is not said: {text[:120]!r}")
        people, said = browser.run("""const cells = [...document.querySelectorAll('#page-scene dt')];
            const value = (name) => Number(cells.find((c) => c.textContent === name).nextSibling.textContent.replace(/\\D/g, ''));
            return [page.machine.status.agents, value('people')];""")
        expect(people == said, f"{said} people are told, {people} are there")
        browser.button("Push somebody").click()
        expect(browser.run("return page.view.tool") == "push", "the button takes no tool")
        expect(browser.run("return [page.colour, page.field].join()") == "speed,density", "the scene's colours are not shown")
    shown(browser, "scenes/two-bottlenecks.yaml", test)


def names_with_room(browser):
    """names are shown where they have room, all or none when that is asked for, and none covers another"""
    def test():
        browser.run("""const tag = page.overlay.tag.bind(page.overlay);
            window.tags = [];
            page.overlay.tag = (text, spot, colour) => { window.tags.push([text, ...spot]); tag(text, spot, colour); };""")
        count = "window.tags = []; page.overlay.draw(1); return window.tags.length"
        draw = "page.overlay.drawn = ''; "
        some = browser.run(draw + count)
        expect(3 <= some <= 8, f"{some} names are shown at first")
        first = browser.run("return window.tags.map((tag) => tag[0])")
        expect(browser.run("return page.overlay.ranked[0].text") == first[0], f"the first name is not that of the way out: {first}")
        browser.run("page.view.turnBy(0, 0, 0.05); page.view.draw(performance.now())")
        far = browser.run(draw + count)
        expect(far < some, f"{far} names are shown where everything is tiny")
        browser.run("page.view.goHome(); page.view.draw(performance.now())")
        browser.find("body").send_keys("n")
        expect(browser.run("return page.overlay.names") == "all" and browser.run(draw + count) >= some, "N does not show all names")
        browser.find("body").send_keys("n")
        expect(browser.run("page.overlay.point(null);" + draw + count) == 0, "N does not hide the names")
        browser.run("const l = page.overlay.labels[0]; page.overlay.point(page.view.project(...l.at, 0).slice(0, 2))")
        expect(browser.run(draw + count) >= 1, "no name under the pointer")
        browser.find("body").send_keys("n")
        boxes = browser.run(draw + "window.tags = []; page.overlay.draw(1); return window.tags.map(([text, x, y]) => { const w = page.overlay.pen.measureText(text).width / 2 + 5; return [x - w, y - 9, x + w, y + 9]; })")
        over = [(a, b) for i, a in enumerate(boxes) for b in boxes[:i] if a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]]
        expect(not over, f"names cover each other: {over[:1]}")
    shown(browser, "scenes/office.yaml", test)


def opens_on_most(browser):
    """parameters open on the state with most people"""
    def test():
        browser.wait("return page.parameters.opened", "no state was chosen")
        most, chosen = browser.run("""const counts = page.machine.status.states.flat(), p = page.parameters;
            return [Math.max(...counts), page.machine.status.states[p.machine][p.state]];""")
        expect(chosen >= 0.8 * most, f"the state that is shown has {chosen} people, another one {most}")
        # Until the tab is opened it goes with the crowd; from then on it stays.
        browser.run("window.other = (page.parameters.state + 1) % page.scene.machines[0].states.length")
        ask = """const status = JSON.parse(JSON.stringify(page.machine.status));
            status.states[0] = status.states[0].map((n, i) => (i === window.other ? 1e6 : n));
            page.parameters.take(status);
            return page.parameters.state === window.other;"""
        expect(browser.run(ask), "it does not go with the crowd")
        browser.find("#tab-parameters").click()
        browser.run("window.other = (page.parameters.state + 1) % page.scene.machines[0].states.length")
        expect(not browser.run(ask), "what is looked at changes by itself")
    shown(browser, "scenes/office.yaml", test)


def colours_of_levels(browser):
    """people are coloured by their way and by levels of service, with a legend"""
    def test():
        expect(browser.run("return page.colour") == "direction", "the scene's colour is not taken")
        expect(browser.run("return [...document.querySelectorAll('#legend li')].map((n) => n.textContent.trim()).join()") == "east,north,west,south", "no legend of ways")
        browser.run("page.colourBy('service')")
        expect(browser.run("return document.querySelectorAll('#legend li').length") == 6, "no six levels")
        browser.wait("return page.crowd.next.most === 8", "no densities come")
        levels = browser.run("const t = page.view.tables.service.image.data; return new Set([...Array(256).keys()].map((i) => t.slice(4 * i, 4 * i + 3).join())).size")
        expect(levels == 6, f"{levels} colours")
    shown(browser, "scenes/circle.yaml", test)


TESTS = [fits, keeps_the_camera, first_tab, names_with_room, opens_on_most, colours_of_levels]
