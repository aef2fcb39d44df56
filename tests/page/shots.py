"""Pictures of shipped scenes at 3 s, at 10 s and from near, and contact sheets of them, to be looked at after a change of the page.

    shots.py OUT [SCENE...]    scenes by name; without: all of the folder scenes

OUT/NAME-3.jpg, -10.jpg and -near.jpg; OUT/sheet-1.png and so on show all that OUT holds, a scene a row. `near` looks from 7 m
and over heads at the spot where most people stand within 1.5 m."""
import glob
import os
import re
import sys
import time

from gallery import Shown, make_all, scenes_named
from harness import Browser

SIZE = (480, 300)  # pixels
MOMENTS = (3, 10)  # s
ROWS, CELL = 8, (360, 225)  # of a sheet: scenes; pixels of a picture

# Moves the eye near the densest spot, to the side from which it is free, beginning where the eye was.
APPROACH = """
const view = page.view, {crowd} = page, slots = [...Array(crowd.next.slots).keys()].filter((s) => crowd.position(s, 1) && !Number.isNaN(crowd.floor(s, 1)));
const people = slots.map((s) => [...crowd.position(s, 1), crowd.floor(s, 1)]), cells = new Map(), key = (x, y, z) => `${Math.floor(x)} ${Math.floor(y)} ${Math.round(z / 2)}`;
if (!people.length) return false;
for (const p of people) cells.set(key(...p), [...(cells.get(key(...p)) ?? []), p]);
const around = ([x, y, z]) => [-1, 0, 1].flatMap((i) => [-1, 0, 1].flatMap((j) => cells.get(key(x + i, y + j, z)) ?? []));
const count = (p) => around(p).filter((q) => Math.hypot(q[0] - p[0], q[1] - p[1]) < 1.5).length;
let best = people[0], most = 0;
for (const p of people.filter((_, i) => i % Math.ceil(people.length / 4000) === 0)) {
    const n = count(p);
    if (n > most) [best, most] = [p, n];
}
const eye = view.perspective.position, first = Math.atan2(eye.y - best[1], eye.x - best[0]), head = [best[0], best[1], best[2] + 1];
const place = (turn) => [best[0] + 7 * Math.cos(turn), best[1] + 7 * Math.sin(turn), best[2] + 3];
const turns = Array.from({length: 16}, (_, i) => first + (i % 2 ? -1 : 1) * Math.ceil(i / 2) * Math.PI / 8);
const turn = turns.find((t) => !view.ground.between(head, place(t)) && !view.bodies.between(head, place(t))) ?? first;
view.perspective.position.set(...place(turn));
view.orbit.target.set(...head);
view.orbit.update();
view.handled = true;
view.moved();
return true;
"""


def shoot(browser, name, out):
    """Makes the pictures of a scene."""
    shown = Shown(browser, name)
    try:
        shown.size(*SIZE)
        begun = 0
        for moment in MOMENTS:
            shown.advance(moment - begun)
            begun = moment
            time.sleep(1)  # until the field of this moment is there
            shown.shoot(os.path.join(out, f"{name}-{moment}.jpg"))
        browser.run(APPROACH)
        shown.shoot(os.path.join(out, f"{name}-near.jpg"))
    finally:
        shown.session.stop()


def write_sheets(out):
    """Draws OUT/sheet-N.png, ROWS scenes each; returns their number."""
    names = sorted({re.sub(r"-(\d+|near)\.jpg$", "", os.path.basename(path)) for path in glob.glob(os.path.join(out, "*-near.jpg"))})
    wide, high = CELL
    browser = Browser()
    try:
        for first in range(0, len(names), ROWS):
            rows = "".join(f"<p>{name}</p>" + "".join(f"<img src='{name}-{shot}.jpg' width={wide} height={high}>" for shot in (*MOMENTS, "near"))
                           for name in names[first:first + ROWS])
            path = os.path.join(out, f"sheet-{first // ROWS + 1}")
            with open(path + ".html", "w", encoding="utf-8") as file:
                file.write(f"<!DOCTYPE html><meta charset='utf-8'><style>body{{margin:0;font:14px sans-serif;width:{3 * wide}px;line-height:0}}p{{margin:0;line-height:20px;padding-left:4px}}</style>{rows}")
            browser.size(3 * wide, ROWS * (high + 20))
            browser.driver.get("file://" + path + ".html")
            browser.driver.save_screenshot(path + ".png")
            os.remove(path + ".html")
    finally:
        browser.close()
    return -(-len(names) // ROWS)


def main():
    out = os.path.abspath(sys.argv[1])
    os.makedirs(out, exist_ok=True)
    failed = make_all(scenes_named(sys.argv[2:]), lambda browser, name: shoot(browser, name, out))
    print(f"{write_sheets(out)} sheets in {out}")
    if failed:
        sys.exit(f"without {', '.join(failed)}")


if __name__ == "__main__":
    main()
