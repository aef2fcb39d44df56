"""Tests of storeys, stairs and lifts on the page, of a running scene and of a recording."""
import os
import shutil
import subprocess
import time

from harness import JOSTLE, Session, draw, expect, settle, temporary_copy, wait_for
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.support.ui import Select

# Two storeys, with somebody at the same place of each, and one who walks up the stair between them; a lift with one who rides down.
BUILDING = """jostle: 1
duration: 120
storeys: {ground: {height: 0}, first: {height: 4}}
stairs:
  steps: {from: ground, to: first, path: [[4, 9], [11, 9]], width: 1.4}
lifts:
  east: {area: [[16, 5], [17.6, 6.8]], door: [[16.35, 5], [17.25, 5]]}
walls:
  - {line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, height: 2, storey: [ground, first]}
places:
  top: {polygon: [[13, 8], [15, 8], [15, 10], [13, 10]], storey: first}
groups:
  below: {behaviour: stand.lua, at: [[8, 4]]}
  above: {behaviour: stand.lua, at: [[8, 4]], storey: first}
  climber: {behaviour: climb.lua, at: [[2.6, 9]]}
  rider: {at: [[16.8, 3.6]], storey: first, journey: [{ride: east.ground}, {wait: 60}]}
bodies:
  - {name: crate, shape: {box: {size: [0.6, 0.6, 0.6]}}, mass: 30, at: [3, 3, 0.3], storey: first}
"""
STAND = 'return machine { name = "stand", version = 1, start = "Stand", states = { Stand = { steer = hold } } }\n'
CLIMB = 'return machine { name = "climb", version = 1, start = "Climb", states = { Climb = { steer = seek "top" } } }\n'
BELOW, ABOVE, CLIMBER, RIDER = range(4)  # slots

# A point of the picture: of somebody, `high` m above the floor.
SPOT = "const [x, y] = page.crowd.position(arguments[0], 1); return [x, y, page.crowd.floor(arguments[0], 1) + arguments[1]]"
# Whether the picture has another colour where somebody is drawn than without people.
DRAWN = """
const v = page.view, gl = v.renderer.getContext(), looks = (people) => {
    v.people.group.visible = people;
    v.dirty = true;
    v.draw(performance.now());
    return arguments[0].map((at) => {
        const spot = new Uint8Array(4), [x, y] = v.project(...at);
        gl.readPixels(x * v.ratio, gl.drawingBufferHeight - 1 - y * v.ratio, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, spot);
        return spot.join();
    });
};
const without = looks(false), looked = looks(true);
return looked.map((colour, i) => colour !== without[i]);
"""
NEAR = "page.view.orbit.target.set(8, 4, arguments[0] + 3); page.view.perspective.position.set(8, -22, arguments[0] + 14); page.view.orbit.update(); page.view.moved()"


def shown(test, *, recorded=False):
    """A test with the building on the page, running with the time stopped, or recorded."""
    def run(browser):
        folder = temporary_copy({"scene.yaml": BUILDING, "stand.lua": STAND, "climb.lua": CLIMB})
        scene, recording = os.path.join(folder, "scene.yaml"), os.path.join(folder, "run.sqlite")
        if recorded:
            subprocess.run([JOSTLE, "run", scene, "--for", "40", "--record", recording, "--quiet"], check=True)
        session = Session("view", recording) if recorded else Session("run", scene, "--view")
        try:
            session.pause()
            browser.open(session)
            test(browser)
            expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
        finally:
            session.stop()
            shutil.rmtree(folder)
    run.__name__, run.__doc__ = test.__name__, test.__doc__
    return run


def show(browser, view, storey=None):
    """Shows storeys in a view, as the panel over the picture does."""
    Select(browser.find("#storeys select")).select_by_value(view)
    if storey:
        browser.run("[...document.querySelectorAll('#storeys button')].find((b) => b.textContent === arguments[0]).click()", storey)


def click(browser, at):
    """Clicks a point of the picture [x, y, z], m."""
    spot, box = browser.run("return page.view.project(...arguments[0])", at), browser.canvas().rect
    hand = ActionChains(browser.driver, duration=50)
    hand.move_to_element_with_offset(browser.canvas(), int(spot[0] - box["width"] / 2), int(spot[1] - box["height"] / 2)).click().perform()


def storey_of(browser, slot):
    return browser.run("return page.view.storeys.decks[page.crowd.deck(arguments[0])].name", slot)


def advance(browser, seconds):
    """Goes on by some seconds, of a scene that is paused."""
    until = browser.run("return page.crowd.next.time") + seconds
    browser.run("page.connection.send({do: 'step', n: Math.round(arguments[0] / page.scene.dt)})", seconds)
    browser.wait("return page.crowd.next.time >= arguments[0] - 0.06", f"{until} s were not reached", until)


def heights(browser):
    """people of two storeys are drawn at their heights, and one storey alone hides the other"""
    expect(browser.run("return [page.view.storeys.view, page.view.storeys.several].join()") == "exploded,true", "storeys are not spread at first")
    show(browser, "stacked", "first")
    floors = browser.run("return [0, 1].map((slot) => page.crowd.floor(slot, 1))")
    expect(abs(floors[0]) < 0.01 and abs(floors[1] - 4) < 0.01, f"stacked, they stand at {floors} m, not at 0 and 4")
    show(browser, "exploded")
    spread = browser.run("return page.crowd.floor(1, 1)")
    expect(spread > 6, f"exploded, the upper one stands at {spread:.1f} m")
    browser.run(NEAR, 0)
    drawn = browser.run(DRAWN, [browser.run(SPOT, slot, 1.1) for slot in (BELOW, ABOVE)])
    expect(drawn == [True, True], f"exploded, people are drawn: {drawn}")
    spots = [browser.run(SPOT, slot, 1.1) for slot in (BELOW, ABOVE)]
    show(browser, "one", "ground")
    browser.run(NEAR, 0)
    drawn = browser.run(DRAWN, spots)
    expect(drawn == [True, False], f"with the ground alone, people are drawn: {drawn}")
    show(browser, "one", "first")
    expect(browser.run("return [0, 1].map((slot) => Number.isNaN(page.crowd.floor(slot, 1)))") == [True, False], "the lower one is shown on the upper storey alone")
    pressed = browser.run("return [...document.querySelectorAll('#storeys button')].map((b) => [b.textContent, b.getAttribute('aria-pressed')].join(' '))")
    expect(pressed == ["first true", "ground false"], f"the panel says {pressed}")
    browser.find("body").send_keys("s")
    expect(browser.run("return page.view.storeys.view") == "stacked", "S does not show storeys in the next way")
    browser.press("\ue00f")  # Page Down
    expect(browser.run("return page.view.storeys.chosen") == 0, "Page Down does not look at the storey below")
    browser.picture("storeys")


def chooses(browser):
    """a click chooses the person on the storey that is seen, not the one under it, whose panel says where"""
    show(browser, "exploded")
    for slot, storey in ((ABOVE, "first"), (BELOW, "ground")):
        click(browser, browser.run(SPOT, slot, 0.9))
        expect(browser.run("return page.slot") == slot, f"a click at slot {slot} chooses {browser.run('return page.slot')}")
        browser.wait("return new RegExp(`on ${arguments[0]}, `).test(document.getElementById('page-agent').textContent)", f"the panel does not say {storey}", storey)
    browser.run("page.inspect(null)")
    show(browser, "stacked", "first")
    browser.run("page.top()")
    at = browser.run(SPOT, ABOVE, 0.9)
    click(browser, at)
    expect(browser.run("return page.slot") == ABOVE, "from above the one on the lower storey is chosen")
    browser.press("\ue00f")  # Page Down: the upper storey is cut off
    click(browser, at[:2] + [0.9])
    expect(browser.run("return page.slot") == BELOW, "the lower one cannot be chosen under the storey that is cut off")


def acts(browser):
    """a push, a throw and a drag act on the storey under the pointer"""
    show(browser, "exploded")
    browser.run("page.view.orbit.target.set(8, 4, page.view.storeys.at[1]); page.view.perspective.position.set(8, -10, page.view.storeys.at[1] + 9); page.view.orbit.update(); page.view.moved()")
    settle(browser, "Push")
    spots = "return [0, 1].map((slot) => page.crowd.position(slot, 1))"
    before, at = browser.run(spots), browser.run(SPOT, ABOVE, 0.9)
    for _ in draw(browser, "Push", at, (at[0] + 3, at[1], at[2] - 0.9), 6):
        browser.run("page.connection.send({do: 'step', n: 1})")
        if browser.run(spots)[1][0] > before[1][0] + 0.3:
            break
    after = browser.run(spots)
    expect(after[1][0] > before[1][0] + 0.2, f"the one above goes from {before[1]} to {after[1]}")
    expect(abs(after[0][0] - before[0][0]) < 0.02, f"the one below goes from {before[0]} to {after[0]}")
    floor = browser.run("return page.view.storeys.at[1]")
    settle(browser, "Throw")
    for _ in draw(browser, "Throw", (10, 3, floor), (12, 3, floor), 0.1):
        pass
    browser.run("page.connection.send({do: 'step', n: 10})")
    browser.wait("return page.scene.bodies.length === 2 && page.crowd.findBody(1)", "no box is thrown")
    box = browser.run("return page.crowd.findBody(1)")
    expect(box["deck"] == 1 and abs(box["at"][1] - 3) < 1.5 and box["at"][2] > floor, f"the box is at {box}")
    settle(browser, "Drag")
    crate = browser.run("return page.crowd.findBody(0)")
    expect(crate["deck"] == 1, f"the crate is at {crate}")
    for _ in draw(browser, "Drag", crate["at"], (crate["at"][0] + 2, crate["at"][1], crate["at"][2]), 5):
        browser.run("page.connection.send({do: 'step', n: 2})")
        if browser.run("return page.crowd.findBody(0).at[0]") > crate["at"][0] + 0.5:
            break
    now = browser.run("return page.crowd.findBody(0)")
    expect(now["deck"] == 1 and now["at"][0] > crate["at"][0] + 0.4, f"the crate was dragged from {crate} to {now}")


def follows(browser):
    """the eye follows a person upstairs, and the storey that is shown changes with them"""
    show(browser, "one", "ground")
    browser.run("page.inspect(arguments[0]); page.follow(true)", CLIMBER)
    target = "page.loop(); return page.view.orbit.target.z"
    low = browser.run(target)
    seen = []
    for _ in range(12):
        advance(browser, 1.5)
        time.sleep(0.2)
        seen.append((browser.run(target), storey_of(browser, CLIMBER), browser.run("return page.view.storeys.list[page.view.storeys.chosen].name")))
        if seen[-1][1] == "first":
            break
    expect(abs(low) < 0.1, f"the eye looks at {low} m at first")
    expect("steps" in [deck for _, deck, _ in seen] and seen[-1][1] == "first", f"the person was on {[deck for _, deck, _ in seen]}")
    rises = [z for z, _, _ in seen]
    expect(all(b >= a - 0.05 for a, b in zip(rises, rises[1:])) and any(0.5 < z < 3.5 for z in rises), f"the eye looks at {rises} m")
    expect(abs(rises[-1] - 4) < 0.1 and seen[-1][2] == "first", f"above, the eye looks at {rises[-1]} m and {seen[-1][2]} is shown")
    pressed = browser.run("return document.querySelector('#storeys button[aria-pressed=true]').textContent")
    expect(pressed == "first", f"the panel says {pressed}")
    expect(browser.run("return page.view.perspective.position.z") > 4.5, "the eye stays under the storey")
    browser.picture("upstairs")


def rides(browser):
    """the car of a lift is drawn between storeys, with who rides in it, and the scene's tab tells of it"""
    show(browser, "stacked", "first")
    between, doors = [], set()
    for _ in range(60):
        advance(browser, 0.5)
        height, door, people = browser.run("const c = page.crowd.next.cars[0]; return [c.height, c.open, c.people]")
        floor = browser.run("return page.crowd.floor(arguments[0], 1)", RIDER)
        doors.add(round(door))
        if 0.2 < height < 3.8 and people:
            between.append((height, floor, browser.run("page.view.ground.lifts.move(page.crowd.previous, page.crowd.next, 1); return page.view.ground.lifts.lifts[0].car.matrixWorld.elements[14]")))
        elif between:
            break
    expect(between, "the car was never between storeys with somebody in it")
    worst = max(max(abs(height - floor), abs(height - car)) for height, floor, car in between)
    expect(worst < 0.05, f"the car, who rides and what is drawn differ by {worst:.2f} m: {between}")
    expect(doors == {0, 1}, f"the door was {doors}")
    browser.wait("return /^at ground, door|^moves/.test([...document.querySelectorAll('#page-scene dt')].find((t) => t.textContent === 'east')?.nextSibling.textContent)", "the tab does not tell of the lift")


# The value of the field on a deck at a point in plan, 0 to 255; null where the deck has none.
FIELD = """
const [deck, x, y] = arguments, u = page.view.ground.decks[deck].uniforms, [x0, y0, wide, deep] = u.cover.value.toArray(), rows = u.rows.value;
const across = (x - x0) / wide, up = (y - y0) / deep, { data, width, height } = u.field.value?.image ?? {};
return wide > 0 && across > 0 && across < 1 && up > rows.x && up < rows.y ? data[Math.floor(up * height) * width + Math.floor(across * width)] : null;
"""


def densities(browser):
    """the density is shown on each storey, and on stairs, where people are"""
    browser.run("page.fieldOf('density')")
    browser.wait("return page.view.ground.decks[0].uniforms.cover.value.z > 0", "no field comes")
    at = {name: browser.run("return page.crowd.position(arguments[0], 1)", slot) for name, slot in (("both", BELOW), ("above", RIDER))}
    values = [browser.run(FIELD, deck, *at[name]) for name in at for deck in (0, 1)]
    expect(values[0] > 20 and values[1] > 20, f"where one stands on each storey the density is {values[:2]}")
    expect((values[2] or 0) < 5 and values[3] > 20, f"where one stands above alone the density is {values[2:]}")
    for _ in range(8):
        advance(browser, 1)
        if storey_of(browser, CLIMBER) == "steps":
            break
    advance(browser, 1)
    place = browser.run("return page.crowd.position(arguments[0], 1)", CLIMBER)
    expect(storey_of(browser, CLIMBER) == "steps", f"the climber is at {place}")
    wait_for(lambda: (browser.run(FIELD, 2, *place) or 0) > 20, f"on the stair the density is {browser.run(FIELD, 2, *place)}")
    expect(browser.run("return page.view.ground.decks[2].treads.visible"), "no field is drawn on the stair")


def replayed(browser):
    """a recording shows people on their storeys and stairs, chooses the one that is seen, and follows upstairs"""
    browser.wait("return page.view.storeys.several", "the recording has no storeys")
    show(browser, "stacked", "first")
    floors = browser.run("return [0, 1].map((slot) => page.crowd.floor(slot, 1))")
    expect(abs(floors[0]) < 0.01 and abs(floors[1] - 4) < 0.01, f"they stand at {floors} m, not at 0 and 4")
    show(browser, "exploded")
    click(browser, browser.run(SPOT, ABOVE, 0.9))
    expect(browser.run("return page.slot") == ABOVE, f"a click above chooses {browser.run('return page.slot')}")
    browser.wait("return /on first, 4.0 m high/.test(document.getElementById('page-agent').textContent)", "the panel does not say where")
    show(browser, "one", "ground")
    browser.run("page.inspect(arguments[0]); page.follow(true)", CLIMBER)
    browser.run("page.connection.send({do: 'pause', on: false})")
    browser.wait("return page.view.storeys.decks[page.crowd.deck(arguments[0])].name === 'steps'", "the person does not come to the stair", CLIMBER)
    browser.wait("return page.view.orbit.target.z > 1", "the eye does not rise with the person")
    browser.wait("return page.view.storeys.decks[page.crowd.deck(arguments[0])].name === 'first'", "the person does not come upstairs", CLIMBER)
    browser.run("page.connection.send({do: 'pause', on: true}); page.loop()")
    expect(browser.run("return page.view.storeys.list[page.view.storeys.chosen].name") == "first", "the storey that is shown does not change")
    expect(abs(browser.run("return page.view.orbit.target.z") - 4) < 0.1, "the eye does not look at the upper storey")


TESTS = [shown(heights), shown(chooses), shown(acts), shown(follows), shown(rides), shown(densities), shown(replayed, recorded=True)]
