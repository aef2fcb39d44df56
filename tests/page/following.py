"""Tests of the eye that follows a person."""
import os
import shutil

from harness import Session, expect, temporary_copy

# Somebody is moved by hand once round an upright block on a ring (counter-clockwise) of a height, at a distance from the origin,
# and followed, with ten pictures a second. Tells of each whether the line from the head to the eye leads through the block, by
# steps of 2 cm, how far the eye is away, and how far it leaped beside the person since the one before, m.
ROUND = """
const [slot, ring, high, around] = arguments, { crowd, view } = page, position = crowd.position.bind(crowd), out = [];
const inside = (x, y) => ring.every(([ax, ay], i) => {
    const [bx, by] = ring[(i + 1) % ring.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
});
let time = performance.now(), at = null, last = null;
crowd.position = (s, share) => (s === slot ? at : position(s, share));
performance.now = () => time;
window.requestAnimationFrame = () => 0; // the loop is gone through by hand, and nothing is drawn
view.draw = () => false;
for (let i = 0; i <= 400; i++, time += 100) {
    at = [around * Math.cos((2 * Math.PI * i) / 400), around * Math.sin((2 * Math.PI * i) / 400)];
    if (i === 0) {
        page.inspect(slot);
        page.follow(true);
    }
    page.loop();
    const way = view.camera.position.toArray().map((v, k) => v - [...at, 1.5][k]), away = Math.hypot(...way);
    let hidden = false;
    for (let l = 0; l < away && !hidden; l += 0.02) {
        const [x, y, z] = way.map((v, k) => [...at, 1.5][k] + (l / away) * v);
        hidden = z < high && inside(x, y);
    }
    out.push({ hidden, away, leap: last ? Math.hypot(...way.map((v, k) => v - last[k])) : 0 });
    last = way;
}
return out;
"""


def followed_round(browser, ring, high, around):
    """Demands that who goes round a block is always in sight, from an eye that neither comes close nor leaps."""
    browser.run("page.connection.send({do: 'pause', on: true})")
    browser.wait("return page.bar.paused", "no pause")
    seen = browser.run(ROUND, 0, ring, high, around)
    hidden, nearest, farthest = (sum(p["hidden"] for p in seen), min(p["away"] for p in seen), max(p["leap"] for p in seen))
    print(f"    of {len(seen)} pictures {hidden} show nobody; the eye comes as near as {nearest:.1f} m and leaps by {farthest:.2f} m at most")
    expect(hidden == 0, f"in {hidden} of {len(seen)} pictures the block is between the person and the eye")
    expect(nearest > 3, f"the eye comes as near as {nearest:.1f} m")
    expect(farthest < 2, f"the eye leaps by {farthest:.1f} m within a tenth of a second")


def round_a_building(browser):
    """who is followed round a building is always in sight, and the eye is never in it"""
    session = Session("run", "scenes/tawaf-few.yaml", "--view")
    try:
        browser.open(session)
        followed_round(browser, [[-5.6, -6.95], [5.68, -6.35], [5.38, 6.82], [-5.91, 6.23]], 13.1, 10)
    finally:
        session.stop()


CUPBOARD = """jostle: 1
duration: 60
bodies:
  - {name: cupboard, shape: {box: {size: [6, 1, 5]}}, mass: 0, at: [0, 0, 2.5], turn: 30}
groups:
  one: {behaviour: stand.lua, at: [[4, 4]]}
"""
STAND = 'return machine { name = "stand", version = 1, start = "Stand", states = { Stand = { steer = hold } } }\n'


def round_a_body(browser):
    """who is followed round a tall body is always in sight"""
    folder = temporary_copy({"scene.yaml": CUPBOARD, "stand.lua": STAND})
    session = Session("run", os.path.join(folder, "scene.yaml"), "--view")
    try:
        browser.open(session)
        # The box as it is turned, counter-clockwise by 30 degrees.
        turned = [[0.866 * x - 0.5 * y, 0.5 * x + 0.866 * y] for x, y in ((-3, -0.5), (3, -0.5), (3, 0.5), (-3, 0.5))]
        followed_round(browser, turned, 5, 4)
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()
        shutil.rmtree(folder)


TESTS = [round_a_building, round_a_body]
