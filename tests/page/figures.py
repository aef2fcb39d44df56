"""What people look like is what is simulated: tests of the pixels of figures, as meshes and as sprites."""
import math
import os
import shutil

from harness import Session, expect, temporary_copy

SCENE = """jostle: 1
groups:
  torsos: {behaviour: stander.lua, at: [[0, 0]], facing: 90, set: {breadth: 0.45, depth: 0.25}}
  discs: {behaviour: stander.lua, at: [[2, 0]], facing: 0, clothes: sport, set: {breadth: 0.4, depth: 0.4}}
  helmets: {behaviour: stander.lua, at: [[4, 0]], facing: 90, clothes: work}
"""

# Pixels of a person without their shade, as [x, y] in m from their place and [r, g, b]; `pixels`: least heights of the
# mesh levels, so that huge ones leave sprites alone.
PIXELS = """
const [slot, pixels, high] = arguments, v = page.view, gl = v.renderer.getContext(), people = v.people;
const kept = people.levels.pixels, shades = people.layers.slice(-2).map(({ layer }) => layer.material);
people.levels.pixels = pixels;
const read = (shown) => {
    people.group.visible = shown;
    for (const material of shades) material.visible = false;
    v.dirty = true;
    v.draw(performance.now());
    const data = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return data;
};
const without = read(false), shown = read(true), wide = gl.drawingBufferWidth, tall = gl.drawingBufferHeight;
for (const material of shades) material.visible = true;
people.levels.pixels = kept;
const [px, py] = page.crowd.position(slot, 1), [cx, cy] = v.project(px, py, high), [mx] = v.project(px + 1, py, high), metre = (mx - cx) * v.ratio;
const out = [];
for (let y = 0; y < tall; y++) for (let x = 0; x < wide; x++) {
    const at = 4 * (y * wide + x), dx = (x + 0.5 - cx * v.ratio) / metre, dy = (y + 0.5 - (tall - cy * v.ratio)) / metre;
    if (Math.max(Math.abs(dx), Math.abs(dy)) > 1) continue;
    if ([0, 1, 2].some((k) => Math.abs(shown[at + k] - without[at + k]) > 12)) out.push([dx, dy, shown[at], shown[at + 1], shown[at + 2]]);
}
return [metre, out];
"""
MESHES, SPRITES = [1, 1, 1], [1e9, 1e9, 1e9]


def outline_of(browser, slot, pixels):
    """Extents along x and y (m) of a person seen from above, their middle, and the share inside a capsule."""
    metre, drawn = browser.run(PIXELS, slot, pixels, 1.2)
    expect(len(drawn) > 50, f"{len(drawn)} pixels are drawn of person {slot}")
    xs, ys = [p[0] for p in drawn], [p[1] for p in drawn]
    return metre, max(xs) - min(xs), (min(xs) + max(xs)) / 2, sum(ys) / len(ys), drawn


def torsos(browser):
    """people are drawn as broad as they are simulated, as meshes and as sprites, which look alike, and a person's panel tells of the torso"""
    folder = temporary_copy({"scene.yaml": SCENE})
    session = Session("run", os.path.join(folder, "scene.yaml"), "--view")
    try:
        browser.open(session)
        browser.wait("return page.crowd.torso(0)", "there is no torso")
        told = browser.run("return [page.crowd.torso(0), page.crowd.reach(0), page.crowd.torso(1), page.crowd.reach(1)]")
        expect(told == [{"breadth": 0.45, "depth": 0.25, "chest": 90}, 0.225, None, 0.2], f"the page knows {told}")
        browser.run("page.inspect(0); page.panel.show('agent')")
        browser.wait("return /0.45 m, 0.25 m/.test(document.getElementById('page-agent').textContent)", "the panel does not tell of the torso")
        browser.run("page.view.setTop(true); page.view.flat.zoom = page.view.flatSize / 4; page.view.flat.updateProjectionMatrix(); page.view.moved()")
        for kind, pixels in (("mesh", MESHES), ("sprite", SPRITES)):
            metre, wide, middle, ahead, drawn = outline_of(browser, 0, pixels)
            expect(metre > 60, f"a metre has {metre:.0f} pixels")
            expect(abs(wide - 0.45) < 0.05 and abs(middle) < 0.05 and abs(ahead) < 0.08, f"as a {kind} the torso is {wide:.2f} m broad around {middle:.2f}, {ahead:.2f} m")
            # The disc looks along x, so that its breadth is along y; feet and face reach over it.
            _, deep, _, _, of_disc = outline_of(browser, 1, pixels)
            ys = [p[1] for p in of_disc]
            expect(abs(max(ys) - min(ys) - 0.4) < 0.05 and deep < 0.5, f"as a {kind} the disc is {max(ys) - min(ys):.2f} m broad")
        browser.picture("torsos")
        alike(browser)
        expect(not (complaints := browser.complaints()), f"the console says {complaints[:2]}")
    finally:
        session.stop()
        shutil.rmtree(folder)


def look_from_front(browser, x, pixels):
    """Looks down at the person at `x` (m), who is `pixels` high in the picture."""
    browser.run("""const v = page.view, [x, pixels] = arguments; v.setTop(false);
        v.orbit.target.set(x, 0, 0.9); v.perspective.position.set(x, -v.pixelsOfMetre() * 1.7 / pixels, 6 * 42 / pixels); v.orbit.update(); v.moved();""", x, pixels)


def alike(browser):
    """Compares a person as the coarsest mesh and as a sprite, where one follows the other: size, place and mean colour, and that a hat stays on."""
    look_from_front(browser, 0, 42)
    seen = {}
    for kind, pixels in (("mesh", [1e9, 1e9, 1]), ("sprite", SPRITES)):
        _, drawn = browser.run(PIXELS, 0, pixels, 0.9)
        expect(len(drawn) > 100, f"{len(drawn)} pixels are drawn of a {kind}")
        seen[kind] = [len(drawn), *(sum(p[k] for p in drawn) / len(drawn) for k in range(5))]
    look_from_front(browser, 4, 80) # near enough that where the edges of pixels fall does not decide
    helmets = [sum(r > 110 and r > 1.1 * g and g > 1.4 * b for _, _, r, g, b in browser.run(PIXELS, 2, pixels, 0.9)[1]) for pixels in ([1e9, 1e9, 1], SPRITES)]
    expect(helmets[0] > 15 and 0.5 < helmets[1] / helmets[0] < 2.5, f"of a helmet {helmets[0]} pixels are drawn as a mesh, {helmets[1]} as a sprite")
    mesh, sprite = seen["mesh"], seen["sprite"]
    expect(0.75 < sprite[0] / mesh[0] < 1.33, f"a sprite has {sprite[0]} pixels, a mesh {mesh[0]}")
    expect(math.dist(mesh[1:3], sprite[1:3]) < 0.06, f"a sprite is at {sprite[1:3]}, a mesh at {mesh[1:3]}")
    expect(math.dist(mesh[3:], sprite[3:]) < 30, f"a sprite has the colour {sprite[3:]}, a mesh {mesh[3:]}")


TESTS = [torsos]
