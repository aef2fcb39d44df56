"""Tests of the live page: see run.sh."""
import functools
import json
import os
import shutil
import subprocess
import sys
import time

import figures
import following
import nested
import reach
import sight
import steady
import storeys
from harness import JOSTLE, Session, draw, expect, read, run_all, served, settle, temporary_copy, wait_for, write
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select


# The share of people on whose spot of the picture there is colour; the floor and walls are grey.
COLOURED = """
const v = page.view, gl = v.renderer.getContext();
v.people.group.visible = arguments[0];
v.dirty = true;
v.draw(performance.now());
const spot = new Uint8Array(4);
let seen = 0, all = 0;
for (let slot = 0; slot < page.crowd.next.slots; slot += 3) {
    const at = page.crowd.position(slot, page.crowd.share(performance.now()));
    const s = at && v.project(at[0], at[1], 1.25);
    if (!s || s[0] < 0 || s[1] < 0 || s[0] >= v.wide || s[1] >= v.high) continue;
    gl.readPixels(s[0] * v.ratio, gl.drawingBufferHeight - 1 - s[1] * v.ratio, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, spot);
    all++;
    if (Math.max(spot[0], spot[1], spot[2]) - Math.min(spot[0], spot[1], spot[2]) > 50) seen++;
}
v.people.group.visible = true;
v.dirty = true;
return [seen, all];
"""


@served("run", "scenes/office.yaml", "--view")
def loads(browser):
    """the page loads and shows the people where they are"""
    # A picture is drawn before its pixels are read, in one go: the browser keeps none.
    seen, total = browser.run(COLOURED, True)
    without, _ = browser.run(COLOURED, False)
    expect(total > 50, f"only {total} people are in the picture")
    expect(seen > 0.8 * total, f"colour on the spot of {seen} of {total} people")
    expect(without < 0.25 * total, f"colour on the spot of {without} of {total} people who are hidden")
    browser.run("page.view.turnBy(0, -0.15, 2.6); window.pictures = Infinity; window.earlier = page.view.renderer.info.render.frame")
    browser.wait("return page.view.renderer.info.render.frame > window.earlier", "the loop draws no picture")
    browser.picture("office")
    draws = browser.run("return page.view.renderer.info.render.calls")
    expect(0 < draws <= 25, f"{draws} draw calls")
    dark = browser.run("""const u = page.view.ground.decks[0].uniforms, [x0, y0, w, h] = u.shaded.value.toArray(), c = u.shade.value.image;
        const data = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        const alpha = (x, y) => data[4 * (Math.floor(c.height * (1 - (y - y0) / h)) * c.width + Math.floor(c.width * (x - x0) / w)) + 3];
        const [a, b] = page.scene.walls[0].points, l = Math.hypot(b[0] - a[0], b[1] - a[1]), n = [(b[1] - a[1]) / l, (a[0] - b[0]) / l];
        return [0.2, 2.5].map((d) => Math.max(...[d, -d].map((s) => alpha((a[0] + b[0]) / 2 + s * n[0], (a[1] + b[1]) / 2 + s * n[1]))));""")
    expect(dark[0] > 40 > 10 > dark[1], f"the floor's shade beside a wall and away from it is {dark}")
    browser.run("""
        HTMLAnchorElement.prototype.click = function () { window.saved = this.download; };
        URL.createObjectURL = (blob) => { blob.arrayBuffer().then((b) => (window.data = new Uint8Array(b))); return '#'; };""")
    browser.button("Picture").click()
    name, data = browser.wait("return window.data && [window.saved, window.data.length > 20000 && [...window.data.slice(1, 4)]]", "no picture is saved")
    expect(name == "Office.png" and bytes(data) == b"PNG", f"{name}: {data}")


# Takes two frames between pictures, of which the former has more people than there is room for.
LARGER = """
const { people } = page.view, { next, person, personVersion } = page.crowd, slots = 2 * people.capacity;
Object.assign(people, { fresh: 2, stale: true });
people.takeFrames({ next, previous: { ...next, slots, bytes: new Uint8Array(8 * slots).fill(255) }, person, personVersion });
return people.capacity >= slots;
"""


@served("run", "scenes/office.yaml", "--view")
def pauses(browser):
    """Space stops the time, the full stop is one step, speed and restart work"""
    tick = "return page.crowd.next.tick"
    browser.find("body").send_keys(" ")
    browser.wait("return page.bar.paused && document.querySelector('#time button').textContent === 'Play'", "no pause")
    time.sleep(0.3)
    stopped = browser.run(tick)
    time.sleep(0.6)
    expect(browser.run(tick) == stopped, "time goes on while it is stopped")
    browser.find("body").send_keys(".")
    browser.wait("return page.crowd.next.tick === arguments[0]", "not one step", stopped + 1)
    browser.find("body").send_keys(" ")
    browser.wait("return page.crowd.next.tick > arguments[0]", "time does not go on", stopped + 3)
    Select(browser.find("#time select")).select_by_value("4")
    browser.wait("return page.charts.dense.times.length > 2 && page.bar.speed.value === '4'", "no speed")
    Select(browser.find("#time select")).select_by_value("1")  # that the beginning after the restart lasts
    browser.find("#more").click()
    seed = browser.find("#menu input")
    seed.clear()
    seed.send_keys("7")
    browser.button("Restart").click()
    browser.wait("return page.scene.seed === 7 && page.crowd.next.time < 5", "no new start with seed 7")
    expect(browser.run(LARGER), "a frame before the newest, with more people, has no room")


STEP = "page.connection.send({do: 'step', n: arguments[0]})"
PLACES = """
const out = {};
for (let slot = 0; slot < page.crowd.next.slots; slot++) {
    const at = page.crowd.position(slot, 1);
    if (at) out[slot] = at;
}
return out;
"""


def step_to(browser, tick):
    now = browser.run("return page.crowd.next.tick")
    browser.run(STEP, tick - now)
    browser.wait("return page.crowd.next.tick === arguments[0]", f"step {tick} was not reached", tick)


def start_stopped(browser):
    """From the beginning, with the time stopped."""
    browser.run("page.connection.send({do: 'restart'}); page.connection.send({do: 'pause', on: true})")
    browser.wait("return page.bar.paused && page.crowd.next.tick < 20", "no start with the time stopped")
    time.sleep(0.3)
    expect(browser.run("return page.crowd.next.tick") == 0, "the time was not stopped at once")


@served("run", "scenes/office.yaml", "--view")
def throws(browser):
    """a box that is thrown with the mouse moves people; without it nothing else happens"""
    start_stopped(browser)
    step_to(browser, 60)
    alone = browser.run(PLACES)
    start_stopped(browser)
    bodies = browser.run("return page.scene.bodies.length")
    browser.run("page.act.size.value = 1; page.act.mass.value = 300")
    for _ in draw(browser, "Throw", (14, 12, 0), (18, 12, 0), 0.1):
        expect(browser.run("return page.tools.gesture && page.tools.gesture.kind") == "throw", "no throw is under way")
        browser.picture("throw")
    step_to(browser, 60)
    browser.wait("return page.scene.bodies.length === arguments[0]", "no box more", bodies + 1)
    place = browser.run("return page.crowd.bodyPosition(arguments[0])", bodies)
    expect(10 < place[0] < 30 and 4 < place[1] < 20, f"the box is at {place}")
    hit = browser.run(PLACES)
    moved = [s for s in alone if s in hit and abs(alone[s][0] - hit[s][0]) + abs(alone[s][1] - hit[s][1]) > 0.1]
    expect(len(moved) >= 3, f"{len(moved)} people moved by the box")
    browser.picture("thrown")


@served("run", "scenes/office.yaml", "--view")
def pulls(browser):
    """a desk is dragged along, a person is pushed by as many newtons as are drawn"""
    settle(browser, "Drag")
    desk = browser.run("return page.crowd.bodyPosition(0)")
    for _ in draw(browser, "Drag", desk, (desk[0] + 4, desk[1] + 2.5, desk[2]), 4):
        pass
    now = browser.run("return page.crowd.bodyPosition(0)")
    gone = ((now[0] - desk[0]) ** 2 + (now[1] - desk[1]) ** 2) ** 0.5
    expect(gone > 1, f"the desk was dragged by {gone:.2f} m")
    settle(browser, "Push")
    start_stopped(browser)
    # Somebody at the far wall, where nobody is in front.
    slot, *at = browser.run("""
        let best = null;
        for (let slot = 0; slot < page.crowd.next.slots; slot++) {
            const p = page.crowd.position(slot, 1);
            if (p && p[0] > 10 && p[0] < 26 && (!best || p[1] > best[2])) best = [slot, ...p];
        }
        return best;""")
    most = 0
    for _ in draw(browser, "Push", (*at, 1.2), (at[0], at[1] - 3, 0), 20):
        browser.run("page.connection.send({do: 'step', n: 1})")
        most = max(most, browser.run("""return Math.max(0, ...(page.overlay.forces ?? []).filter((f) => f.kind === 'external')
            .map((f) => Math.hypot(f.fx, f.fy)))"""))
        if most > 0:
            break
    expect(600 < most < 900, f"a push of {most:.0f} N was felt, of about 750")
    browser.picture("push")


def breaks(browser):
    """a breakpoint pauses the page and shows the person, with the reason, also to a page that opens later"""
    session = Session("run", "scenes/office.yaml", "--view", "--fast", "--break", "agent 9 enters Wait", "--break", "anybody enters Press")
    try:
        wait_for(lambda: any("breakpoint" in line for line in session.said), "no breakpoint is met")
        browser.open(session)
        for _ in range(2): # first of those that were met before the page opened, then with the page
            browser.wait("return page.bar.paused && page.person", "the page does not pause at a breakpoint", patience=60)
            browser.wait("return /breakpoint/.test(document.body.textContent)", "the page does not say which one")
            expect(browser.run("return page.messages.standing.has('break')"), "which one it was does not stay")
            at = browser.run("return [page.person.id, page.person.state, document.getElementById('page-agent').checkVisibility()]")
            expect(at[1] in ("Wait", "Press") and at[2], f"agent {at[0]} in {at[1]} is shown, in a panel that is {'' if at[2] else 'not '}open")
            # In one script: once the time goes on, the next breakpoint may show somebody at once.
            expect(browser.run("page.inspect(null); const gone = page.person === null; page.bar.toggle(); return gone"), "the person is not let go")
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()


def check_dressed(browser):
    """Each kind of scenery has a shape, and that of the Tawaf is within its budget."""
    kinds = json.loads(read("scripts", "scene.schema.json"))["definitions"]["scenery"]["properties"]["kind"]["enum"]
    wrong = browser.run("""return arguments[0].filter((kind) => {
        const item = {kind, at: [[1, 2]], turns: [30], through: [[0, 0], [4, 0], [4, 3]], size: [4, 3, 3], doors: [1]};
        const {pile, paint} = page.view.ground.scenery.shape([item]), numbers = [pile.position, pile.normal, paint.position].flatMap((rows) => [...rows.values()]);
        return !numbers.length || !numbers.every(Number.isFinite);
    })""", kinds)
    expect(len(kinds) > 20 and not wrong, f"these kinds have no shape: {wrong}")
    rows, lost = browser.run("""const train = {kind: "train", at: [[0, 0]], turns: [0], size: [4, 3, 3], body: "train"}, {scenery} = page.view.ground;
        const {pile} = scenery.shape([train], [{name: null}, {name: "train"}]);
        return [[...new Set(pile.part.values().filter((_, i) => i % 3 === 2))], scenery.shape([train], [{name: null}]).pile.position.length]""")
    expect(rows == [1] and lost == 0, f"scenery of body 1 takes the poses of {rows}; without its body it has {lost} numbers")
    meshes, triangles, material = browser.run("""const {scenery, decks: [deck]} = page.view.ground;
        const made = deck.group.children.filter((n) => [scenery.material, deck.paintMaterial].includes(n.material));
        return [made.length, made.reduce((sum, n) => sum + n.geometry.attributes.position.count / 3, 0), deck.floor.material.defines.MATERIAL]""")
    expect(meshes == 2 and 5000 < triangles < 300000 and material == 1, f"scenery: {meshes} meshes of {triangles} triangles on floor {material}")


@served("run", "scenes/tawaf-few.yaml", "--view")
def inspects(browser):
    """a click on a person shows state, parameters, velocities and why it changed"""
    check_dressed(browser)
    browser.run("page.bar.toggle()")
    browser.wait("return page.bar.paused && page.crowd.share(performance.now()) === 1", "no pause")
    # Near enough that the person is large, and alone under the pointer.
    slot = browser.run("""
        const slot = [...Array(page.crowd.next.slots).keys()].find((s) => page.crowd.alive(s));
        const at = page.crowd.position(slot, 1), t = page.view.orbit.target;
        page.view.turnBy(0, 0.3, 10);
        page.view.moveBy(at[0] - t.x, at[1] - t.y);
        return slot;""")
    time.sleep(0.5)
    spot = browser.run("const a = page.crowd.position(arguments[0], 1); return page.view.project(a[0], a[1], 0.9)", slot)
    box = browser.canvas().rect
    ActionChains(browser.driver).move_to_element_with_offset(
        browser.canvas(), int(spot[0] - box["width"] / 2), int(spot[1] - box["height"] / 2)).click().perform()
    chosen = browser.wait("return page.person && [page.person.slot, page.person.id, page.person.state]", "nobody was chosen")
    expect(chosen[0] == slot, f"slot {chosen[0]} was chosen, not {slot}")
    browser.wait("return page.view.coarse === 1 || page.view.whole", "what is told of a person keeps the picture coarse")
    panel = browser.find("#page-agent").text
    expect(f"Agent {chosen[1]}" in panel and chosen[2] in panel, f"the panel says {panel[:80]!r}")
    expect("tawaf.lua" in panel, "the panel does not say where parameters were set")
    expect(browser.run("return document.querySelectorAll('.velocity circle').length") >= 2, "no velocities")
    expect("laps" in panel, "no memory")
    expect("Why it stays" in panel and "missing" in panel, "the panel does not say why the person stays")
    terms = browser.run("return document.querySelectorAll('.why .transition .terms li').length")
    expect(terms >= 2, f"{terms} terms of transitions are shown")
    # Also of somebody who is found by id or by state in the pause.
    for text, same in (("3", "page.person.id === 3"), ("Circle", "page.person.state === 'Circle'")):
        browser.run("page.agentPage.page.find(arguments[0])", text)
        browser.wait(f"return page.person && {same}", f"nobody is found as {text}")
        browser.wait("return document.querySelectorAll('.why .transition').length > 0", f"nothing is said of {text}")
    browser.run("document.querySelector('.why').scrollIntoView()")
    browser.picture("why")
    browser.run("page.inspect(arguments[0])", slot)
    browser.wait("return page.person && page.person.slot === arguments[0]", "the first person is not chosen again", slot)
    # The time stands still since before the click: half-planes and velocities are those of this moment.
    expect(browser.run("return page.bar.paused"), "the time goes on")
    planes = browser.run("return [document.querySelectorAll('.velocity polygon').length, page.agentPage.unseen.hidden]")
    expect(planes[0] > 0 and planes[1], f"{planes[0]} half-planes are drawn of somebody who was clicked in a pause")
    browser.find("body").send_keys("f")
    browser.run("page.bar.toggle()")
    before = browser.run("return page.view.controls.target.toArray()")
    browser.wait("return page.view.controls.target.distanceTo({x: arguments[0], y: arguments[1], z: 0}) > 0.3",
                 "the eye does not follow", before[0], before[1])
    browser.picture("inspect")
    browser.find("#tab-machine").click()
    browser.wait("return [...document.querySelectorAll('.graph .count')].reduce((s, n) => s + Number(n.textContent.replace(/\\D/g, '')), 0) > 10",
                 "no counts in the graph of states")
    browser.picture("machine")
    browser.find("#tab-charts").click()
    browser.picture("charts")
    # What the scene is about may still be shown: a card that came by itself does not keep Escape from the person.
    browser.run("page.about.show(true); page.about.asked = false")
    browser.find("body").send_keys(Keys.ESCAPE)
    browser.wait("return page.slot === null && page.about.node.hidden", "Escape does not let go")


WALKERS = {
    "scene.yaml": """jostle: 1
title: "Walkers <b>60</b>"
step: 0.05
duration: 600
places:
  room: {polygon: [[0, 0], [20, 0], [20, 12], [0, 12]]}
  goals: {point: [600, 6]}
walls:
  - {line: [[0, -0.5], [50, -0.5]]}
  - {line: [[0, 12.5], [50, 12.5]]}
  - {line: [[30, 0], [30, 12]], name: gate}
groups:
  walkers: {behaviour: walk.lua, count: 60, fill: random, in: room}
""",
    "walk.lua": """return machine {
  name = "walk", version = 1, start = "Walk",
  defaults = { speed = 1.2, perception = 4 },
  states = {
    Walk = { steer = seek "goals", push = 20,
      { to = "Rest", when = heard "rest" } },
    Rest = { steer = hold, lasts = 2,
      { to = "Walk", when = lasted } },
  },
}
""",
}


MANNERS = {
    "mods/manners/mod.yaml": """name: manners
title: Manners
version: 1.0
api: 1
settings:
  pace: {value: 1.2, unit: m/s, least: 0.1, greatest: 3, meaning: speed at which people walk}
  shoves: {value: false, meaning: whether people push}
  manner: {value: polite, choices: [polite, quite rude], meaning: how people meet}
""",
    "mods/manners/patches/walk.lua": """return patch "walk" {
  defaults = { speed = settings.pace, absorb = settings.manner == "polite" and 0.1 or 0.3 },
  states = { Walk = { push = settings.shoves and 60 or 5 } } }
""",
}


def with_walkers(test, more=None, added=""):
    """A test with the walkers' files in a folder of its own."""
    @functools.wraps(test)
    def run(browser):
        files = {**WALKERS, **(more or {})}
        files["scene.yaml"] += added
        folder = temporary_copy(files)
        session = Session("run", os.path.join(folder, "scene.yaml"), "--view")
        try:
            browser.open(session)
            test(browser, folder)
        finally:
            status = session.stop()
            shutil.rmtree(folder)
        expect(status == 130, f"the program ended with status {status}, not that of SIGINT: {session.said[-3:]}")
    return run


def with_manners(test):
    """A test with the walkers and a mod that has settings."""
    return with_walkers(test, MANNERS, "mods: {manners: {}}\n")


@with_manners
def settings(browser, _):
    """a setting of a mod that is changed reloads the behaviours, and the page shows what runs"""
    walk = "page.scene.machines[0].states.find((s) => s.name === 'Walk').parameters.find((p) => p.name === 'push').value"
    shown = "page.scene.mods[0].settings.find((s) => s.name === '%s').value"
    browser.find("#tab-parameters").click()
    expect("whether people push" in browser.find("[data-mod=manners]").text, "the panel does not say what a setting means")
    browser.find("[data-parameter='manners shoves'] input[type=checkbox]").click()
    browser.wait(f"return {shown % 'shoves'} === true && {walk} === 60", "a box does not take effect")
    browser.wait("return [...document.querySelectorAll('#messages, [role=log]')].some((n) => /mod manners: shoves is true/.test(n.textContent))"
                 " || /mod manners: shoves is true/.test(document.body.textContent)", "the page does not say what changed")
    Select(browser.find("[data-parameter='manners manner'] select")).select_by_visible_text("quite rude")
    browser.wait(f"return {shown % 'manner'} === 'quite rude'", "a choice does not take effect")
    number = browser.find("[data-parameter='manners pace'] input[type=number]")
    number.clear()
    number.send_keys("0.3", Keys.ENTER)
    browser.wait(f"return {shown % 'pace'} === 0.3", "a number does not take effect")
    number = browser.find("[data-parameter='manners pace'] input[type=number]")
    number.clear()
    number.send_keys("12", Keys.ENTER)
    browser.wait("return /must be from 0.1 to 3, not 12/.test(document.body.textContent)", "a number out of range is not refused")
    expect(browser.run(f"return {shown % 'pace'}") == 0.3, "a refused number is taken")
    browser.picture("settings")
    browser.run("page.connection.send({do: 'pause', on: true})")
    browser.wait("return page.bar.paused", "no pause")
    time.sleep(0.5)
    tick = browser.run("return page.crowd.next.tick")
    Select(browser.find("[data-parameter='manners manner'] select")).select_by_visible_text("polite")
    browser.wait(f"return {shown % 'manner'} === 'polite'", "a choice does not take effect while the time is stopped", patience=10)
    late = browser.run("return document.querySelector('#page-parameters').textContent")
    expect("not taken" not in late and browser.run("return page.crowd.next.tick") == tick, "the time went on, or the page says otherwise")


@with_walkers
def edits(browser, _):
    """a parameter that is changed takes effect, and Lua to keep it is shown"""
    mean = "return page.charts.speed.values.get('')?.slice(-1)[0]"
    browser.run("page.connection.input('open', 'gate')")  # they walk for as long as a busy machine may take
    browser.wait("const v = page.charts.speed.values.get(''); return v && v.slice(-1)[0] > 0.9", "nobody walks")
    browser.find("#tab-parameters").click()
    Select(browser.driver.find_elements("css selector", "#page-parameters select")[1]).select_by_visible_text("Walk")
    number = browser.find("[data-parameter=speed] input[type=number]")
    number.clear()
    number.send_keys("0.2", Keys.ENTER)
    # The server tells all pages of it, and the panel is built anew.
    browser.wait("""const walk = page.scene.machines[0].states.find((s) => s.name === 'Walk');
        return walk.parameters.find((p) => p.name === 'speed').value === 0.2""", "no scene message tells of the new value")
    # Another page's change arrives as a new scene message; who types here goes on typing.
    browser.run("""const scene = JSON.parse(JSON.stringify(page.scene)), walk = scene.machines[0].states.find((s) => s.name === 'Walk');
        walk.parameters.find((p) => p.name === 'push').value = 33;
        page.takeScene(scene);""")
    expect(browser.find("[data-parameter=push] input[type=number]").get_attribute("value") == "33", "a new scene message is not shown")
    kept = browser.run("return document.activeElement.matches('[data-parameter=speed] input[type=number]')")
    expect(kept, "the focus is lost when a scene message comes")
    browser.wait("const v = page.charts.speed.values.get(''); return v.slice(-1)[0] < 0.3", "speed 0.2 has no effect")
    expect(browser.run(mean) > 0.05, "people stand still at speed 0.2")
    browser.find("[data-parameter=speed] button").click()
    text = browser.wait("return document.querySelector('.paste:not([hidden]) code')?.textContent", "no line of Lua")
    expect("Walk" in text and "speed = 0.2" in text, f"the line of Lua is {text!r}")
    browser.picture("parameters")
    browser.find("[data-parameter=speed] input[type=range]").send_keys(Keys.END)
    browser.wait("const v = page.charts.speed.values.get(''); return v.slice(-1)[0] > 0.5", "the slider has no effect")
    # What cannot be is refused, with the range.
    browser.run("page.connection.input('set', 'walk', 'Walk', 'speed', -5)")
    browser.wait("return /speed/.test(document.getElementById('messages').textContent)", "no refusal is shown")


@with_walkers
def given_colours(browser, folder):
    """states and groups have the colours that files give them, in picture and legend, as soon as they are saved"""
    shown = """const i = page.scene[arguments[0]].findIndex((n) => n.name === arguments[1]), by = arguments[0].slice(0, -1);
        page.colourBy(by);
        return [[...page.view.people.uniforms.colours.value.image.data.slice(4 * i, 4 * i + 3)].join(),
            getComputedStyle(document.querySelectorAll('#legend .swatch')[i]).backgroundColor.replace(/[^0-9,]/g, '')];"""
    write(folder, "walk.lua", WALKERS["walk.lua"].replace("Walk = {", 'Walk = { colour = "#10a0c0", pose = "point",'))
    browser.wait("return page.scene.states.some((s) => s.colour === '#10a0c0')", "the colour of a state does not come")
    expect(browser.run(shown, "states", "Walk") == ["16,160,192"] * 2, f"the state is {browser.run(shown, 'states', 'Walk')}")
    # The atlas of sprites has what a state says that people do, also one that was loaded again; what nobody does is left out.
    covers = browser.run("""const { view } = page, { people } = view, { columns, phases } = people.atlas;
        people.levels.pixels = [1e9, 1e9, 1e9];
        view.dirty = true;
        view.draw(performance.now());
        return [1, 5, 6].map((action) => people.uniforms.boxes.value.image.data.slice(4 * (3 * phases + action) * columns, 4 * (3 * phases + action + 1) * columns).some(Boolean));""")
    expect(covers == [True, True, False], f"of brace, point and sit the atlas has {covers}")
    write(folder, "scene.yaml", WALKERS["scene.yaml"].replace("count: 60,", "count: 60, colour: vermilion,"))
    browser.wait("return page.scene.groups[0].colour === '#d55e00'", "the colour of a group does not come")
    expect(browser.run(shown, "groups", "walkers") == ["213,94,0"] * 2, f"the group is {browser.run(shown, 'groups', 'walkers')}")


@with_walkers
def gates(browser, _):
    """a gate opens and a signal is heard by buttons"""
    expect(browser.find("h1").text == "Walkers <b>60</b>", "a title is not shown as it is")
    browser.find("#tab-act").click()
    gate = browser.find("#page-act button[aria-label='Open gate']")
    gate.click()
    browser.wait("return page.view.ground.open.gate && document.querySelector('#page-act button').textContent === 'Close'",
                 "the gate does not open")
    browser.button("rest").click()
    browser.wait("return page.machine.status.states[0].some((n, i) => page.scene.machines[0].states[i].name === 'Rest' && n === 60)",
                 "nobody rests")
    browser.picture("gates")


@with_walkers
def reloads(browser, folder):
    """an error of a reload stands over the picture, and goes when it is mended"""
    write(folder, "walk.lua", WALKERS["walk.lua"].replace('seek "goals"', 'seeek "goals"'))
    text = browser.wait("const e = document.getElementById('errors'); return !e.hidden && e.textContent", "no error is shown")
    expect("walk.lua:5" in text and "seeek" in text and "push = 20" in text, f"the error is {text[:200]!r}")
    browser.picture("reload-error")
    tick = browser.run("return page.crowd.next.tick")
    browser.wait("return page.crowd.next.tick > arguments[0]", "the run stands still", tick + 5)
    write(folder, "walk.lua", WALKERS["walk.lua"].replace("speed = 1.2", "speed = 0.4"))
    browser.wait("return document.getElementById('errors').hidden", "the error stays")
    # Three errors, one after the other and each in sight, leave most of the picture free, on a small window too.
    wrong = WALKERS["walk.lua"].replace('seek "goals"', 'seeek "goals"').replace("steer = hold", "steer = hald").replace('heard "rest"', 'herd "rest"')
    write(folder, "walk.lua", wrong)
    browser.wait("return document.querySelectorAll('#errors li').length === 3", "no three errors are shown")
    for wide, high in ((1280, 800), (1024, 640), (390, 844)):
        browser.size(wide, high)
        time.sleep(0.3)
        covered = browser.run("const box = (id) => document.getElementById(id).getBoundingClientRect().height; return box('errors') / box('stage')")
        expect(0 < covered < 0.5, f"at {wide} x {high} the errors cover {100 * covered:.0f} % of the picture")
        expect(browser.run("const e = document.getElementById('errors'); e.scrollTop = 1e6; const last = e.querySelector('li:last-of-type').getBoundingClientRect(); return last.bottom <= e.getBoundingClientRect().bottom + 1"), "the last error is not reached")
    browser.picture("three-errors")
    browser.size(1280, 800)
    write(folder, "walk.lua", WALKERS["walk.lua"].replace("speed = 1.2", "speed = 0.4"))
    browser.wait("return document.getElementById('errors').hidden", "the errors stay")
    browser.wait("return page.charts.speed.values.get('').slice(-1)[0] < 0.6", "the mended file has no effect")
    # What a reload changed stands in a note, which can be pinned and closed.
    note = browser.wait("const n = document.querySelector('#news .note'); return n && n.innerText", "no note on the reload")
    expect("walk.lua is live from" in note and "Walk 60 → 60" in note, f"the note is {note!r}")
    pinned = browser.run("document.querySelector('#news [aria-pressed]').click(); return document.querySelectorAll('#news .pinned').length")
    expect(pinned == 1, "the note is not pinned")
    browser.picture("reload-note")
    browser.run("document.querySelector('#news .pinned [aria-label^=Close]').click()")
    expect(browser.run("return document.querySelectorAll('#news .pinned').length") == 0, "the note is not closed")


def plays(browser):
    """a match of dodge-ball is won by keys, and lost by who stands still; gamepad and touch drive, Escape pauses"""
    # The ball lies before the player; the opponent stands, and wins what is even at the end.
    scene = read("scenes", "dodgeball.yaml").replace("at: [3, 0, 0.11]", "at: [-2.5, 0.5, 0.11]").replace("rounds: 3", "rounds: 1") \
        .replace("points: 3", "points: 1").replace("easy:   {group: blue, set: {", "easy:   {group: blue, set: {speed: 0.1, ").replace("attention: 0.3", "attention: 0") \
        .replace("hard:   {group: blue, set: {", "hard:   {group: blue, set: {speed: 0.1, ").replace("time: 60", "time: 30").replace("at: [[4, 0]]", "at: [[1.2, 0]]")
    folder = temporary_copy({"scenes/dodgeball.yaml": scene, "behaviours/dodgeball.lua": read("behaviours", "dodgeball.lua")})
    session = Session("run", os.path.join(folder, "scenes/dodgeball.yaml"), "--view", "--log-input", os.path.join(folder, "round.log"))
    try:
        browser.open(session)
        card = browser.find("#game")
        expect(card.is_displayed() and "Dodge-ball" in card.text and "Play" in card.text and "Space: run" in card.text, f"the start card says {card.text!r}")
        expect(browser.run("return document.activeElement.textContent") == "Play", "Play has not the focus")
        browser.button("easy").click()
        browser.button("Play").send_keys(Keys.ENTER)
        browser.wait("return page.game.playing && page.player.on && !page.game.shown", "nobody plays")
        slot = browser.wait("return page.overlay.players.length ? page.overlay.players[0] + 1 : 0", "no player") - 1
        browser.run("page.connection.send({do: 'speed', factor: 0.5})")  # for busy machines
        drive(browser, slot, "page.game.shown || page.crowd.bodyPosition(0)[0] > 0")
        browser.wait("return page.game.shown === 'over'", "the round does not end")
        browser.picture("dodgeball")
        expect("You have won" in card.text and "red 1 : 0 blue" in card.text, f"the card says {card.text!r}")
        expect(browser.run("return document.getElementById('game-told').textContent") == "You have won", "screen readers are not told")
        browser.button("hard").click()
        browser.button("Again").send_keys(Keys.ENTER)
        browser.wait("return page.game.playing && page.scene.game.level === 'hard'", "no second match")
        # The line that is sent for a stick to the right, a button and Space; the camera looks east.
        pad = "navigator.getGamepads = () => [{connected: true, axes: arguments[0], buttons: [{pressed: arguments[1]}]}]"
        browser.run("page.connection.send({do: 'speed', factor: 0.2})")
        browser.run(pad, [1, 0], True)
        browser.wait("return page.player.sent === '0 0 -5 1'", "the gamepad does not drive")
        browser.run(pad, [0.1, 0.1], False)
        browser.wait("return page.player.sent === '0 0 0 0'", "the dead zone drives")
        browser.run("navigator.getGamepads = () => []")
        browser.run("window.dispatchEvent(new PointerEvent('pointerdown', {pointerType: 'touch'}))")
        stick = browser.run("const b = document.querySelector('.stick').getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]")
        touch = lambda kind, *points: browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})
        touch("touchStart", stick)
        touch("touchMove", (stick[0], stick[1] - 90))
        browser.wait("return page.player.sent === '0 5 0 0'", "touch does not drive")
        touch("touchEnd")
        browser.wait("return page.player.sent === '0 0 0 0'", "the stick does not come back")
        # A status that was under way when the time was stopped does not end the pause.
        browser.run("const { game } = page, take = game.take.bind(game); game.take = (status) => { game.last = status; take(status); }")
        browser.wait("return page.game.last && !page.game.last.paused", "no status comes")
        browser.run("const { last } = page.game; document.body.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true })); page.game.take(last)")
        browser.wait("return page.game.shown === 'pause' && page.bar.paused", "Escape does not pause")
        browser.button("Go on").click()
        browser.wait("return page.game.playing && !page.bar.paused", "it does not go on")
        browser.run(QUICK)
        browser.wait("return page.game.shown === 'over'", "the second round does not end")
        expect("You have lost" in card.text, f"the card says {card.text!r}")
        expect("won by red, 1 to 0" in " ".join(session.said) and "won by blue" in " ".join(session.said), f"the terminal says {session.said[-3:]}")
        logs = sorted(name for name in os.listdir(folder) if name.startswith("round"))
        expect(logs == ["round-2.log", "round-3.log", "round.log"], f"the rounds are in {logs}")
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()
        shutil.rmtree(folder)


# Held by keys while the camera of a game looks east: of tackle ahead, of catch to the ball until it is held, then thrown.
GAMES = (("tackle", "page.crowd.position(arguments[0], 1)[0] > 12"), ("catch", "page.game.shown || page.crowd.bodyPosition(0)[2] > 0.5"))


QUICK = "page.connection.send({do: 'speed', factor: 8})"


def ball_games(browser):
    """tackle and catch are played to an end by keys, with compass and names out of the way"""
    for name, until in GAMES:
        session = Session("run", f"scenes/{name}.yaml", "--view", "--no-watch", "--set", "game.rounds=1", "--set", "game.time=12")
        try:
            browser.open(session)
            card = browser.find("#game")
            browser.run(TAGS)
            tags = browser.run("return window.tagged()")
            expect(tags["names"] and not tags["under"], f"{name}: before the game the names are {tags}")
            browser.button("Play").send_keys(Keys.ENTER)
            browser.wait("return page.game.playing && page.player.on && page.overlay.players.length > 0", f"{name}: nobody plays")
            expect(browser.run("return window.tagged().names") == [], f"{name}: names are in the way")
            expect(not browser.find("#compass").is_displayed() and not browser.find("#scale").is_displayed(), f"{name}: the compass is in the way")
            slot = browser.run("return page.overlay.players[0]")
            if name == "tackle":
                ActionChains(browser.driver, duration=0).key_down("w").key_down(" ").perform()
                browser.wait(f"return {until}", "the runner does not run", slot)
                browser.run(QUICK)
                browser.wait("return page.game.shown === 'over'", "nobody gets through or down")
                ActionChains(browser.driver, duration=0).key_up("w").key_up(" ").perform()
            else:
                drive(browser, slot, until)
                ActionChains(browser.driver, duration=0).key_down(" ").perform()
                browser.wait("return page.game.shown || page.crowd.bodyPosition(0)[0] > 0", "the ball is not thrown")
                ActionChains(browser.driver, duration=0).key_up(" ").perform()
                browser.run(QUICK)
                browser.wait("return page.game.shown === 'over'", "the round does not end")
            won, lost = browser.run("return [page.game.state.winner === 'ours', page.game.state.winner === 'theirs']")
            said = "You have won" if won else "You have lost" if lost else "A draw"
            expect(said in card.text and (won or lost), f"{name}: the card says {card.text!r}")
            expect(browser.find("#compass").is_displayed(), f"{name}: the compass does not come back")
            expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
            browser.picture(name)
        finally:
            session.stop()


# window.tagged(): names that are drawn, and those of them under the compass.
TAGS = """
const overlay = page.overlay, tag = overlay.tag.bind(overlay);
let seen = [];
overlay.tag = (text, spot, colour) => { seen.push([text, spot]); tag(text, spot, colour); };
window.tagged = () => {
    seen = [];
    overlay.drawn = '';
    overlay.draw(1);
    const stage = document.getElementById('stage').getBoundingClientRect(), box = document.getElementById('compass').getBoundingClientRect();
    const under = ([text, [x, y]]) => Math.abs(x + stage.left - box.left - box.width / 2) < box.width / 2 + overlay.pen.measureText(text).width / 2 + 5
        && Math.abs(y + stage.top - box.top - box.height / 2) < box.height / 2 + 9;
    return { names: seen.map(([text]) => text), under: box.width ? seen.filter(under).map(([text]) => text) : [] };
};
"""


def drive(browser, slot, until):
    """Runs after the ball by the keys, as the camera of a game looks east, until a condition of the page holds."""
    keys = {"x": (Keys.ARROW_DOWN, Keys.ARROW_UP), "y": (Keys.ARROW_RIGHT, Keys.ARROW_LEFT)}
    held = set()
    end = time.monotonic() + 40
    while time.monotonic() < end:
        way = browser.run(f"""
            const b = page.crowd.bodyPosition(0), p = page.crowd.position(arguments[0], 1);
            return {until} ? null : {{x: b[0] - p[0], y: b[1] - p[1]}};""", slot)
        wanted = set() if way is None else {keys[a][d > 0] for a, d in way.items() if abs(d) > 0.12}
        hand = ActionChains(browser.driver, duration=0)
        for key in held - wanted:
            hand.key_up(key)
        for key in wanted - held:
            hand.key_down(key)
        hand.perform()
        held = wanted
        if way is None:
            return
    raise AssertionError("the ball was not kicked in 40 s")


def someone_else(browser):
    """Whoever is chosen in a recording is gone where, after a jump in time, their slot is another's."""
    parity = "return [...Array(page.crowd.next.slots).keys()].map((s) => (page.crowd.alive(s) ? page.crowd.next.bytes[8 * s + 7] & 1 : 2))"
    jump = "page.replay.seek(arguments[0])"
    for attempt in range(2):  # once to find a slot that is given anew, and once with it chosen
        browser.run(jump, 11.5)
        browser.wait("return page.crowd.next.time > 11", "no seek to 11.5 s")
        late = browser.run(parity)
        if attempt:
            browser.run("page.inspect(arguments[0])", slot)
        browser.run(jump, 8)
        browser.wait("return Math.abs(page.crowd.next.time - 8) < 0.6", "no seek to 8 s")
        given = [s for s, (a, b) in enumerate(zip(late, browser.run(parity))) if a + b == 1]
        expect(given, "no slot is given anew")
        slot = given[0]
    expect(browser.run("return page.slot") is None, "somebody else is shown as the one who was chosen")


def replays(browser):
    """a recording is played, stopped and looked through by its time bar"""
    folder = temporary_copy({})
    recording = os.path.join(folder, "run.sqlite")
    subprocess.run([JOSTLE, "run", "scenes/office.yaml", "--for", "12", "--record", recording, "--quiet"], check=True)
    session = Session("view", recording)
    try:
        browser.open(session)
        expect(browser.find("#replay").is_displayed(), "no time bar")
        expect(not browser.driver.find_elements("xpath", "//button[text()='Restart' and not(@hidden)]"), "a recording offers a restart")
        bar = browser.find("#replay input")
        browser.wait("return Number(document.querySelector('#replay input').max) > 11", "the bar does not know the end")
        browser.run("page.bar.paused || page.bar.toggle()")
        browser.wait("return page.bar.paused", "no pause")
        bar.send_keys(Keys.HOME)
        browser.run("page.replay.seek(8)")
        browser.wait("return Math.abs(page.crowd.next.time - 8) < 0.6", "no seek to 8 s")
        expect(browser.run("return page.crowd.next.slots") >= 240, "people are missing")
        browser.run("page.inspect([...Array(page.crowd.next.slots).keys()].find((s) => page.crowd.alive(s)))")
        browser.wait("return /state/.test(document.getElementById('page-agent').textContent)", "nothing is said of a person")
        browser.wait("return /jostle why SCENE --agent [0-9]+ --at/.test(document.getElementById('page-agent').textContent)", "the panel does not say how to ask why")
        browser.picture("replay")
        someone_else(browser)
        bar.send_keys(Keys.PAGE_DOWN, Keys.ARROW_RIGHT)
        browser.wait("return page.crowd.next.time < 2.6", "the keys do not move the bar")
        # Charts after jumps: points in the order of time, those of before kept, and no line over what nobody saw.
        browser.run("for (const s of [...page.charts.states, page.charts.speed, page.charts.dense]) s.clear()")
        for time in (9, 4, 6):
            browser.run(f"page.replay.seek({time})")
            browser.wait(f"return page.charts.dense.times.some((t) => Math.abs(t - {time}) < 0.2)", f"no point at {time} s")
        for series in ("states[0]", "speed", "dense"):
            times, seen = browser.run(f"return [page.charts.{series}.times, page.charts.{series}.seen]")
            expect(len(times) >= 3 and times == sorted(times), f"{series}: points lie at {times}")
            expect(not any(seen), f"{series}: a line leads over a jump")
        browser.run("page.replay.seek(2)")
        browser.wait("return page.crowd.next.time < 2.6", "no seek to 2 s")
        at = browser.run("return page.crowd.next.time")
        browser.button("Play").click()
        browser.wait("return page.crowd.next.time > arguments[0]", "it does not play", at + 0.5)
        browser.wait("return page.charts.speed.seen.filter((s) => s).length > 1", "no line where it was played")
        browser.run("page.replay.seek(12)")
        text = browser.wait("const e = document.getElementById('end'); return !e.hidden && e.innerText", "no card at the end of the recording")
        expect("End of the recording" in text, f"the card says {text}")
        browser.run("page.replay.seek(5)")
        browser.wait("return document.getElementById('end').hidden", "the card stays in the middle of the recording")
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()
        shutil.rmtree(folder)


# Which of some spots, in m, people are drawn on: the picture there differs from one without people.
DRAWN = """
const v = page.view, gl = v.renderer.getContext();
const read = (shown) => {
    v.people.group.visible = shown;
    v.dirty = true;
    v.draw(performance.now());
    return arguments[0].map(([x, y, z]) => {
        const spot = new Uint8Array(4), s = v.project(x, y, z);
        gl.readPixels(s[0] * v.ratio, gl.drawingBufferHeight - 1 - s[1] * v.ratio, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, spot);
        return [...spot];
    });
};
const without = read(false), shown = read(true);
return shown.map((spot, k) => Math.max(...spot.map((c, i) => Math.abs(c - without[k][i]))) > 20);
"""


def ends(browser):
    """The card at the end of a run, by keys alone: figures, a command to copy, the same run again."""
    browser.run("""document.activeElement.blur(); page.end.forget(); // it may be there already
        const take = page.takeStatus.bind(page); page.takeStatus = (status) => { if (status.end) window.ended = status; take(status); };""")
    text = browser.wait("const e = document.getElementById('end'); return !e.hidden && e.innerText", "no card at the end")
    for part in ("4 s are over", "2 people took part; nobody left.", "Greatest density: ", "1 person fell.", "Criterion in time: not met."):
        expect(part in text, f"the card lacks {part!r}: {text}")
    expect(browser.run("return document.activeElement.textContent") == "Again", "the card has not the focus")
    browser.press(Keys.TAB, Keys.TAB)
    browser.press(Keys.ENTER)
    command = browser.run("return document.querySelector('#end code').textContent")
    expect("scene.yaml changed.yaml --seed 1 --seeds 10 --for 4" in command, f"the command is {command}")
    browser.picture("end")
    browser.press(Keys.ESCAPE)
    expect(browser.run("return document.getElementById('end').hidden && document.activeElement.id") == "picture", "Escape does not close the card")
    # In a program's frame, which begins runs itself, nothing is offered that it refuses.
    offered = "return [...document.querySelectorAll('#end button, #time button')].filter((b) => b.checkVisibility() && /Again|Another seed|Restart/.test(b.textContent)).length"
    expect(browser.run("page.about.show(true); page.about.asked = false; page.take({...page.scene, restarts: false}); page.end.forget(); page.takeStatus(window.ended); return page.about.node.hidden && !document.getElementById('end').hidden"), "no card in a frame")
    expect(browser.run(offered) == 0, "a program that refuses it is asked to begin anew")
    browser.run("page.take({...page.scene, restarts: true}); page.end.forget()")
    browser.wait("return document.activeElement.textContent === 'Again'", "the card does not come back")
    expect(browser.run(offered) == 3, "a run cannot be begun anew")
    browser.press(Keys.ENTER)
    browser.wait("return page.crowd.next.time < 3 && document.getElementById('end').hidden", "it does not begin again")


def fallen(browser):
    """people who have fallen are drawn lying, and their panel tells of it"""
    folder = temporary_copy({"scene.yaml": """jostle: 1
step: 0.05
duration: 4
places: {edge: {polygon: [[-1, -1], [1, -1], [1, 1], [-1, 1]]}}
groups:
  people: {behaviour: stander.lua, at: [[0, 0], [0, 3]], facing: 0, set: {balance: 0.3, rise: 1000, step_back: 0}}
events: [{at: 0.2, push: edge, force: [2000, 0], lasts: 0.1}]
criteria: {in time: {cleared: 3}}
"""})
    session = Session("run", os.path.join(folder, "scene.yaml"), "--view")
    try:
        browser.open(session)
        browser.run("page.inspect(0); page.panel.show('agent')")
        browser.wait("return /lies since its fall/.test(document.getElementById('page-agent').textContent)", "the panel tells of no fall")
        browser.run("page.view.setTop(true)")
        time.sleep(1)
        lies, stands = browser.run("return [0, 1].map((slot) => page.crowd.position(slot, 1))")
        along = [[x + d, y, 0.1] for x, y, *_ in (lies, stands) for d in (0, 0.6, -0.6)]
        drawn = browser.run(DRAWN, along)
        browser.picture("fallen")
        expect(drawn == [True, True, True, True, False, False], f"people are drawn at {drawn} of {along}")
        browser.run("page.inspect(1)")
        browser.wait("return page.person && page.person.slot === 1", "nobody else was chosen")
        expect("lies" not in browser.find("#page-agent").text, "the panel says that one lies who stands")
        ends(browser)
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()
        shutil.rmtree(folder)


TESTS = [*sight.TESTS, loads, pauses, throws, pulls, breaks, inspects, *figures.TESTS, fallen, edits, settings, *nested.TESTS, given_colours, gates, reloads, plays, ball_games, replays, *following.TESTS, *storeys.TESTS, *reach.TESTS, *steady.TESTS]

if __name__ == "__main__":
    sys.exit(run_all(TESTS, sys.argv[1:]))
